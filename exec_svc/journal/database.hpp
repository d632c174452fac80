// This is the SQLite file behind a journal: its tables, at most one open transaction, prepared statements,
// and what a commit changed. The journal's own sources alone see it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "exec_svc/journal/high_water_mark.hpp"
#include "exec_svc/journal/journal.hpp"

struct sqlite3;
struct sqlite3_stmt;
struct sqlite3_session;

namespace roci::exec::journal {

/// Returns whether the disk, and not what stands on it, is the cause of the last error of this connection.
bool is_of_the_disk(sqlite3* database);

/// Holds a prepared statement; bound values are copied.
class Statement {
 public:
  Statement(const Journal::Database& database, const char* sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(std::string_view text);
  Statement& bind_bytes(std::string_view bytes);
  Statement& bind(std::int64_t value);
  bool row();  ///< false: there is none left; throws JournalError
  void run();
  std::string text(int column) const;
  std::int64_t number(int column) const;

 private:
  sqlite3* database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

/// Gives the columns of a goal's row: issuer, id, request, state, reason, arrival, plan_version.
struct GoalRow {
  std::function<std::string(int column)> text;
  std::function<std::int64_t(int column)> number;
};
/// Reads the goal in a row. Throws JournalError for a row that is damaged.
goals::GoalRecord goal_in(const GoalRow& row);

/// Keeps the open database, and the changes since the last commit until the disk has taken them.
struct Journal::Database {
  Database(const std::filesystem::path& file, Durability durability);
  explicit Database(const std::filesystem::path& file);  ///< to read alone
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const char* sql) const;
  /// Makes a change in the open transaction (a new one, if there is none). While the disk takes nothing the change is
  /// kept, and the commit makes it.
  void change(std::function<void()> make);
  void commit();
  void roll_back();
  /// Returns the number of the next record, which is fixed here, whenever the change that writes the record
  /// is made.
  std::int64_t take_record_number();
  Position position() const;
  void set_position(const Position& position);
  Extent extent() const;
  /// Brings the mark up to date; it is called after each commit.
  void note_extent();

  sqlite3* handle = nullptr;
  std::unique_ptr<Statement> append_record;  ///< none where the journal is read alone
  std::optional<std::uint64_t> epoch;        ///< commits are batches of it
  std::vector<Batch> batches;                ///< not taken yet
  bool open_transaction = false;
  DiskWait disk_wait;
  std::optional<HighWaterMark> mark;  ///< of how far this journal was written, where it is watched

 private:
  void begin();
  std::optional<Batch> record_changes();
  void write();
  void close();
  /// Says what to do about a file that cannot be opened, and about one that is something else.
  struct Remedy {
    std::string unopened, foreign;
  };
  /// Runs `settle` on the file just opened; closes it, and names it, in each error.
  void open_as_journal(const std::filesystem::path& file, int status, const Remedy& remedy,
                       const std::function<void()>& settle);

  sqlite3_session* session_ = nullptr;          ///< of the open transaction, if it becomes a batch
  std::vector<std::function<void()>> changes_;  ///< since the last commit
  bool rolled_back_ = false;                    ///< by the disk: changes_ are to be made again
  std::int64_t next_record_ = 1;
  int exceptions_;  ///< that were under way when it was opened
};

}  // namespace roci::exec::journal
