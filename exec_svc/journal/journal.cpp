#include "exec_svc/journal/journal.hpp"

#include <sqlite3.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace roci::exec {
namespace {

constexpr char kSchema[] =
    "CREATE TABLE IF NOT EXISTS number(name TEXT PRIMARY KEY, value INTEGER NOT NULL);"
    "CREATE TABLE IF NOT EXISTS setting(name TEXT PRIMARY KEY, value TEXT NOT NULL);"
    "CREATE TABLE IF NOT EXISTS goal(issuer TEXT, id TEXT, request TEXT NOT NULL, state INTEGER NOT NULL, "
    "reason TEXT NOT NULL,"
    " arrival INTEGER NOT NULL, plan_version INTEGER NOT NULL, PRIMARY KEY(issuer, id));"
    "CREATE TABLE IF NOT EXISTS peer(service TEXT PRIMARY KEY, incarnation INTEGER NOT NULL);"
    "CREATE TABLE IF NOT EXISTS record(seq INTEGER PRIMARY KEY, time_us INTEGER NOT NULL, kind TEXT NOT "
    "NULL, text TEXT NOT NULL);";

std::string encode(const GoalRequest& goal) {
  return nlohmann::json{{"kind", goal.kind},
                        {"arguments", goal.arguments},
                        {"class", static_cast<int>(goal.importance)},
                        {"utility", goal.utility},
                        {"priority", goal.priority},
                        {"opens", goal.opens.count()},
                        {"closes", goal.closes.count()},
                        {"recalled", goal.recalled}}
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);  // rejected goals may hold anything
}

// JSON knows no NaN: it stands there as null.
double number_of(const nlohmann::json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

GoalRequest decode(GoalKey key, const std::string& text) {
  const auto json = nlohmann::json::parse(text);
  GoalRequest goal;
  goal.key = std::move(key);
  goal.kind = json.at("kind").get<std::string>();
  goal.arguments = json.at("arguments").get<std::map<std::string, std::string>>();
  goal.importance = static_cast<GoalClass>(json.at("class").get<int>());
  goal.utility = number_of(json.at("utility"));
  goal.priority = json.at("priority").get<std::int32_t>();
  goal.opens = temporal::Time(json.at("opens").get<std::int64_t>());
  goal.closes = temporal::Time(json.at("closes").get<std::int64_t>());
  goal.recalled = json.at("recalled").get<bool>();
  return goal;
}

// A prepared statement; bound values are copied.
class Statement {
 public:
  Statement(sqlite3* database, const char* sql) : database_(database) {
    if (sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr) != SQLITE_OK)
      throw JournalError(sqlite3_errmsg(database));
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(std::string_view text) {
    sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
    return *this;
  }
  Statement& bind_bytes(std::string_view bytes) {
    sqlite3_bind_blob64(statement_, ++bound_, bytes.data(), bytes.size(), SQLITE_TRANSIENT);
    return *this;
  }
  Statement& bind(std::int64_t value) {
    sqlite3_bind_int64(statement_, ++bound_, value);
    return *this;
  }
  bool row() {
    const int status = sqlite3_step(statement_);
    if (status == SQLITE_ROW) return true;
    if (status == SQLITE_DONE) return false;
    throw JournalError(std::string("journal: ") + sqlite3_errmsg(database_));
  }
  void run() {
    row();
    sqlite3_reset(statement_);
    bound_ = 0;
  }
  std::string text(int column) const {
    const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_, column));
    return data == nullptr
               ? ""
               : std::string(data, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
  }
  std::int64_t number(int column) const { return sqlite3_column_int64(statement_, column); }

 private:
  sqlite3* database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

}  // namespace

struct Journal::Database {
  Database(const std::filesystem::path& file, Durability durability) {
    if (sqlite3_open(file.c_str(), &handle) != SQLITE_OK) {
      const std::string reason = sqlite3_errmsg(handle);
      sqlite3_close(handle);
      throw JournalError("cannot open the journal " + file.string() + ": " + reason +
                         "; check that its folder can be written");
    }
    try {
      execute("PRAGMA journal_mode=WAL;");
      execute(durability == Durability::power ? "PRAGMA synchronous=FULL;" : "PRAGMA synchronous=OFF;");
      execute(kSchema);
      append_record =
          std::make_unique<Statement>(handle, "INSERT INTO record(time_us, kind, text) VALUES(?,?,?)");
    } catch (const JournalError& error) {
      append_record.reset();
      sqlite3_close(handle);
      throw JournalError(file.string() + " is not a usable journal (" + error.what() +
                         "); move it away or choose another --run-folder");
    }
  }
  ~Database() {
    if (open_transaction) sqlite3_exec(handle, "COMMIT", nullptr, nullptr, nullptr);
    append_record.reset();
    sqlite3_close(handle);
  }
  void execute(const char* sql) const {
    if (sqlite3_exec(handle, sql, nullptr, nullptr, nullptr) != SQLITE_OK)
      throw JournalError(sqlite3_errmsg(handle));
  }
  void begin() {
    if (open_transaction) return;
    execute("BEGIN");
    open_transaction = true;
  }
  sqlite3* handle = nullptr;
  std::unique_ptr<Statement> append_record;
  bool open_transaction = false;
};

Journal::Journal(const std::filesystem::path& file, Durability durability)
    : database_(std::make_unique<Database>(file, durability)) {}

Journal::~Journal() = default;

void Journal::commit() {
  if (!database_->open_transaction) return;
  database_->execute("COMMIT");
  database_->open_transaction = false;
}

std::uint64_t Journal::next_epoch() {
  const std::int64_t epoch = number("epoch", 0) + 1;
  set_number("epoch", epoch);
  commit();
  return static_cast<std::uint64_t>(epoch);
}

void Journal::put_goal(const GoalRecord& record) {
  database_->begin();
  Statement(database_->handle, "INSERT OR REPLACE INTO goal VALUES(?,?,?,?,?,?,?)")
      .bind(record.request.key.issuer)
      .bind(record.request.key.id)
      .bind(encode(record.request))
      .bind(static_cast<std::int64_t>(record.state))
      .bind(record.reason)
      .bind(static_cast<std::int64_t>(record.arrival))
      .bind(static_cast<std::int64_t>(record.plan_version))
      .run();
}

std::vector<GoalRecord> Journal::goals() const {
  Statement rows(
      database_->handle,
      "SELECT issuer, id, request, state, reason, arrival, plan_version FROM goal ORDER BY arrival");
  std::vector<GoalRecord> out;
  while (rows.row()) {
    GoalRecord record;
    record.request = decode({rows.text(0), rows.text(1)}, rows.text(2));
    record.state = static_cast<GoalState>(rows.number(3));
    record.reason = rows.text(4);
    record.arrival = static_cast<std::uint64_t>(rows.number(5));
    record.plan_version = static_cast<std::uint32_t>(rows.number(6));
    out.push_back(std::move(record));
  }
  return out;
}

void Journal::put_peer(const std::string& service, std::uint32_t incarnation) {
  database_->begin();
  Statement(database_->handle, "INSERT OR REPLACE INTO peer VALUES(?,?)")
      .bind(service)
      .bind(static_cast<std::int64_t>(incarnation))
      .run();
}

void Journal::remove_peer(const std::string& service) {
  database_->begin();
  Statement(database_->handle, "DELETE FROM peer WHERE service = ?").bind(service).run();
}

std::map<std::string, std::uint32_t> Journal::peers() const {
  Statement rows(database_->handle, "SELECT service, incarnation FROM peer");
  std::map<std::string, std::uint32_t> out;
  while (rows.row()) out[rows.text(0)] = static_cast<std::uint32_t>(rows.number(1));
  return out;
}

void Journal::append(temporal::Time time, std::string_view kind, std::string_view text) {
  database_->begin();
  database_->append_record->bind(time.count()).bind(kind).bind(text).run();
}

std::int64_t Journal::append_bytes(temporal::Time time, std::string_view kind, std::string_view bytes) {
  database_->begin();
  database_->append_record->bind(time.count()).bind(kind).bind_bytes(bytes).run();
  return sqlite3_last_insert_rowid(database_->handle);
}

void Journal::forget_inputs_before(std::int64_t number) {
  database_->begin();
  Statement(database_->handle, "DELETE FROM record WHERE seq < ? AND kind IN ('input', 'anchor', 'restored')")
      .bind(number)
      .run();
}

void Journal::for_each_from(std::int64_t number, const Visit& visit) const {
  Statement rows(database_->handle, "SELECT time_us, kind, text FROM record WHERE seq >= ? ORDER BY seq");
  rows.bind(number);
  while (rows.row()) visit(temporal::Time(rows.number(0)), rows.text(1), rows.text(2));
}

void Journal::set_text(std::string_view name, std::string_view value) {
  database_->begin();
  Statement(database_->handle, "INSERT OR REPLACE INTO setting VALUES(?,?)").bind(name).bind(value).run();
}

std::string Journal::text(std::string_view name) const {
  Statement row(database_->handle, "SELECT value FROM setting WHERE name = ?");
  row.bind(name);
  return row.row() ? row.text(0) : "";
}

void Journal::set_number(std::string_view name, std::int64_t value) {
  database_->begin();
  Statement(database_->handle, "INSERT OR REPLACE INTO number VALUES(?,?)").bind(name).bind(value).run();
}

std::int64_t Journal::number(std::string_view name, std::int64_t fallback) const {
  Statement row(database_->handle, "SELECT value FROM number WHERE name = ?");
  row.bind(name);
  return row.row() ? row.number(0) : fallback;
}

}  // namespace roci::exec
