#include "exec_svc/journal/database.hpp"

#define SQLITE_ENABLE_SESSION
#define SQLITE_ENABLE_PREUPDATE_HOOK
#include <sqlite3.h>

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

}  // namespace

Statement::Statement(const Journal::Database& database, const char* sql) : database_(database.handle) {
  if (sqlite3_prepare_v2(database_, sql, -1, &statement_, nullptr) != SQLITE_OK)
    throw JournalError(sqlite3_errmsg(database_));
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
  throw JournalError(std::string("journal: ") + sqlite3_errmsg(database_));
}

void Statement::run() {
  row();
  sqlite3_reset(statement_);
  bound_ = 0;
}

std::string Statement::text(int column) const {
  const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_, column));
  return data == nullptr
             ? ""
             : std::string(data, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
}

std::int64_t Statement::number(int column) const { return sqlite3_column_int64(statement_, column); }

Journal::Database::Database(const std::filesystem::path& file, Durability durability) {
  if (sqlite3_open(file.c_str(), &handle) != SQLITE_OK) {
    const std::string reason = sqlite3_errmsg(handle);
    sqlite3_close(handle);
    throw JournalError("cannot open the journal " + file.string() + ": " + reason +
                       "; check that its folder can be written");
  }
  try {
    execute("PRAGMA journal_mode=WAL;");
    execute(durability == Durability::power ? "PRAGMA synchronous=FULL;" : "PRAGMA synchronous=OFF;");
    settle_format(handle);
    execute(kSchema);
    append_record =
        std::make_unique<Statement>(*this, "INSERT INTO record(time_us, kind, text) VALUES(?,?,?)");
  } catch (const NewerJournal& error) {
    close();
    throw NewerJournal(file.string() + " is not a usable journal: " + error.what());
  } catch (const JournalError& error) {
    close();
    throw JournalError(file.string() + " is not a usable journal (" + error.what() +
                       "); move it away or choose another --run-folder");
  }
}

Journal::Database::~Database() {
  if (open_transaction) sqlite3_exec(handle, "COMMIT", nullptr, nullptr, nullptr);
  close();
}

void Journal::Database::close() {
  if (session_ != nullptr) sqlite3session_delete(session_);
  append_record.reset();
  sqlite3_close(handle);
}

void Journal::Database::execute(const char* sql) const {
  if (sqlite3_exec(handle, sql, nullptr, nullptr, nullptr) != SQLITE_OK)
    throw JournalError(sqlite3_errmsg(handle));
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

void Journal::Database::commit() {
  if (!open_transaction) return;
  if (session_ != nullptr) record_changes();
  execute("COMMIT");
  open_transaction = false;
}

void Journal::Database::roll_back() {
  open_transaction = false;
  execute("ROLLBACK");
}

void Journal::Database::record_changes() {
  int size = 0;
  void* bytes = nullptr;
  const int status = sqlite3session_changeset(session_, &size, &bytes);
  sqlite3session_delete(session_);
  session_ = nullptr;
  const std::unique_ptr<void, decltype(&sqlite3_free)> owned(bytes, sqlite3_free);
  if (status != SQLITE_OK) throw JournalError("the changes of a commit could not be recorded");
  if (size == 0) return;
  const Position before = position();
  const Position after{*epoch, before.sequence + 1};
  set_position(after);
  batches.push_back(
      {before, after, std::string(static_cast<const char*>(bytes), static_cast<std::size_t>(size))});
}

std::int64_t Journal::Database::last_row() const { return sqlite3_last_insert_rowid(handle); }

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

}  // namespace roci::exec::journal
