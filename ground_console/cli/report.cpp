#include "ground_console/cli/report.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "ground_console/cli/orders.hpp"
#include "ground_console/cli/plan_table.hpp"
#include "ground_console/cli/plan_values.hpp"
#include "ground_console/cli/robots.hpp"

namespace roci::console::cli {

using nlohmann::json;

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string printable(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text;
}

std::string json_text(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

constexpr std::string_view kDetails = "\ndetails: ";

std::string reason_of(const v1::GoalStatus& status) {
  return status.reason().substr(0, status.reason().find(kDetails));
}

std::string details_of(const v1::GoalStatus& status) {
  const std::size_t end = status.reason().find(kDetails);
  return end == std::string::npos ? "" : status.reason().substr(end + kDetails.size());
}

json to_json(const v1::GoalStatus& status) {
  return {{"issuer", status.issuer()},
          {"id", status.id()},
          {"kind", status.goal_kind()},
          {"class", lib::name_of(status.importance())},
          {"state", lib::name_of(status.goal_state())},
          {"reason", reason_of(status)},
          {"details", details_of(status)},
          {"plan_version", status.plan_version()},
          {"acknowledged", lib::name_of(status.ack_stage())}};
}

json to_json(const v1::Event& event) {
  return {{"time_s", static_cast<double>(event.header().stamp_us()) / 1e6},
          {"source", event.header().sender()},
          {"severity", lib::name_of(event.severity_level())},
          {"code", event.code()},
          {"text", event.text()}};
}

namespace {

void add_mission(json& out, const v1::MissionStatus& mission) {
  out["phase"] = lib::name_of(mission.phase());
  out["plan_version"] = mission.plan_version();
  out["replans"] = mission.replans();
  out["outcome"] = mission.outcome();
}

std::string mission_text(const v1::MissionStatus& mission) {
  return std::string(lib::name_of(mission.phase())) + ", plan " + std::to_string(mission.plan_version()) +
         ", " + std::to_string(mission.replans()) + " replans" +
         (mission.outcome().empty() ? "" : ", " + mission.outcome());
}

}  // namespace

namespace {

// The plan after which nothing is executed (R129); null: one is, or is being made, or none has ended.
const v1::ExecutedPlan* idle_after(const lib::MissionView& view) {
  const v1::MissionStatus* mission = view.mission();
  if (mission == nullptr || view.executed().empty()) return nullptr;
  const auto phase = mission->phase();
  if (phase != v1::PHASE_IDLE && phase != v1::PHASE_FINISHED && phase != v1::PHASE_SAFE) return nullptr;
  const v1::ExecutedPlan& last = view.executed().rbegin()->second;
  return last.version() == mission->plan_version() ? &last : nullptr;
}

}  // namespace

json status_json(const lib::MissionView& view) {
  json out{{"time_s", static_cast<double>(view.now_us()) / 1e6},
           {"goals", json::array()},
           {"services", json::array()},
           {"timelines", json::object()}};
  if (const v1::MissionStatus* mission = view.mission()) {
    out["mission"] = mission->mission();
    add_mission(out, *mission);
  }
  if (const v1::ExecutedPlan* last = idle_after(view)) {
    out["idle"] = {{"since_s", static_cast<double>(last->header().stamp_us()) / 1e6},
                   {"after_plan", last->version()},
                   {"outcome", lib::name_of(last->outcome())},
                   {"reason", last->reason()}};
  }
  if (view.executives().size() > 1) {
    for (const auto& [name, mission] : view.missions()) add_mission(out["executives"][name], mission);
  }
  if (const v1::LeaseMessage* leader = view.leader()) {
    const std::uint64_t behind =
        leader->has().commits() - std::min(leader->has().commits(), leader->receipt().commits());
    out["executive"] = {{"leader", leader->member()},
                        {"epoch", leader->epoch()},
                        {"host", leader->host()},
                        {"process_id", leader->process_id()},
                        {"standby_ready", leader->entitled()},
                        {"standby_commits_behind", behind}};
  }
  for (const auto& [key, status] : view.goals()) out["goals"].push_back(to_json(status));
  for (const auto& [name, heartbeat] : view.services()) {
    out["services"].push_back({{"name", name},
                               {"incarnation", heartbeat.incarnation()},
                               {"state", lib::name_of(heartbeat.state())},
                               {"dds", heartbeat.dds()},
                               {"progress", heartbeat.progress()},
                               {"resident_kb", heartbeat.resident_kb()}});
  }
  for (const auto& [name, observation] : view.timelines())
    out["timelines"][name] = lib::value_text(observation.observed());
  out["robots"] = robots_json(view);
  out["decisions"] = json::array();
  for (const v1::Decision* decision : open_decisions(view))
    out["decisions"].push_back(decision_json(*decision));
  out["repairs"] = repairs_json(view);
  return out;
}

// What the activity is foreseen to do to a timeline: a rate is per second and runs while it does.
json impact_json(const v1::Impact& impact) {
  static constexpr std::array<const char*, 3> kinds{"assign", "delta", "rate"};
  static constexpr std::array<const char*, 3> moments{"start", "end", "during"};
  json out{{"timeline", impact.timeline()},
           {"kind", kinds.at(std::min<std::size_t>(impact.kind(), 2))},
           {"at", moments.at(std::min<std::size_t>(impact.moment(), 2))}};
  if (impact.amount().kind() == v1::VALUE_NUMBER) {
    out["amount"] = impact.amount().number();
  } else {
    out["amount"] = lib::value_text(impact.amount());
  }
  return out;
}

json plan_json(const lib::MissionView& view) {
  if (!view.plan()) return nullptr;
  json out{
      {"executive", view.executive()}, {"version", view.plan()->version()}, {"activities", json::array()}};
  for (const v1::PlanActivity& activity : view.plan()->activities()) {
    json entry{{"id", activity.id()},
               {"name", activity.name()},
               {"level", activity.level()},
               {"parent", activity.parent()},
               {"robot", robot_of(view, activity)},
               {"goals", activity.goals_served()},
               {"planned_start_us", planned_start_us(*view.plan(), activity)},
               {"duration_us", activity.duration_lower_us()},
               {"arguments", json::object()},
               {"impacts", json::array()},
               {"utility", activity.utility()},
               {"older_values", stands_on_older_values(view, activity)}};
    for (const v1::Property& argument : arguments_of(activity))
      entry["arguments"][argument.name()] = argument.value();
    for (const v1::Impact& impact : activity.impacts()) entry["impacts"].push_back(impact_json(impact));
    if (const v1::StepStatus* step = view.step(activity.id())) {
      entry["state"] = lib::name_of(step->state());
      entry["started_us"] = step->started_us();
      entry["ended_us"] = step->ended_us();
      entry["earliest_start_us"] = step->earliest_start_us();
      entry["latest_start_us"] = step->latest_start_us();
      entry["cause"] = step->cause();
    }
    out["activities"].push_back(std::move(entry));
  }
  return out;
}

std::string goal_line(const v1::GoalStatus& status) {
  return printable(padded(status.issuer() + "/" + status.id(), 24) + " " + padded(status.goal_kind(), 12) +
                   " " + padded(lib::name_of(status.importance()), 14) + " " +
                   padded(lib::name_of(status.goal_state()), 9) + " " + reason_of(status) +
                   (status.reason().empty() ? "(" : " (") + lib::name_of(status.ack_stage()) + ")");
}

// The wire has no word for a refused change, whose goal keeps its state: the executive says it at the head of the
// reason.
bool is_refused(const v1::GoalStatus& answer) {
  return answer.goal_state() == v1::GOAL_REJECTED || answer.reason().starts_with("change refused: ");
}

std::string event_line(const v1::Event& event) {
  const bool plain =
      event.severity_level() == v1::SEVERITY_INFO || event.severity_level() == v1::SEVERITY_DEBUG;
  return printable(lib::clock_text(event.header().stamp_us()) + "  " + padded(event.header().sender(), 13) +
                   (plain ? "" : std::string(lib::name_of(event.severity_level())) + ": ") + event.text());
}

std::string status_text(const lib::MissionView& view, const MissionWords& words) {
  std::string out;
  if (const v1::MissionStatus* mission = view.mission()) {
    const bool one = view.executives().size() == 1;
    out += mission->mission() + "  " + lib::clock_text(view.now_us()) +
           (one ? "  " + mission_text(*mission) : "") + "\n";
    if (!one)
      for (const auto& [name, its] : view.missions())
        out += "  " + printable(padded(name, 24)) + " " + mission_text(its) + "\n";
  } else {
    out += "no status from exec_svc\n";
  }
  if (const v1::ExecutedPlan* last = idle_after(view)) {
    out += "idle since " + lib::clock_text(last->header().stamp_us()) + ": plan " +
           std::to_string(last->version()) + " " + lib::name_of(last->outcome()) +
           (last->reason().empty() ? "" : ", " + printable(last->reason())) + "\n";
  }
  if (const v1::LeaseMessage* leader = view.leader()) out += "executive: " + lib::pair_text(*leader) + "\n";
  out += "\nGoals\n";
  for (const auto& [key, status] : view.goals()) out += "  " + goal_line(status) + "\n";
  out += robots_text(view, words);
  out += "\nServices\n";
  std::size_t width = 14;
  for (const auto& [name, heartbeat] : view.services()) width = std::max(width, name.size() + 2);
  for (const auto& [name, heartbeat] : view.services()) {
    out += "  " + padded(name, width) + padded(lib::name_of(heartbeat.state()), 10) +
           padded(heartbeat.dds(), 12) + "start " + std::to_string(heartbeat.incarnation()) + ", " +
           std::to_string(heartbeat.resident_kb() / 1024) + " MB\n";
  }
  return out;
}

}  // namespace roci::console::cli
