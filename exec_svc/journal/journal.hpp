// The journal holds what must survive a crash of exec_svc, in one SQLite file (write-ahead log): the goals,
// the epoch, the services that were there, and a record of all that came in, was planned, commanded, answered
// and observed. A goal is acknowledged only after commit().
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/temporal/duration.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/journal/batch.hpp"

namespace roci::exec::journal {

/// Reports a journal that cannot be read or written.
class JournalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reports a journal that a newer version of the code wrote. No restart mends that: a process ends with code
/// 2 (docs/exit-codes.md).
class NewerJournal : public JournalError {
 public:
  using JournalError::JournalError;
};

/// Reports that the disk takes nothing just now (it is full, or does not answer). Nothing is lost: the changes
/// since the last commit are kept, and the next commit() writes them.
class DiskError : public JournalError {
 public:
  using JournalError::JournalError;
};

/// Says what a journal does about a disk that takes nothing. Both may be null.
struct DiskWait {
  /// Waits before the next attempt, for a `cause` in plain words. If it is null, commit() throws DiskError
  /// instead.
  std::function<void(const std::string& cause)> wait{};
  std::function<void()> over{};  ///< called once the disk has taken everything after all
};

/// Says what a commit survives.
enum class Durability {
  process,  ///< survives the death of the process; commits do not wait for the disk
  power,    ///< survives the loss of power
};

/// Names the journal in the run folder; ServiceList::file_name() tells the journals of several executives
/// apart.
inline constexpr char kJournalFile[] = "journal.sqlite";

/// Names the journal's text that tells the ground what the journal has lost; the text is empty if nothing was lost
/// or the ground knows.
inline constexpr char kShortened[] = "shortened";

/// Keeps goals, records, numbers and texts; what was entered before a commit() is durable together. Errors
/// are JournalError unless a function says otherwise.
class Journal {
 public:
  struct Database;  ///< database.hpp

  /// Opens or creates the file. Throws JournalError naming the file when it is not a journal or cannot be
  /// written.
  Journal(const std::filesystem::path& file, Durability durability);
  /// Opens a journal to read it alone: nothing that stands in the file changes. Throws JournalError naming the file
  /// when it is not a journal.
  explicit Journal(const std::filesystem::path& file);
  ~Journal();

  const std::filesystem::path& file() const { return file_; }

  /// Makes the entries since the last commit durable together. While the disk takes nothing it waits as
  /// wait_for_disk() says, or throws DiskError and forgets nothing.
  void commit();
  void wait_for_disk(DiskWait);

  /// Compares the journal with the mark that an earlier start has left (high_water_mark.hpp), and lets each commit
  /// leave a mark from now on. Returns in plain words what is missing, which then stands in the journal as the text
  /// kShortened; the epoch is at least the mark's then, and no copy goes on from the journal. Returns an empty text if
  /// nothing is known to be missing. Throws as commit() does.
  std::string watch_extent();

  /// Returns the epoch of this start of the executive; it rises by one with each call.
  std::uint64_t next_epoch();

  /// Serves copies from now on: every commit that changes something is the next one of this epoch, and is kept
  /// for take_batches(), which returns those since its last call, in order.
  void begin_epoch(std::uint64_t epoch);
  std::vector<Batch> take_batches();
  /// Brings everything that was committed from SQLite's log into the file itself, which is whole without its log then.
  /// Throws DiskError if the disk does not take it; closing the journal would pass over that.
  void checkpoint();
  bool empty() const;  ///< no goals, no records
  /// Returns the newest commit, or {0, 0} for a journal that no epoch of a pair has written to.
  Position position() const;
  /// Sets the position, e.g. to kForkedHistory.
  void set_position(const Position& position);
  /// Makes the change of a batch here, in one commit. Throws JournalError when the batch does not fit or
  /// cannot be read; nothing has changed then.
  void apply(const Batch& batch);
  /// serialized() returns the whole journal up to the last commit, position included, as the bytes of its
  /// file; replace_with() replaces this journal by such bytes. It throws JournalError when they are not a
  /// journal, and DiskError when the disk does not take them; nothing has changed then. Where the disk lets the new
  /// journal not be opened once it is in place it throws std::runtime_error: this object is of no more use, and
  /// whoever opens the file anew has the new one.
  std::string serialized() const;
  void replace_with(std::string_view serialized);

  void put_goal(const goals::GoalRecord& record);
  /// Throws JournalError for a goal that cannot be read; salvage.hpp keeps the others.
  std::vector<goals::GoalRecord> goals() const;

  /// Keep the services that were there when the last turn was journaled, with their incarnations.
  void put_peer(const std::string& service, std::uint32_t incarnation);
  void remove_peer(const std::string& service);
  std::map<std::string, std::uint32_t> peers() const;

  /// Appends a text of the kind "trace" (plans, commands, acknowledgements and observations), "goal",
  /// "event", "step" or "call".
  void append(temporal::Time time, std::string_view kind, std::string_view text);
  /// Appends bytes of the kind "input" (of one step of the reactor; its decisions follow), "anchor" or
  /// "restored" (snapshots of the reactor). Returns the number of the record; numbers rise.
  std::int64_t append_bytes(temporal::Time time, std::string_view kind, std::string_view bytes);

  using Visit = std::function<void(temporal::Time, std::string_view kind, std::string_view text)>;
  /// Visit the records in order of writing; the second begins with the record of this number.
  void for_each(const Visit& visit) const { for_each_from(0, visit); }
  void for_each_from(std::int64_t number, const Visit& visit) const;

  /// Removes inputs and snapshots before this record; what was before it can no longer be replayed.
  void forget_inputs_before(std::int64_t number);
  /// Removes the text records before this one; the journal no longer tells what was done before it.
  void forget_texts_before(std::int64_t number);

  /// Keep named texts and numbers. A text that was never set is empty.
  void set_text(std::string_view name, std::string_view value);
  std::string text(std::string_view name) const;
  void set_number(std::string_view name, std::int64_t value);
  std::int64_t number(std::string_view name, std::int64_t fallback) const;

 private:
  std::filesystem::path file_;
  Durability durability_;
  std::unique_ptr<Database> database_;
};

}  // namespace roci::exec::journal
