#include "ground_console/cli/robots.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "ground_console/cli/orders.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/table.hpp"

namespace roci::console::cli {
namespace {

using nlohmann::json;

constexpr double kMicro = 1e-6;

std::set<std::string> names_of(const lib::MissionView& view) {
  std::set<std::string> out;
  for (const auto& [name, beat] : view.services())
    if (!beat.robot().empty()) out.insert(beat.robot());
  for (const auto& [name, way] : view.ways()) out.insert(name);
  for (const auto& [planner, map] : view.maps())
    if (!map.header().robot().empty()) out.insert(map.header().robot());
  constexpr std::string_view kBattery = ".battery";
  for (const auto& [name, seen] : view.timelines())
    if (name.ends_with(kBattery)) out.insert(name.substr(0, name.size() - kBattery.size()));
  return out;
}

std::optional<double> number_of(const lib::MissionView& view, const std::string& timeline) {
  const v1::TimelineValue* value = view.timeline(timeline);
  if (value == nullptr || value->kind() != v1::VALUE_NUMBER || !std::isfinite(value->number()))
    return std::nullopt;
  return value->number();
}

bool is_state(const v1::Observation& seen) {
  return seen.observed().kind() == v1::VALUE_STATE || seen.observed().kind() == v1::VALUE_BOOLEAN;
}

std::string one_decimal(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

json map_json(const v1::KnownMap& map) {
  json out{{"planner", map.planner()},
           {"map_version", map.map_version()},
           {"obstacles", json::array()},
           {"told", nullptr},
           {"taken", json::array()}};
  for (const v1::MapObstacle& one : map.obstacles())
    out["obstacles"].push_back({{"found_by", one.found_by()},
                                {"id", one.id()},
                                {"kind", lib::name_of(one.obstacle_kind())},
                                {"x_m", one.x_m()},
                                {"y_m", one.y_m()},
                                {"radius_m", one.radius_m()},
                                {"cleared", one.cleared()},
                                {"found_s", static_cast<double>(one.found_us()) * kMicro}});
  if (map.told_us() >= 0)
    out["told"] = {{"map_version", map.told_version()},
                   {"at_s", static_cast<double>(map.told_us()) * kMicro}};
  for (const v1::TakenPatch& one : map.taken())
    out["taken"].push_back({{"author", one.author()},
                            {"map_version", one.map_version()},
                            {"at_s", static_cast<double>(one.taken_us()) * kMicro}});
  return out;
}

}  // namespace

std::vector<Robot> robots_of(const lib::MissionView& view) {
  std::vector<Robot> out;
  for (const std::string& name : names_of(view)) {
    Robot robot{name};
    const auto x = number_of(view, name + ".x"), y = number_of(view, name + ".y");
    if (x && y) robot.place = lib::Place{*x, *y};
    robot.heading_rad = number_of(view, name + ".heading");
    robot.battery = number_of(view, name + ".battery");
    if (const v1::TimelineValue* doing = view.timeline(name)) robot.doing = lib::value_text(*doing);
    for (const auto& [timeline, seen] : view.timelines())
      if (timeline.starts_with(name + ".") && is_state(seen))
        robot.states.emplace_back(timeline.substr(name.size() + 1), lib::value_text(seen.observed()));
    for (const auto& [planner, map] : view.maps())
      if (map.header().robot() == name) robot.maps.push_back(&map);
    out.push_back(std::move(robot));
  }
  return out;
}

std::vector<std::pair<std::string, std::string>> states_by_family(const lib::MissionView& view,
                                                                  const Robot& robot) {
  constexpr std::size_t kFamily = 3;
  struct Family {
    std::size_t count = 0;
    std::int64_t newest_us = -1;
    std::string newest;
  };
  const auto family_of = [](const std::string& name) { return name.substr(0, name.find('.')); };
  std::map<std::string, Family> families;
  for (const auto& [name, value] : robot.states) {
    if (name.find('.') == std::string::npos) continue;
    Family& family = families[family_of(name)];
    ++family.count;
    const std::int64_t sampled = view.timelines().at(robot.name + "." + name).sampled_us();
    if (sampled < family.newest_us) continue;
    family.newest_us = sampled;
    family.newest = name.substr(name.find('.') + 1) + " " + value;
  }
  std::vector<std::pair<std::string, std::string>> out;
  std::set<std::string> told;
  for (const auto& [name, value] : robot.states) {
    const auto family = families.find(family_of(name));
    if (name.find('.') == std::string::npos || family->second.count < kFamily) {
      out.emplace_back(name, value);
    } else if (told.insert(family->first).second) {
      out.emplace_back(family->first + ".*",
                       std::to_string(family->second.count) + ", newest " + family->second.newest);
    }
  }
  return out;
}

std::vector<std::pair<std::string, std::string>> states_of_the_team(const lib::MissionView& view,
                                                                    const std::vector<Robot>& robots) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const auto& [timeline, seen] : view.timelines()) {
    const bool of_a_robot = std::ranges::any_of(robots, [&](const Robot& robot) {
      return timeline == robot.name || timeline.starts_with(robot.name + ".");
    });
    if (!of_a_robot && is_state(seen)) out.emplace_back(timeline, lib::value_text(seen.observed()));
  }
  return out;
}

std::string where_text(const Robot& robot, const MissionWords& words) {
  std::vector<std::string> parts;
  if (robot.place) {
    std::string text = "x " + one_decimal(robot.place->x_m) + " y " + one_decimal(robot.place->y_m) + " m";
    if (robot.heading_rad)
      text += ", heading " + std::to_string(std::lround(*robot.heading_rad * 180 / M_PI)) + "°";
    parts.push_back(text);
  }
  if (robot.battery)
    parts.push_back("battery " + amount_text(*robot.battery, words.unit_of(robot.name + ".battery")));
  return joined(parts, "   ");
}

std::string map_text(const v1::KnownMap& map) {
  std::map<std::string, std::size_t> kinds;
  std::size_t count = 0;
  for (const v1::MapObstacle& one : map.obstacles()) {
    if (one.cleared()) continue;
    ++kinds[std::string(lib::name_of(one.obstacle_kind())) + " of " + one.found_by()];
    ++count;
  }
  std::vector<std::string> parts;
  for (const auto& [kind, number] : kinds) parts.push_back(std::to_string(number) + " " + kind);
  std::string out = "version " + std::to_string(map.map_version()) + ": " + counted(count, "obstacle");
  if (!parts.empty()) out += " (" + joined(parts, ", ") + ")";
  if (map.told_us() >= 0)
    out += ", told version " + std::to_string(map.told_version()) + " at " + lib::clock_text(map.told_us());
  for (const v1::TakenPatch& one : map.taken())
    out += ", took version " + std::to_string(one.map_version()) + " of " + one.author() + " at " +
           lib::clock_text(one.taken_us());
  return printable(out);
}

std::int64_t planned_end_us(const lib::MissionView& view, const lib::Repair& repair) {
  const v1::StepStatus* step = view.step(repair.activity);
  if (view.plan() == nullptr || step == nullptr || step->started_us() < 0) return -1;
  for (const v1::PlanActivity& activity : view.plan()->activities())
    if (activity.id() == repair.activity && activity.duration_upper_us() >= 0)
      return step->started_us() + activity.duration_upper_us();
  return -1;
}

std::string repair_line(const lib::MissionView& view, const lib::Repair& repair) {
  const bool runs = repair.state == lib::Repair::State::under_way;
  std::string out = repair.owner + (runs ? " repairs " : " repaired ") + repair.activity +
                    (runs ? " since " : " from ") + lib::clock_text(repair.since_us);
  if (!runs) out += " to " + lib::clock_text(repair.ended_us) + ", " + lib::name_of(repair.state);
  if (const double used = lib::share_used(repair, view.now_us()); used >= 0) {
    out += ", " + std::to_string(std::lround(used * 100)) + " % of the time until " +
           lib::clock_text(repair.latest_end_us) + " used";
  } else if (const std::int64_t planned = planned_end_us(view, repair); planned >= 0) {
    out += ", planned until " + lib::clock_text(planned);
  }
  out += ": " + repair.error;
  if (repair.times > 1) out += " (" + std::to_string(repair.times) + " times)";
  if (!repair.end.empty()) out += "; " + repair.end;
  return printable(out);
}

std::vector<const v1::Decision*> open_decisions(const lib::MissionView& view) {
  std::vector<const v1::Decision*> out;
  for (const auto& [id, decision] : view.decisions())
    if (decision.decision_state() == v1::DECISION_OPEN) out.push_back(&decision);
  return out;
}

std::vector<const lib::Repair*> repairs_of(const lib::MissionView& view) {
  std::vector<const lib::Repair*> out;
  for (const auto& [key, repair] : view.repairs()) out.push_back(&repair);
  std::ranges::stable_sort(out, {}, [](const lib::Repair* repair) {
    return std::pair(repair->state != lib::Repair::State::under_way, -repair->since_us);
  });
  return out;
}

json robots_json(const lib::MissionView& view) {
  json out = json::object();
  for (const Robot& robot : robots_of(view)) {
    json& one = out[robot.name] = {
        {"pose", nullptr}, {"battery", nullptr}, {"states", json::object()}, {"maps", json::array()}};
    if (robot.place) {
      one["pose"] = {{"x_m", robot.place->x_m}, {"y_m", robot.place->y_m}, {"heading_rad", nullptr}};
      if (robot.heading_rad) one["pose"]["heading_rad"] = *robot.heading_rad;
    }
    if (robot.battery) one["battery"] = *robot.battery;
    if (!robot.doing.empty()) one["doing"] = robot.doing;
    for (const auto& [timeline, value] : robot.states) one["states"][timeline] = value;
    for (const v1::KnownMap* map : robot.maps) one["maps"].push_back(map_json(*map));
  }
  return out;
}

json repairs_json(const lib::MissionView& view) {
  json out = json::array();
  for (const lib::Repair* repair : repairs_of(view)) {
    const double used = lib::share_used(*repair, view.now_us());
    const auto seconds = [](std::int64_t us) {
      return us < 0 ? json(nullptr) : json(static_cast<double>(us) * kMicro);
    };
    out.push_back({{"owner", repair->owner},
                   {"robot", repair->robot},
                   {"commander", repair->commander},
                   {"activity", repair->activity},
                   {"error", repair->error},
                   {"times", repair->times},
                   {"since_s", seconds(repair->since_us)},
                   {"latest_end_s", seconds(repair->latest_end_us)},
                   {"planned_end_s", seconds(planned_end_us(view, *repair))},
                   {"used", used < 0 ? json(nullptr) : json(used)},
                   {"state", lib::name_of(repair->state)},
                   {"ended_s", seconds(repair->ended_us)},
                   {"end", repair->end}});
  }
  return out;
}

std::string robots_text(const lib::MissionView& view, const MissionWords& words) {
  std::string out;
  const std::vector<Robot> robots = robots_of(view);
  if (!robots.empty()) out += "\nRobots\n";
  for (const Robot& robot : robots) {
    std::vector<std::string> head{robot.name};
    if (!robot.doing.empty()) head.push_back(robot.doing);
    if (const std::string where = where_text(robot, words); !where.empty()) head.push_back(where);
    out += "  " + printable(joined(head, "   ")) + "\n";
    for (const auto& [timeline, value] : states_by_family(view, robot))
      out += "    " + printable(padded(timeline, 18) + value) + "\n";
    for (const v1::KnownMap* map : robot.maps) out += "    " + padded("map", 18) + map_text(*map) + "\n";
  }
  const auto team = states_of_the_team(view, robots);
  if (!team.empty() && !robots.empty()) {
    out += "  team\n";
    for (const auto& [timeline, value] : team) out += "    " + printable(padded(timeline, 18) + value) + "\n";
  }
  const auto decisions = open_decisions(view);
  if (!decisions.empty()) out += "\nDecisions\n";
  for (const v1::Decision* decision : decisions) out += "  " + decision_line(*decision) + "\n";
  const auto repairs = repairs_of(view);
  if (!repairs.empty()) out += "\nRepairs\n";
  for (const lib::Repair* repair : repairs) out += "  " + repair_line(view, *repair) + "\n";
  return out;
}

}  // namespace roci::console::cli
