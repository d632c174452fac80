#include "dedicated_svc/call_record_service.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>
#include <utility>

#include "core/durable/durable_file.hpp"
#include "dedicated_svc/limits.hpp"
#include "services/owner/value_json.hpp"

namespace roci::dedicated {
namespace {

namespace owner = services::owner;
using nlohmann::json;
using services::commander::Issued;
using temporal::Time;
using temporal::Value;
using Values = std::map<std::string, Value>;

json json_of(const owner::CommandKey& key) {
  return {{"activity", key.activity},
          {"attempt", key.attempt},
          {"commander", key.commander},
          {"epoch", key.issued_epoch}};
}

owner::CommandKey key_in(const json& in) {
  return {in.at("activity").get<std::string>(), in.at("attempt").get<std::uint32_t>(),
          in.at("commander").get<std::string>(), in.at("epoch").get<std::uint64_t>()};
}

json json_of(const Values& values) {
  json out = json::object();
  for (const auto& [name, value] : values) out[name] = owner::to_json(value);
  return out;
}

Values values_in(const json& in) {
  Values out;
  for (const auto& [name, value] : in.items()) out[name] = owner::value_in(value);
  return out;
}

json json_of(const method_run::Taken& one) {
  json out{{"error", one.answer.error},
           {"reason", one.answer.reason},
           {"values", json_of(one.answer.values)},
           {"observed", json_of(one.observed)}};
  if (one.answer.energy_j) out["energy_j"] = *one.answer.energy_j;
  return out;
}

method_run::Taken taken_in(const json& in) {
  method_run::Taken out{
      {in.at("error").get<std::string>(), in.at("reason").get<std::string>(), values_in(in.at("values")), {}},
      values_in(in.at("observed"))};
  if (in.contains("energy_j") && in["energy_j"].is_number())
    out.answer.energy_j = in["energy_j"].get<double>();
  return out;
}

json json_of(const RunRecord& run) {
  const owner::Request& request = run.request;
  json out{{"key", json_of(request.key)},    {"robot", request.robot},
           {"subsystem", request.subsystem}, {"command", request.command},
           {"arguments", request.arguments}, {"plan", request.plan},
           {"begun_us", run.begun.count()},  {"call_begun_us", run.call_begun.count()},
           {"taken", json::array()}};
  if (request.latest_end) out["latest_end_us"] = request.latest_end->count();
  for (const method_run::Taken& one : run.taken) out["taken"].push_back(json_of(one));
  if (run.broken_off)
    out["broken_off"] = {{"stage", static_cast<int>(run.broken_off->stage)},
                         {"code", run.broken_off->code},
                         {"reason", run.broken_off->reason}};
  return out;
}

RunRecord run_in(const json& in) {
  RunRecord out;
  out.request.key = key_in(in.at("key"));
  out.request.robot = in.at("robot").get<std::string>();
  out.request.subsystem = in.at("subsystem").get<std::string>();
  out.request.command = in.at("command").get<std::string>();
  out.request.arguments = in.at("arguments").get<std::map<std::string, std::string>>();
  out.request.plan = in.at("plan").get<std::uint32_t>();
  if (in.contains("latest_end_us")) out.request.latest_end = Time{in["latest_end_us"].get<std::int64_t>()};
  out.begun = Time{in.at("begun_us").get<std::int64_t>()};
  out.call_begun = Time{in.at("call_begun_us").get<std::int64_t>()};
  for (const json& one : in.at("taken")) out.taken.push_back(taken_in(one));
  if (const auto why = in.find("broken_off"); why != in.end()) {
    const bool failed = why->at("stage").get<int>() == static_cast<int>(owner::Stage::failed);
    out.broken_off = owner::CommandStatus{failed ? owner::Stage::failed : owner::Stage::cancelled,
                                          why->at("code").get<std::string>(),
                                          why->at("reason").get<std::string>(),
                                          {}};
  }
  return out;
}

}  // namespace

CallRecord::CallRecord(std::filesystem::path file, std::function<void()> around_write)
    : file_(std::move(file)), around_write_(std::move(around_write)) {
  std::ifstream in(file_);
  if (!in) return;
  std::ostringstream text;
  text << in.rdbuf();
  try {
    read(text.str());
  } catch (const json::exception&) {
    damaged_ = true;
    epoch_ = 0;
    open_.reset();
    run_.reset();
    state_.reset();
  }
}

void CallRecord::read(const std::string& text) {
  const json in = json::parse(text);
  epoch_ = in.at("epoch").get<std::uint64_t>();
  if (const auto open = in.find("open"); open != in.end())
    open_ = Issued{key_in(*open), open->at("owner").get<std::string>()};
  if (const auto run = in.find("run"); run != in.end()) run_ = run_in(*run);
  if (const auto state = in.find("state"); state != in.end()) state_ = owner::value_in(*state);
}

void CallRecord::begin_run(const owner::Request& request, Time now) {
  run_ = RunRecord{request, now, now};
  write();
}

void CallRecord::begin(const Issued& issued) {
  epoch_ = issued.key.issued_epoch;
  open_ = issued;
  write();
}

void CallRecord::take(method_run::Taken taken, Time now) {
  open_.reset();
  if (run_ && run_->taken.size() >= kTaken) run_.reset();
  if (run_) {
    run_->taken.push_back(std::move(taken));
    run_->call_begun = now;
  }
  write();
}

void CallRecord::break_off(const owner::CommandStatus& why) {
  if (!run_) return;
  run_->broken_off = why;
  write();
}

void CallRecord::end_run(const Value& state) {
  run_.reset();
  state_ = state;
  write();
}

void CallRecord::end() {
  open_.reset();
  write();
}

void CallRecord::write() {
  if (file_.empty()) return;
  json out{{"epoch", epoch_}};
  if (open_) {
    out["open"] = json_of(open_->key);
    out["open"]["owner"] = open_->owner;
  }
  if (run_) out["run"] = json_of(*run_);
  if (state_) out["state"] = owner::to_json(*state_);
  if (around_write_) around_write_();
  try {
    durable::replace_file(file_, out.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
  } catch (const std::system_error&) {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
    throw;
  }
  if (around_write_) around_write_();
}

}  // namespace roci::dedicated
