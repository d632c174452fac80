// A mission without PDDL, site or arm: two robots, each with a drill and a lamp, and a window.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/mission/entry.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/mission/mission_model.hpp"

namespace roci::exec::testing {

inline constexpr char kTimelineMission[] = R"(format: 1
name: mine
model: model.txt
objects:
  - {name: hole-1, properties: {depth: {timeline: "{robot}.depth"}, width: 2}}
  - {name: spare, dynamic: true}
components:
  - {name: drill, timeline: "{robot}.drill", owner: sim_svc, fallback: stop, states: {up: {}, in: {}, boring: {active: true}}}
  - {name: lamp, robot: mole, timeline: "{robot}.lamp", owner: lamp_driver, fallback: dark, states: {"off": {}, "on": {active: true}}}
windows:
  - {timeline: comm.window, open: [[100, 200], [300, 400]]}
goal_kinds:
  hole:
    arguments: {name: text, depth: number}
    objects: [{name: "{name}"}]
    achieved: [{timeline: "{robot}.drill", is: [in, "{name}"]}, {timeline: "{robot}.depth", at_least: 3}]
planner: {engine: miner, service: "planner.{robot}"}
)";

inline mission::ExecutiveRole role_of_mole() { return {"mole", true, {"mole", "vole"}, true}; }

class TimelineMissionFile {
 public:
  TimelineMissionFile() {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "model.txt") << "bore takes 60 s\n";
    write(kTimelineMission);
  }
  ~TimelineMissionFile() { std::filesystem::remove_all(folder_); }

  void write(const std::string& text) { std::ofstream(folder_ / "mission.yaml") << text; }
  mission::MissionModel read(const mission::ExecutiveRole& role = role_of_mole()) const {
    return mission::read_mission(folder_, role);
  }
  // What is wrong with the file when `from` stands in it as `to`.
  std::string fault(const std::string& from, const std::string& to,
                    const mission::ExecutiveRole& role = role_of_mole()) {
    std::string text = kTimelineMission;
    text.replace(text.find(from), from.size(), to);
    write(text);
    try {
      read(role);
    } catch (const roci::mission::FileError& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("roci_mine_" + std::to_string(::getpid()));
};

inline goals::GoalRequest hole(const std::string& id) {
  goals::GoalRequest goal;
  goal.key = {"ground", id};
  goal.robot = "mole";
  goal.kind = "hole";
  goal.arguments = {{"name", "h-" + id}, {"depth", "3"}};
  return goal;
}

}  // namespace roci::exec::testing
