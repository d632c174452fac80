#include "exec_svc/journal/database.hpp"

#define SQLITE_ENABLE_SESSION
#define SQLITE_ENABLE_PREUPDATE_HOOK
#include <sqlite3.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "exec_svc/journal/format.hpp"

namespace roci::exec::journal {
namespace {

// "position" is this copy's own; a batch changes the other tables.
constexpr char kSchema[] =
    "CREATE TABLE IF NOT EXISTS number(name TEXT PRIMARY KEY, value INTEGER NOT NULL);"
    "CREATE TABLE IF NOT EXISTS setting(name TEXT PRIMARY KEY, value TEXT NOT NULL);"
    "CREATE TABLE IF NOT EXISTS goal(issuer TEXT, id TEXT, request TEXT NOT NULL, state INTEGER NOT NULL, "
    "reason TEXT NOT NULL,"
    " arrival INTEGER NOT NULL, plan_version INTEGER NOT NULL, PRIMARY KEY(issuer, id));"
    "CREATE TABLE IF NOT EXISTS peer(service TEXT PRIMARY KEY, incarnation INTEGER NOT NULL);"
    "CREATE TABLE IF NOT EXISTS record(seq INTEGER PRIMARY KEY, time_us INTEGER NOT NULL, kind TEXT NOT "
    "NULL, text TEXT NOT NULL);"
    "CREATE TABLE IF NOT EXISTS position(row INTEGER PRIMARY KEY CHECK(row = 1), epoch INTEGER NOT NULL, "
    "sequence INTEGER NOT NULL);";

// Bounds the wait for another program that reads or copies the journal at this moment.
constexpr int kBusyTimeoutMs = 1000;

// Bounds the pages that SQLite keeps in memory, in KiB: its own bound is 2,000, up to which a process grows with its
// journal. A step appends at the end, a few pages.
constexpr char kCacheSize[] = "PRAGMA cache_size=-256;";

[[noreturn]] void fail(sqlite3* database, const std::string& before = "") {
  if (is_of_the_disk(database)) throw DiskError(before + sqlite3_errmsg(database));
  throw JournalError(before + sqlite3_errmsg(database));
}

}  // namespace

bool is_of_the_disk(sqlite3* database) {
  switch (sqlite3_extended_errcode(database)) {
    case SQLITE_FULL:
    case SQLITE_BUSY:
    case SQLITE_BUSY_RECOVERY:
    case SQLITE_BUSY_SNAPSHOT:
    case SQLITE_IOERR_WRITE:
    case SQLITE_IOERR_FSYNC:
    case SQLITE_IOERR_DIR_FSYNC:
    case SQLITE_IOERR_TRUNCATE:
    case SQLITE_IOERR_SHMOPEN:
    case SQLITE_IOERR_SHMSIZE:
    case SQLITE_IOERR_SHMMAP:
    case SQLITE_IOERR_GETTEMPPATH:
      return true;
    default:
      return false;
  }
}

Statement::Statement(const Journal::Database& database, const char* sql) : database_(database.handle) {
  if (sqlite3_prepare_v2(database_, sql, -1, &statement_, nullptr) != SQLITE_OK) fail(database_);
}

Statement::~Statement() { sqlite3_finalize(statement_); }

Statement& Statement::bind(std::string_view text) {
  sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  return *this;
}

Statement& Statement::bind_bytes(std::string_view bytes) {
  sqlite3_bind_blob64(statement_, ++bound_, bytes.data(), bytes.size(), SQLITE_TRANSIENT);
  return *this;
}

Statement& Statement::bind(std::int64_t value) {
  sqlite3_bind_int64(statement_, ++bound_, value);
  return *this;
}

bool Statement::row() {
  const int status = sqlite3_step(statement_);
  if (status == SQLITE_ROW) return true;
  if (status == SQLITE_DONE) return false;
  fail(database_, "journal: ");
}

void Statement::run() {
  // Whatever comes of it, the statement can be run again.
  const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_reset)> reset(statement_, sqlite3_reset);
  bound_ = 0;
  row();
}

std::string Statement::text(int column) const {
  const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_, column));
  return data == nullptr
             ? ""
             : std::string(data, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
}

std::int64_t Statement::number(int column) const { return sqlite3_column_int64(statement_, column); }

Journal::Database::Database(const std::filesystem::path& file, Durability durability)
    : exceptions_(std::uncaught_exceptions()) {
  const int status = sqlite3_open(file.c_str(), &handle);
  const Remedy remedy{"check that its folder can be written", "move it away or choose another --run-folder"};
  open_as_journal(file, status, remedy, [this, durability] {
    execute("PRAGMA journal_mode=WAL;");
    execute(kCacheSize);
    execute(durability == Durability::power ? "PRAGMA synchronous=FULL;" : "PRAGMA synchronous=OFF;");
    settle_format(handle);
    execute(kSchema);
    append_record =
        std::make_unique<Statement>(*this, "INSERT INTO record(seq, time_us, kind, text) VALUES(?,?,?,?)");
  });
}

Journal::Database::Database(const std::filesystem::path& file) : exceptions_(std::uncaught_exceptions()) {
  const int status = sqlite3_open_v2(file.c_str(), &handle, SQLITE_OPEN_READONLY, nullptr);
  const std::string give = "give a run folder, or one of the journals in it";
  open_as_journal(file, status, {give, give}, [this] {
    require_known_format(stated_format(handle));
    execute(
        "SELECT seq, time_us, kind, text FROM record LIMIT 1;"
        "SELECT name, value FROM number LIMIT 1; SELECT name, value FROM setting LIMIT 1;");
  });
}

void Journal::Database::open_as_journal(const std::filesystem::path& file, int status,
                                        const Remedy& remedy, const std::function<void()>& settle) {
  if (status != SQLITE_OK) {
    const std::string reason = sqlite3_errmsg(handle);
    sqlite3_close(handle);
    throw JournalError("cannot open the journal " + file.string() + ": " + reason + "; " + remedy.unopened);
  }
  sqlite3_busy_timeout(handle, kBusyTimeoutMs);
  try {
    settle();
  } catch (const NewerJournal& error) {
    close();
    throw NewerJournal(file.string() + " is not a usable journal: " + error.what());
  } catch (const DiskError& error) {
    close();
    throw DiskError("the journal " + file.string() + " cannot be written: " + error.what());
  } catch (const JournalError& error) {
    close();
    throw JournalError(file.string() + " is not a usable journal (" + error.what() + "); " + remedy.foreign);
  }
}

// Half a step that an exception has cut off never becomes durable.
Journal::Database::~Database() {
  try {
    if (std::uncaught_exceptions() > exceptions_) {
      if (open_transaction) roll_back();
    } else {
      write();
    }
  } catch (const JournalError&) {
    // There is nobody left to tell; the file is as after the last commit.
  }
  close();
}

void Journal::Database::close() {
  if (session_ != nullptr) sqlite3session_delete(session_);
  append_record.reset();
  sqlite3_close(handle);
}

void Journal::Database::execute(const char* sql) const {
  if (sqlite3_exec(handle, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail(handle);
}

void Journal::Database::begin() {
  if (open_transaction) return;
  execute("BEGIN");
  open_transaction = true;
  if (!epoch) return;
  if (sqlite3session_create(handle, "main", &session_) != SQLITE_OK ||
      sqlite3session_attach(session_, nullptr) != SQLITE_OK)
    throw JournalError("changes of the journal cannot be recorded by this SQLite");
}

void Journal::Database::change(std::function<void()> make) {
  changes_.push_back(std::move(make));
  if (rolled_back_) return;
  try {
    begin();
    changes_.back()();
  } catch (const DiskError&) {
    roll_back();
    rolled_back_ = true;
  }
}

// Writes the changes. Throws DiskError with everything as before the transaction, and the changes kept.
void Journal::Database::write() {
  try {
    if (std::exchange(rolled_back_, false)) {
      begin();
      for (const auto& make : changes_) make();
    }
    if (!open_transaction) return;
    auto batch = record_changes();
    execute("COMMIT");
    open_transaction = false;
    changes_.clear();
    note_extent();
    if (batch) batches.push_back(std::move(*batch));
  } catch (const DiskError&) {
    roll_back();
    rolled_back_ = true;
    throw;
  }
}

void Journal::Database::commit() {
  for (bool waited = false;; waited = true) {
    try {
      write();
      if (waited && disk_wait.over) disk_wait.over();
      return;
    } catch (const DiskError& error) {
      if (!disk_wait.wait) throw;
      disk_wait.wait(error.what());
    }
  }
}

void Journal::Database::roll_back() {
  if (session_ != nullptr) sqlite3session_delete(std::exchange(session_, nullptr));
  open_transaction = false;
  // SQLite may have rolled back by itself.
  if (sqlite3_get_autocommit(handle) == 0) execute("ROLLBACK");
}

std::optional<Batch> Journal::Database::record_changes() {
  if (session_ == nullptr) return std::nullopt;
  int size = 0;
  void* bytes = nullptr;
  const int status = sqlite3session_changeset(session_, &size, &bytes);
  sqlite3session_delete(std::exchange(session_, nullptr));
  const std::unique_ptr<void, decltype(&sqlite3_free)> owned(bytes, sqlite3_free);
  if (status != SQLITE_OK) throw JournalError("the changes of a commit could not be recorded");
  if (size == 0) return std::nullopt;
  const Position before = position();
  const Position after{*epoch, before.sequence + 1};
  set_position(after);
  return Batch{before, after, std::string(static_cast<const char*>(bytes), static_cast<std::size_t>(size))};
}

// An applied batch may have brought records, and records that the disk has rolled back keep their numbers.
std::int64_t Journal::Database::take_record_number() {
  Statement newest(*this, "SELECT COALESCE(MAX(seq), 0) FROM record");
  newest.row();
  next_record_ = std::max(next_record_, newest.number(0) + 1);
  return next_record_++;
}

Position Journal::Database::position() const {
  Statement row(*this, "SELECT epoch, sequence FROM position");
  if (!row.row()) return {};
  return {static_cast<std::uint64_t>(row.number(0)), static_cast<std::uint64_t>(row.number(1))};
}

void Journal::Database::set_position(const Position& position) {
  Statement(*this, "INSERT OR REPLACE INTO position VALUES(1,?,?)")
      .bind(static_cast<std::int64_t>(position.epoch))
      .bind(static_cast<std::int64_t>(position.sequence))
      .run();
}

Extent Journal::Database::extent() const {
  Statement row(
      *this,
      "SELECT (SELECT COALESCE(MAX(seq), 0) FROM record), (SELECT value FROM number WHERE name = 'epoch')");
  row.row();
  return {.epoch = row.number(1), .record = row.number(0)};
}

void Journal::Database::note_extent() {
  if (!mark) return;
  try {
    mark->write(extent());
  } catch (const JournalError&) {
    // The commit stands, and the mark stays that of the one before.
  }
}

}  // namespace roci::exec::journal
