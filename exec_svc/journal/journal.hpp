/// What must survive a crash of exec_svc, in one SQLite file (write-ahead log): the goals, the epoch, who was
/// there, and a record of all that came in, was planned, commanded, answered and observed. A goal is
/// acknowledged only after commit().
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

class JournalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A newer version of the code wrote the journal. No restart mends that: a process ends with code 2
/// (docs/exit-codes.md).
class NewerJournal : public JournalError {
 public:
  using JournalError::JournalError;
};

/// The disk takes nothing just now (it is full, or does not answer); nothing is lost: the changes since the last
/// commit are kept, and the next commit() writes them.
class DiskError : public JournalError {
 public:
  using JournalError::JournalError;
};

/// What a journal does about a disk that takes nothing. Both may be null.
struct DiskWait {
  /// Waits a while before the next attempt; `cause` in plain words. Null: commit() throws DiskError instead.
  std::function<void(const std::string& cause)> wait{};
  std::function<void()> over{};  ///< The disk has taken everything after all.
};

enum class Durability {
  process,  ///< survives the death of the process; commits do not wait for the disk
  power,    ///< survives the loss of power
};

/// It lies in the run folder; ServiceList::file_name() tells the journals of several executives apart.
inline constexpr char kJournalFile[] = "journal.sqlite";

/// The name of the journal's text that says what it has lost, for the ground; empty: nothing, or the ground knows.
inline constexpr char kShortened[] = "shortened";

class Journal {
 public:
  struct Database;  ///< database.hpp

  /// Opens or creates the file. Throws JournalError naming the file when it is not a journal or cannot be
  /// written.
  Journal(const std::filesystem::path& file, Durability durability);
  ~Journal();

  const std::filesystem::path& file() const { return file_; }

  /// Entries since the last commit become durable together. While the disk takes nothing it waits as wait_for_disk()
  /// says, else it throws DiskError; nothing is forgotten then.
  void commit();
  void wait_for_disk(DiskWait);

  /// From now on each commit leaves a mark beside the file (high_water_mark.hpp). Compares the journal with the mark
  /// that an earlier start has left: what is missing is said in plain words, and stands in the journal as the text
  /// kShortened; its epoch is at least the mark's then, and no copy goes on from it. Empty: nothing is missing, as far
  /// as is known. Throws as commit() does.
  std::string watch_extent();

  /// Rises by one with each call: the epoch of this start of the executive.
  std::uint64_t next_epoch();

  /// Serves copies: from now on every commit that changes something is the next one of this epoch, and is kept
  /// for take_batches(): in order, those since the last call.
  void begin_epoch(std::uint64_t epoch);
  std::vector<Batch> take_batches();
  bool empty() const;  ///< no goals, no records
  /// {0, 0} for a journal that no epoch of a pair has written to.
  Position position() const;
  /// Says that the journal is at another one, e.g. kForkedHistory.
  void set_position(const Position& position);
  /// Makes the same change here, in one commit. Throws JournalError when the batch does not fit or cannot be
  /// read; nothing has changed then.
  void apply(const Batch& batch);
  /// The whole journal up to the last commit, position included, as the bytes of its file; and this journal
  /// from such bytes, what was in it is gone. Throws JournalError when they are not a journal; nothing has
  /// changed then.
  std::string serialized() const;
  void replace_with(std::string_view serialized);

  void put_goal(const goals::GoalRecord& record);
  /// Throws JournalError for a goal that cannot be read; salvage.hpp keeps the others.
  std::vector<goals::GoalRecord> goals() const;

  /// The services that were there when the last turn was journaled, with their incarnations.
  void put_peer(const std::string& service, std::uint32_t incarnation);
  void remove_peer(const std::string& service);
  std::map<std::string, std::uint32_t> peers() const;

  /// Text, kind: "trace" (plans, commands, acknowledgements and observations), "goal", "event", "step",
  /// "call".
  void append(temporal::Time time, std::string_view kind, std::string_view text);
  /// Bytes, kind: "input" (of one step of the reactor; its decisions follow), "anchor", "restored" (snapshots
  /// of the reactor). Returns the number of the record; numbers rise.
  std::int64_t append_bytes(temporal::Time time, std::string_view kind, std::string_view bytes);

  using Visit = std::function<void(temporal::Time, std::string_view kind, std::string_view text)>;
  /// They go in order of writing; the second begins with the record of this number.
  void for_each(const Visit& visit) const { for_each_from(0, visit); }
  void for_each_from(std::int64_t number, const Visit& visit) const;

  /// Removes inputs and snapshots before this record: nobody can replay what was before it any more.
  void forget_inputs_before(std::int64_t number);
  /// Removes the records that are text before this one: what was done before it is no longer told here.
  void forget_texts_before(std::int64_t number);

  /// Empty when never set.
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
