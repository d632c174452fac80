#include "exec_svc/journal/salvage.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "exec_svc/journal/database.hpp"
#include "exec_svc/journal/database_files.hpp"
#include "exec_svc/journal/first_page.hpp"
#include "exec_svc/journal/format.hpp"
#include "exec_svc/journal/high_water_mark.hpp"

namespace roci::exec::journal {

using goals::GoalKey;
using goals::GoalRecord;

namespace {

namespace fs = std::filesystem;

// Owns a connection that takes a database as it is.
class Connection {
 public:
  explicit Connection(const fs::path& file) {
    const int status = sqlite3_open_v2(file.c_str(), &handle_, SQLITE_OPEN_READWRITE, nullptr);
    sqlite3_busy_timeout(handle_, 5000);
    if (status != SQLITE_OK) close_and_throw();
  }
  ~Connection() { sqlite3_close(handle_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Visits rows until there is none left or one cannot be read; returns false for the latter. Throws DiskError where
  /// the disk, and not what stands on it, is the cause.
  bool rows(const std::string& sql, const std::function<void(sqlite3_stmt*)>& visit) const {
    sqlite3_stmt* opened = nullptr;
    if (sqlite3_prepare_v2(handle_, sql.c_str(), -1, &opened, nullptr) != SQLITE_OK) return is_damaged();
    const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement(opened, sqlite3_finalize);
    int status = SQLITE_OK;
    while ((status = sqlite3_step(opened)) == SQLITE_ROW) visit(opened);
    return status == SQLITE_DONE || is_damaged();
  }
  sqlite3* handle() const { return handle_; }
  /// Returns the first column of the first row or, if there is none, what went wrong.
  std::string word(const std::string& sql) const {
    std::string out;
    const bool read = rows(sql, [&out](sqlite3_stmt* row) {
      const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, 0));
      if (out.empty() && text != nullptr) out = text;
    });
    return read || !out.empty() ? out : sqlite3_errmsg(handle_);
  }

 private:
  /// Returns false, or throws DiskError.
  bool is_damaged() const {
    if (is_of_the_disk(handle_)) throw DiskError(sqlite3_errmsg(handle_));
    return false;
  }
  [[noreturn]] void close_and_throw() {
    const std::string reason = sqlite3_errmsg(handle_);
    sqlite3_close(handle_);
    throw JournalError(reason);
  }

  sqlite3* handle_ = nullptr;
};

std::string text_of(sqlite3_stmt* row, int column) {
  const auto* data = static_cast<const char*>(sqlite3_column_blob(row, column));
  return data == nullptr ? ""
                         : std::string(data, static_cast<std::size_t>(sqlite3_column_bytes(row, column)));
}

// Looks at the file as SQLite sees it. SQLite itself may write the log into the file, and remove it, as it closes both.
std::string damage_of_database(const fs::path& file) {
  const Connection database(file);
  const std::string check = database.word("PRAGMA quick_check(1)");
  if (check != "ok") return check;
  const std::string tables = database.word("SELECT count(*) FROM sqlite_schema WHERE type = 'table'");
  const std::string records = database.word("SELECT count(*) FROM sqlite_schema WHERE name = 'record'");
  const StatedFormat stated = stated_format(database.handle());
  if (stated.contradicts_itself()) return to_text(stated);
  // The journal itself refuses a newer one.
  return stated.newer() || tables == "0" || records == "1" ? "" : "it holds tables of something else";
}

struct Record {
  temporal::Time time{0};
  std::string kind;
  std::string text;
};

// Holds what was read of a damaged journal.
struct Remains {
  std::map<GoalKey, GoalRecord> goals;
  std::size_t goals_lost = 0;  // rows of them that say nothing
  std::map<std::string, std::int64_t> numbers;
  std::map<std::int64_t, Record> records;
  bool whole = true;  // no table breaks off
  bool empty() const { return goals.empty() && records.empty() && numbers.empty(); }
};

bool can_be_repeated(const std::string& kind) {
  return kind == "input" || kind == "anchor" || kind == "restored";
}

// Reads from both ends, so that one bad page in the middle costs no other row.
void read_table(const Connection& database, const std::string& select, const std::string& key,
                Remains& remains, const std::function<void(sqlite3_stmt*)>& visit) {
  if (database.rows(select + " ORDER BY " + key, visit)) return;
  remains.whole = false;
  database.rows(select + " ORDER BY " + key + " DESC", visit);
}

void read_goals(const Connection& database, Remains& remains) {
  read_table(
      database, "SELECT issuer, id, request, state, reason, arrival, plan_version FROM goal NOT INDEXED",
      "rowid", remains, [&remains](sqlite3_stmt* row) {
        try {
          GoalRecord goal = goal_in(GoalRow{[row](int column) { return text_of(row, column); },
                                            [row](int column) { return sqlite3_column_int64(row, column); }});
          GoalKey key = goal.request.key;
          remains.goals.emplace(std::move(key), std::move(goal));
        } catch (const JournalError&) {
          ++remains.goals_lost;
        }
      });
}

Remains read_remains(const fs::path& file) {
  Remains remains;
  const Connection database(file);
  // Lets SQLite read a file that is shorter than its header says, and one whose schema is not as it should be.
  database.word("PRAGMA writable_schema = ON");
  read_goals(database, remains);
  read_table(database, "SELECT name, value FROM number NOT INDEXED", "rowid", remains,
             [&remains](sqlite3_stmt* row) {
               remains.numbers.emplace(text_of(row, 0), sqlite3_column_int64(row, 1));
             });
  read_table(database, "SELECT seq, time_us, kind, text FROM record", "seq", remains,
             [&remains](sqlite3_stmt* row) {
               Record record{temporal::Time(sqlite3_column_int64(row, 1)), text_of(row, 2), text_of(row, 3)};
               if (!can_be_repeated(record.kind))
                 remains.records.emplace(sqlite3_column_int64(row, 0), std::move(record));
             });
  return remains;
}

void copy_database(const fs::path& from, const fs::path& to) {
  remove_database(to);
  for (const char* suffix : {"", "-wal"}) {
    const fs::path part = fs::path(from).concat(suffix);
    if (fs::exists(part)) fs::copy_file(part, fs::path(to).concat(suffix));
  }
}

// Works on a copy: SQLite itself changes what it opens.
Remains read_copy(const fs::path& file, const fs::path& template_file) {
  const fs::path copy = fs::path(file).concat(".salvage");
  const auto attempt = [&](const std::function<void()>& prepare) {
    Remains remains;
    try {
      copy_database(file, copy);
      prepare();
      remains = read_remains(copy);
    } catch (const DiskError&) {
      remove_database(copy);
      throw;
    } catch (const JournalError&) {
      remains.whole = false;
    }
    remove_database(copy);
    return remains;
  };
  Remains remains = attempt([] {});
  if (!remains.empty()) return remains;
  // Nothing but the first page says where a table begins, and every journal has it alike.
  remains = attempt([&] {
    if (!replace_first_page(copy, template_file)) throw JournalError("no database");
  });
  remains.whole = false;
  return remains;
}

// Returns whether a number means something by itself, and the value lies within its range.
bool is_plausible(const std::string& name, std::int64_t value) {
  if (name == "epoch" || name == "plan_version") return value >= 0 && value < std::int64_t{1} << 31;
  if (name == "autonomy") return value >= 0 && value <= 3;
  if (name == "held") return value == 0 || value == 1;
  return false;
}

std::string summary_of(const std::string& file, const std::string& damage, const Remains& remains,
                       const fs::path& kept) {
  const std::string lost =
      remains.goals_lost == 0 ? "" : ", " + std::to_string(remains.goals_lost) + " could not";
  return "the journal " + file + " was damaged (" + damage + ") and is kept as " + kept.string() + "; " +
         std::to_string(remains.goals.size()) + " goals" + lost + " and " +
         std::to_string(remains.records.size()) + " records could be read" +
         (remains.whole ? "" : ", what else stood there is not known") +
         ". All is planned anew; send again what was acknowledged and is missing";
}

void write_remains(const fs::path& file, const Remains& remains, const std::string& damage) {
  Journal journal(file, Durability::process);
  for (const auto& [key, goal] : remains.goals) journal.put_goal(goal);
  for (const auto& [name, value] : remains.numbers) journal.set_number(name, value);
  temporal::Time last{0};
  for (const auto& [number, record] : remains.records) {
    journal.append(record.time, record.kind, record.text);
    last = std::max(last, record.time);
  }
  journal.append(last, "event", "journal.damaged " + damage);
  journal.set_text(kDamage, damage);
  journal.set_position(kForkedHistory);
  journal.commit();
  journal.checkpoint();
}

// The mark has an epoch, too, and the later one counts. What means nothing by itself must not outdo it.
void settle_numbers(Remains& remains, const std::optional<Extent>& mark) {
  if (mark) {
    const auto row = remains.numbers.find("epoch");
    const bool later =
        row == remains.numbers.end() || !is_plausible("epoch", row->second) || row->second < mark->epoch;
    if (later) remains.numbers["epoch"] = mark->epoch;
  }
  std::erase_if(remains.numbers, [](const auto& one) { return !is_plausible(one.first, one.second); });
}

// Names a new journal that is complete, on the disk, and not in its place yet.
fs::path ready_name(const fs::path& file) { return fs::path(file).concat(".salvaged"); }

void quarantine(const fs::path& file, const fs::path& kept) {
  std::error_code none;
  fs::remove(fs::path(file).concat("-shm"), none);
  if (fs::exists(fs::path(file).concat("-wal")))
    put_in_place(fs::path(file).concat("-wal"), fs::path(kept).concat("-wal"), Durability::power);
  const fs::path mark = HighWaterMark(file).file();
  if (fs::exists(mark)) put_in_place(mark, HighWaterMark(kept).file(), Durability::power);
  put_in_place(file, kept, Durability::power);
}

// Puts the new journal that is ready in the place of the damaged one, which is kept. Each step but the last can be
// repeated.
void put_ready_in_place(const fs::path& file, const fs::path& kept) {
  if (fs::exists(file)) quarantine(file, kept);
  put_in_place(ready_name(file), file, Durability::power);
}

}  // namespace

std::string damage_of(const fs::path& file) {
  if (!fs::exists(file)) return "";
  if (!fs::is_regular_file(file)) return "it is no file";
  const fs::path log = fs::path(file).concat("-wal");
  if (fs::file_size(file) == 0 && (!fs::exists(log) || fs::file_size(log) == 0)) return "it is empty";
  try {
    std::string damage = damage_of_database(file);
    if (!damage.empty()) return damage;
    const Journal journal(file, Durability::process);
    journal.goals();
    journal.peers();
    journal.number("epoch", 0);
    journal.text("mission");
    journal.position();
    return "";
  } catch (const NewerJournal&) {
    throw;
  } catch (const DiskError&) {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  }
}

void salvage_if_damaged(const fs::path& file) {
  const fs::path mended = fs::path(file).concat(".mended"), ready = ready_name(file);
  const fs::path kept = free_damaged_name(file);
  try {
    if (fs::exists(ready)) return put_ready_in_place(file, kept);  // it was stopped between the renames
    const std::string damage = damage_of(file);
    if (damage.empty()) return;
    remove_database(mended);
    { const Journal empty(mended, Durability::process); }
    Remains remains;
    if (fs::is_regular_file(file)) {
      remains = read_copy(file, mended);
    } else {
      remains.whole = false;
    }
    settle_numbers(remains, HighWaterMark(file).read());
    write_remains(mended, remains, summary_of(file.filename().string(), damage, remains, kept));
    remove_database_logs(mended);
    if (const std::string lost = damage_of(mended); !lost.empty())
      throw DiskError(mended.string() + " does not hold what was written into it: " + lost);
    sync_path(mended);
    put_in_place(mended, ready, Durability::power);
    put_ready_in_place(file, kept);
  } catch (const fs::filesystem_error& error) {
    const bool of_the_disk =
        error.code() == std::errc::no_space_on_device || error.code() == std::errc::io_error;
    if (of_the_disk) throw DiskError(error.what());
    throw JournalError(error.what());
  }
}

}  // namespace roci::exec::journal
