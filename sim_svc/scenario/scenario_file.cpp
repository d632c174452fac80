#include "sim_svc/scenario/scenario_file.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "sim_svc/scenario/file_values.hpp"
#include "sim_svc/scenario/stimuli_file.hpp"

namespace roci::sim::scenario {

using mission::Entry;
using setup::RobotEntry;
using setup::Roster;
using temporal::Time;
using world::Window;

namespace {

// Reads what a robot's start may say: its pose, its battery, and something for each component that wants it.
Start read_robot_start(const Entry& entry, const RobotEntry& robot) {
  std::set<std::string, std::less<>> known{"x", "y", "heading", "battery"};
  for (const auto& component : robot.components) known.insert(component.name);
  setup::refuse_unknown_keys(entry, known);
  Start out;
  entry.attempt([&] {
    if (!robot.on_ground && !entry.find("x") && !entry.find("y")) return;
    out.pose = {entry.at("x").number(), entry.at("y").number(), entry.number_or("heading", 0)};
    out.pose_entry = entry;
  });
  entry.attempt([&] {
    if (!robot.power) return;
    const Entry battery = entry.at("battery");
    out.battery_j = at_least(battery, 0);
    if (*out.battery_j > robot.power->capacity_j) {
      battery.complain("the battery would begin with " + battery.text() + " J, and holds " +
                       std::to_string(std::llround(robot.power->capacity_j)) +
                       " J; lower it, or raise the robot's capacity_j");
    }
  });
  if (const auto battery = entry.find("battery"); battery && !robot.power) {
    battery->complain("'" + robot.name +
                      "' has no battery; drop it, or give the robot power in mission.yaml");
  }
  for (const auto& component : robot.components) {
    if (const auto start = entry.find(component.name)) out.components.emplace(component.name, *start);
  }
  return out;
}

// Reads the start of the only robot, or those by robot.
void read_starts(const Entry& root, const Roster& roster, Scenario& out) {
  const auto entry = root.find("start");
  if (entry && roster.size() > 1) {
    std::set<std::string, std::less<>> known;
    for (const RobotEntry& robot : roster) known.insert(robot.name);
    setup::refuse_unknown_keys(*entry, known);
  }
  for (const RobotEntry& robot : roster) {
    const bool needed = robot.on_ground || robot.power;
    if (!entry && !needed) continue;
    const Entry all = root.at("start");
    if (roster.size() == 1) {
      out.starts.emplace(robot.name, read_robot_start(all, robot));
    } else if (needed || all.find(robot.name)) {
      out.starts.emplace(robot.name, read_robot_start(all.at(robot.name), robot));
    }
  }
}

void read_world(const Entry& entry, Scenario& out) {
  for (const auto& [key, value] : entry.fields()) {
    if (key != "rocks" && key != "surface") out.conditions.emplace(key, value);
  }
  if (const auto rocks = entry.find("rocks")) {
    rocks->each([&](const Entry& rock) { out.rocks.push_back(read_rock(rock)); });
  }
}

// Reads "code", or "code: part of the text"; a code that ends in + may come several times.
ExpectedEvent read_expected(const Entry& entry) {
  ExpectedEvent out;
  if (entry.is_mapping()) {
    const auto fields = entry.fields();
    if (fields.size() != 1) entry.fail("expected one 'code: part of the text'; split it into several");
    out.code = fields.front().first;
    out.part = fields.front().second.text();
  } else {
    out.code = entry.text();
  }
  out.repeats = out.code.ends_with('+');
  if (out.repeats) out.code.pop_back();
  if (out.code.empty()) entry.fail("expected an event's code, like goal.achieved");
  return out;
}

}  // namespace

Scenario read_scenario(const Entry& root, const Roster& roster) {
  // Every service reads the links for itself (services/link).
  root.allow_only(
      {"description", "duration_s", "start", "world", "windows", "links", "science", "stimuli", "expect"});
  Scenario out;
  out.description = root.text_or("description", "");
  out.duration = temporal::seconds(1e9);
  root.attempt([&] { out.duration = time_of(root.at("duration_s")); });
  root.attempt([&] { read_starts(root, roster, out); });
  if (const auto world = root.find("world")) world->attempt([&] { read_world(*world, out); });
  if (const auto windows = root.find("windows"))
    windows->attempt([&] { out.windows = read_windows(*windows); });
  if (const auto stimuli = root.find("stimuli"))
    stimuli->attempt([&] { out.stimuli = read_stimuli(*stimuli, out.duration, roster); });
  if (const auto expect = root.find("expect"))
    expect->each([&](const Entry& item) { out.expect.push_back(read_expected(item)); });
  return out;
}

std::vector<Window> read_windows(const Entry& list) {
  std::vector<Window> out;
  list.each([&](const Entry& item) {
    Window window{item.at("timeline").text(), {}};
    item.at("open").each([&](const Entry& pair) {
      const auto ends = pair.items();
      if (ends.size() != 2) pair.fail("expected [opens, closes], in seconds");
      const Time opens = time_of(ends[0]);
      const Time closes = time_of(ends[1]);
      if (closes <= opens) pair.fail("closes before it opens; swap the two");
      if (!window.open.empty() && opens <= window.open.back().second) {
        pair.fail("opens before the one above has closed; sort or join them");
      }
      window.open.emplace_back(opens, closes);
    });
    out.push_back(std::move(window));
  });
  return out;
}

}  // namespace roci::sim::scenario
