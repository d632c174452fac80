#include "exec_svc/journal/journal.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "exec_svc/journal/database.hpp"

namespace roci::exec::journal {

using goals::GoalClass;
using goals::GoalKey;
using goals::GoalRecord;
using goals::GoalRequest;
using goals::GoalState;
using goals::SampleId;

namespace {

nlohmann::json to_json(const SampleId& sample) {
  return {{"sender", sample.sender}, {"incarnation", sample.incarnation}, {"number", sample.number}};
}

SampleId sample_in(const nlohmann::json& json) {
  return {json.at("sender").get<std::string>(), json.at("incarnation").get<std::uint32_t>(),
          json.at("number").get<std::uint64_t>()};
}

SampleId sample_in(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  return found == json.end() ? SampleId{} : sample_in(*found);  // of an earlier version
}

std::string encode(const GoalRecord& record) {
  const GoalRequest& goal = record.request;
  nlohmann::json out{{"kind", goal.kind},
                     {"arguments", goal.arguments},
                     {"class", static_cast<int>(goal.importance)},
                     {"utility", goal.utility[0]},
                     {"priority", goal.priority},
                     {"opens", goal.opens.count()},
                     {"closes", goal.closes.count()},
                     {"recalled", goal.recalled},
                     {"said_in", to_json(goal.sample)},
                     {"answers", to_json(record.answers)}};
  // Members that baseline-05 did not know are written only where they say something.
  if (goal.utility.scores().size() > 1) out["ranks"] = goal.utility.scores();
  if (goal.preferred != temporal::no_bound) out["preferred"] = goal.preferred.count();
  if (!goal.robot.empty()) out["robot"] = goal.robot;
  if (record.revision != 0) out["revision"] = record.revision;
  for (const SampleId& sample : record.before) out["before"].push_back(to_json(sample));
  // Rejected goals may hold anything.
  return out.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// Reads a number; JSON has no NaN, which is written as null.
double number_of(const nlohmann::json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

// Reads a utility: a single rank stands under its first name, several under another one.
temporal::RankVector utility_in(const nlohmann::json& json) {
  const auto ranks = json.find("ranks");
  if (ranks == json.end()) return {number_of(json.at("utility"))};
  std::vector<double> scores;
  for (const nlohmann::json& score : *ranks) scores.push_back(number_of(score));
  return temporal::RankVector(std::move(scores));
}

// Reads an enumerator, at most `last`.
template <class Enum>
Enum enumerator(std::int64_t number, Enum last) {
  if (number < 0 || number > static_cast<std::int64_t>(last)) throw JournalError("a goal of no known kind");
  return static_cast<Enum>(number);
}

void decode(GoalKey key, const std::string& text, GoalRecord& record) {
  const auto json = nlohmann::json::parse(text);
  GoalRequest& goal = record.request;
  goal.key = std::move(key);
  goal.kind = json.at("kind").get<std::string>();
  goal.arguments = json.at("arguments").get<std::map<std::string, std::string>>();
  goal.importance = enumerator(json.at("class").get<std::int64_t>(), GoalClass::opportunistic);
  goal.utility = utility_in(json);
  goal.robot = json.value("robot", "");
  if (const auto preferred = json.find("preferred"); preferred != json.end())
    goal.preferred = temporal::Time(preferred->get<std::int64_t>());
  goal.priority = json.at("priority").get<std::int32_t>();
  goal.opens = temporal::Time(json.at("opens").get<std::int64_t>());
  goal.closes = temporal::Time(json.at("closes").get<std::int64_t>());
  goal.recalled = json.at("recalled").get<bool>();
  goal.sample = sample_in(json, "said_in");
  record.answers = sample_in(json, "answers");
  record.revision = json.value("revision", std::uint32_t{0});
  for (const nlohmann::json& sample : json.value("before", nlohmann::json::array()))
    goals::note_before(record, sample_in(sample));
}

}  // namespace

Journal::Journal(const std::filesystem::path& file, Durability durability)
    : file_(file), durability_(durability), database_(std::make_unique<Database>(file, durability)) {}

Journal::Journal(const std::filesystem::path& file)
    : file_(file), durability_(Durability::process), database_(std::make_unique<Database>(file)) {}

Journal::~Journal() = default;

void Journal::commit() { database_->commit(); }

void Journal::wait_for_disk(DiskWait wait) { database_->disk_wait = std::move(wait); }

std::string Journal::watch_extent() {
  commit();
  HighWaterMark mark(file_);
  const Extent marked = mark.read().value_or(Extent{});
  const Extent own = database_->extent();
  database_->mark.emplace(std::move(mark));
  if (marked.epoch <= own.epoch && marked.record <= own.record) {
    database_->note_extent();
    return "";
  }
  const std::string text = "the journal " + file_.filename().string() +
                           " has lost its end: it was written up to record " + std::to_string(marked.record) +
                           " in epoch " + std::to_string(marked.epoch) + " and goes up to record " +
                           std::to_string(own.record) + " in epoch " + std::to_string(own.epoch) +
                           ". All is planned anew; send again what was acknowledged and is missing";
  append(temporal::Time{0}, "event", "journal.shortened " + text);
  set_number("epoch", std::max(marked.epoch, own.epoch));
  set_text(kShortened, text);
  set_position(kForkedHistory);
  commit();
  return text;
}

std::uint64_t Journal::next_epoch() {
  const std::int64_t epoch = number("epoch", 0) + 1;
  set_number("epoch", epoch);
  commit();
  return static_cast<std::uint64_t>(epoch);
}

void Journal::put_goal(const GoalRecord& record) {
  database_->change([database = database_.get(), record] {
    Statement(*database, "INSERT OR REPLACE INTO goal VALUES(?,?,?,?,?,?,?)")
        .bind(record.request.key.issuer)
        .bind(record.request.key.id)
        .bind(encode(record))
        .bind(static_cast<std::int64_t>(record.state))
        .bind(record.reason)
        .bind(static_cast<std::int64_t>(record.arrival))
        .bind(static_cast<std::int64_t>(record.plan_version))
        .run();
  });
}

GoalRecord goal_in(const GoalRow& row) {
  GoalRecord record;
  const std::string damaged = "the journal's goal " + row.text(0) + "/" + row.text(1) + " is damaged";
  try {
    decode({row.text(0), row.text(1)}, row.text(2), record);
  } catch (const nlohmann::json::exception& error) {
    throw JournalError(damaged + ": " + error.what());
  }
  const std::int64_t state = row.number(3);
  const auto importance = record.request.importance;
  if (state < 0 || state > static_cast<std::int64_t>(GoalState::recalled) || importance < GoalClass::hard ||
      importance > GoalClass::opportunistic || row.text(0).empty() || row.text(1).empty())
    throw JournalError(damaged);
  record.state = static_cast<GoalState>(state);
  record.reason = row.text(4);
  record.arrival = static_cast<std::uint64_t>(row.number(5));
  record.plan_version = static_cast<std::uint32_t>(row.number(6));
  return record;
}

std::vector<GoalRecord> Journal::goals() const {
  Statement rows(
      *database_,
      "SELECT issuer, id, request, state, reason, arrival, plan_version FROM goal ORDER BY arrival");
  std::vector<GoalRecord> out;
  while (rows.row()) {
    out.push_back(goal_in({[&rows](int column) { return rows.text(column); },
                           [&rows](int column) { return rows.number(column); }}));
  }
  return out;
}

void Journal::put_peer(const std::string& service, std::uint32_t incarnation) {
  database_->change([database = database_.get(), service, incarnation] {
    Statement(*database, "INSERT OR REPLACE INTO peer VALUES(?,?)")
        .bind(service)
        .bind(static_cast<std::int64_t>(incarnation))
        .run();
  });
}

void Journal::remove_peer(const std::string& service) {
  database_->change([database = database_.get(), service] {
    Statement(*database, "DELETE FROM peer WHERE service = ?").bind(service).run();
  });
}

void Journal::set_position(const Position& position) {
  database_->change([database = database_.get(), position] { database->set_position(position); });
}

std::map<std::string, std::uint32_t> Journal::peers() const {
  Statement rows(*database_, "SELECT service, incarnation FROM peer");
  std::map<std::string, std::uint32_t> out;
  while (rows.row()) out[rows.text(0)] = static_cast<std::uint32_t>(rows.number(1));
  return out;
}

void Journal::append(temporal::Time time, std::string_view kind, std::string_view text) {
  database_->change([database = database_.get(), number = database_->take_record_number(), time,
                     kind = std::string(kind), text = std::string(text)] {
    database->append_record->bind(number).bind(time.count()).bind(kind).bind(text).run();
  });
}

std::int64_t Journal::append_bytes(temporal::Time time, std::string_view kind, std::string_view bytes) {
  const std::int64_t number = database_->take_record_number();
  database_->change(
      [database = database_.get(), number, time, kind = std::string(kind), bytes = std::string(bytes)] {
        database->append_record->bind(number).bind(time.count()).bind(kind).bind_bytes(bytes).run();
      });
  return number;
}

void Journal::forget_inputs_before(std::int64_t number) {
  database_->change([database = database_.get(), number] {
    Statement(*database, "DELETE FROM record WHERE seq < ? AND kind IN ('input', 'anchor', 'restored')")
        .bind(number)
        .run();
  });
}

void Journal::forget_texts_before(std::int64_t number) {
  database_->change([database = database_.get(), number] {
    Statement(*database, "DELETE FROM record WHERE seq < ? AND kind NOT IN ('input', 'anchor', 'restored')")
        .bind(number)
        .run();
  });
}

void Journal::for_each_from(std::int64_t number, const Visit& visit) const {
  Statement rows(*database_, "SELECT time_us, kind, text FROM record WHERE seq >= ? ORDER BY seq");
  rows.bind(number);
  while (rows.row()) visit(temporal::Time(rows.number(0)), rows.text(1), rows.text(2));
}

void Journal::set_text(std::string_view name, std::string_view value) {
  database_->change([database = database_.get(), name = std::string(name), value = std::string(value)] {
    Statement(*database, "INSERT OR REPLACE INTO setting VALUES(?,?)").bind(name).bind(value).run();
  });
}

std::string Journal::text(std::string_view name) const {
  Statement row(*database_, "SELECT value FROM setting WHERE name = ?");
  row.bind(name);
  return row.row() ? row.text(0) : "";
}

void Journal::set_number(std::string_view name, std::int64_t value) {
  database_->change([database = database_.get(), name = std::string(name), value] {
    Statement(*database, "INSERT OR REPLACE INTO number VALUES(?,?)").bind(name).bind(value).run();
  });
}

std::int64_t Journal::number(std::string_view name, std::int64_t fallback) const {
  Statement row(*database_, "SELECT value FROM number WHERE name = ?");
  row.bind(name);
  return row.row() ? row.number(0) : fallback;
}

}  // namespace roci::exec::journal
