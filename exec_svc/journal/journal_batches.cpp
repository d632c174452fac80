// This file writes the journal as a sequence of batches, and makes a journal from another one's.
#define SQLITE_ENABLE_SESSION
#define SQLITE_ENABLE_PREUPDATE_HOOK
#include <sqlite3.h>

#include <fstream>
#include <limits>
#include <utility>

#include "exec_svc/journal/database.hpp"
#include "exec_svc/journal/database_files.hpp"

namespace roci::exec::journal {
namespace {

namespace fs = std::filesystem;

int refuse_conflict(void*, int, sqlite3_changeset_iter*) { return SQLITE_CHANGESET_ABORT; }

std::string position_text(const Position& position) {
  return std::to_string(position.epoch) + ":" + std::to_string(position.sequence);
}

// Throws JournalError if the file is not a whole journal, DiskError where the disk does not let it be told.
void check(const fs::path& file) {
  std::string verdict;
  try {
    Journal::Database database(file, Durability::process);
    Statement row(database, "PRAGMA quick_check");
    verdict = row.row() ? row.text(0) : "empty";
  } catch (const DiskError&) {
    throw;
  } catch (const JournalError& error) {
    verdict = error.what();
  }
  if (verdict != "ok") throw JournalError("what came is not a whole journal: " + verdict);
}

void write(const fs::path& file, std::string_view bytes) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out.flush()) throw DiskError("cannot write " + file.string());
}

// The database that was there is gone, so there is nothing to go on with; whoever starts again waits for its disk.
std::unique_ptr<Journal::Database> open_replacement(const fs::path& file, Durability durability) {
  try {
    return std::make_unique<Journal::Database>(file, durability);
  } catch (const DiskError& error) {
    throw std::runtime_error(
        "the leader's journal has taken the place of this one and cannot be opened yet: " +
        std::string(error.what()));
  }
}

}  // namespace

void Journal::begin_epoch(std::uint64_t epoch) {
  commit();
  // What was written before there was a pair is in no batch, so an empty copy must not take it for its own
  // past. Nor may journals that were salvaged from different damaged ones take each other for the same.
  const bool nobodys_past = (position() == Position{} && !empty()) || position() == kForkedHistory;
  if (nobodys_past) database_->set_position({epoch, 0});
  database_->epoch = epoch;
  set_number("epoch", static_cast<std::int64_t>(epoch));
  commit();
}

bool Journal::empty() const {
  Statement row(*database_, "SELECT EXISTS(SELECT 1 FROM record) OR EXISTS(SELECT 1 FROM goal)");
  return !row.row() || row.number(0) == 0;
}

std::vector<Batch> Journal::take_batches() { return std::exchange(database_->batches, {}); }

Position Journal::position() const { return database_->position(); }

void Journal::apply(const Batch& batch) {
  if (position() != batch.after)
    throw JournalError("a batch after " + position_text(batch.after) + " for a journal at " +
                       position_text(position()));
  if (batch.changes.size() > std::numeric_limits<int>::max()) throw JournalError("a batch over 2 GB");
  std::string changes = batch.changes;  // SQLite asks for memory that it may write to
  database_->execute("BEGIN");
  const int status = sqlite3changeset_apply(database_->handle, static_cast<int>(changes.size()),
                                            changes.data(), nullptr, refuse_conflict, nullptr);
  if (status != SQLITE_OK) {
    database_->roll_back();
    throw JournalError("batch " + position_text(batch.at) +
                       " does not fit this journal: " + sqlite3_errstr(status));
  }
  try {
    database_->set_position(batch.at);
    database_->execute("COMMIT");
    database_->note_extent();
  } catch (const JournalError&) {
    database_->roll_back();
    throw;
  }
}

std::string Journal::serialized() const {
  // A connection of its own leaves out what is not committed yet.
  sqlite3* opened = nullptr;
  const int status = sqlite3_open_v2(file_.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> reader(opened, sqlite3_close);
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes(
      status == SQLITE_OK ? sqlite3_serialize(opened, "main", &size, 0) : nullptr, sqlite3_free);
  if (!bytes) throw JournalError("the journal " + file_.string() + " cannot be read as a whole");
  return {reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size)};
}

void Journal::checkpoint() {
  Statement checkpoint(*database_, "PRAGMA wal_checkpoint(TRUNCATE)");
  const bool whole = checkpoint.row() && checkpoint.number(0) == 0;
  if (!whole) throw DiskError("the log of " + file_.string() + " is in use and cannot be written into it");
}

void Journal::replace_with(std::string_view whole) {
  if (whole.empty()) throw JournalError("what came is not a whole journal: it is empty");
  const fs::path arrived = fs::path(file_).concat(".arrived");
  remove_database(arrived);
  try {
    write(arrived, whole);
    check(arrived);
  } catch (const JournalError&) {
    remove_database(arrived);
    throw;
  }
  if (durability_ == Durability::power) sync_path(arrived);
  DiskWait disk_wait = std::move(database_->disk_wait);
  std::optional<HighWaterMark> mark = std::move(database_->mark);
  if (mark) mark->remove();  // it is of the journal that goes
  database_.reset();
  remove_database_logs(file_);  // they belong to the database that goes
  put_in_place(arrived, file_, durability_);
  database_ = open_replacement(file_, durability_);
  database_->disk_wait = std::move(disk_wait);
  if (mark) database_->mark.emplace(std::move(*mark));
  database_->note_extent();
}

}  // namespace roci::exec::journal
