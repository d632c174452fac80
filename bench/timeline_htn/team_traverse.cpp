#include "bench/timeline_htn/team_traverse.hpp"

#include <algorithm>
#include <vector>

namespace roci::bench::timeline_htn {

namespace {

std::string waypoint(int number) {
  std::string digits = std::to_string(number);
  return "wp" + std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits;
}

std::string scout(int number) { return "scout" + std::to_string(number); }

std::string objects(const TeamTraverse& team) {
  std::string list, edges, metres;
  for (int w = 0; w < team.waypoints; ++w) {
    list += (w == 0 ? "" : ", ") + waypoint(w);
    for (int next = w + 1; next <= std::min(team.waypoints - 1, w + 1 + team.chords); ++next) {
      edges += (edges.empty() ? "[" : ", [") + waypoint(w) + ", " + waypoint(next) + "]";
      metres += (metres.empty() ? "[" : ", [") + waypoint(w) + ", " + waypoint(next) + ", " +
                std::to_string(2 + (next - w) % 3) + "]";
    }
  }
  return "types: [waypoint]\nobjects: {waypoint: [" + list +
         "]}\nrelations:\n  edge: {arguments: [waypoint, waypoint], symmetric: true, rows: [" + edges +
         "]}\nnumbers:\n  metres: {arguments: [waypoint, waypoint], symmetric: true, rows: [" + metres +
         "]}\n";
}

std::string locomotion(const std::string& name, double speed, bool locates) {
  std::string out = "  " + name + ":\n    layer: primitive\n    robot: " + name.substr(0, name.find('-')) +
                    R"yaml(
    states:
      at: {kind: default, parameters: {place: waypoint}}
      turning:
        kind: simple
        parameters: {place: waypoint, next: waypoint}
        where: ["edge(place, next)"]
        duration_s: [5, 20]
        command: {owner: sim_svc, component: wheels, command: turn, arguments: {to: next}}
      facing: {kind: default, parameters: {place: waypoint, next: waypoint}, where: ["edge(place, next)"]}
      traversing:
        kind: simple
        parameters: {from: waypoint, to: waypoint}
        where: ["edge(from, to)"]
        duration_s: ["metres(from, to) / )yaml" +
                    std::to_string(speed) + R"yaml(", "metres(from, to) / )yaml" + std::to_string(speed / 2) +
                    R"yaml( + 60"]
        command: {owner: sim_svc, component: wheels, command: traverse, arguments: {to: to}}
)yaml";
  if (locates)
    out += R"yaml(      locating:
        kind: simple
        parameters: {place: waypoint}
        duration_s: [10, 30]
        command: {owner: sim_svc, component: camera, command: locate}
)yaml";
  out +=
      "    transitions:\n      - \"at(x) -> turning(x, y)\"\n      - \"turning(x, y) -> facing(x, y)\"\n"
      "      - \"facing(x, y) -> traversing(x, y)\"\n      - \"traversing(x, y) -> at(y)\"\n";
  if (locates) out += "      - \"at(x) <-> locating(x)\"\n";
  return out;
}

std::string planner(const std::string& name, const std::vector<std::string>& works) {
  std::string out = "  " + name + ":\n    layer: primitive\n    states:\n      idle: {kind: default}\n";
  std::string transitions;
  for (const std::string& work : works) {
    out += "      " + work +
           ": {kind: simple, parameters: {to: waypoint}, duration_s: [2, 10], command: {owner: "
           "pathplan, command: " +
           work + ", arguments: {to: to}}}\n";
    transitions += "      - \"idle <-> " + work + "(x)\"\n";
  }
  return out + "    transitions:\n" + transitions;
}

std::string components(const TeamTraverse& team) {
  std::string out = R"yaml(components:
  mission:
    layer: abstract
    states:
      idle: {kind: default}
      traverse: {kind: complex, parameters: {from: waypoint, to: waypoint}}
      communicate: {kind: complex}
    transitions: ["idle <-> traverse(a, b)", idle <-> communicate]
  navigation:
    layer: abstract
    states:
      idle: {kind: default}
      route: {kind: complex, parameters: {from: waypoint, to: waypoint}}
    transitions: ["idle <-> route(a, b)"]
  team:
    layer: abstract
    states:
      in_formation: {kind: default}
      cycle: {kind: complex, parameters: {from: waypoint, to: waypoint}, where: ["edge(from, to)"]}
    transitions: ["in_formation <-> cycle(a, b)"]
  antenna:
    layer: primitive
    robot: primary
    states:
      idle: {kind: default}
      sending_map: {kind: simple, duration_s: [5, 15], command: {owner: sim_svc, component: radio, command: send_map}}
      reporting: {kind: simple, duration_s: [30, 60], command: {owner: sim_svc, component: radio, command: report}}
    transitions: [idle <-> sending_map, idle <-> reporting]
)yaml";
  out += locomotion("primary-loco", 0.05, true) + planner("primary-path", {"merging", "planning"});
  for (int s = 1; s < team.rovers; ++s)
    out += locomotion(scout(s) + "-loco", 0.1, false) + planner(scout(s) + "-path", {"updating"});
  return out;
}

std::string behaviours(const TeamTraverse& team) {
  std::string out = R"yaml(behaviours:
  long_traverse:
    achieves: mission.traverse(from, to)
    subgoals: {route: "navigation.route(from, to)"}
  report:
    achieves: mission.communicate
    subgoals: {report: antenna.reporting}
  arrive:
    achieves: navigation.route(from, to)
    where: ["edge(from, to)"]
    subgoals: {cycle: "team.cycle(from, to)"}
  go_on:
    achieves: navigation.route(from, to)
    variables: {next: waypoint}
    where: ["edge(from, next)", "next != to", "from != to"]
    subgoals: {cycle: "team.cycle(from, next)", rest: "navigation.route(next, to)"}
    constraints: [cycle before rest]
  traverse_team:
    achieves: team.cycle(from, to)
    conditions: [primary-loco.at(from))yaml";
  for (int s = 1; s < team.rovers; ++s) out += ", " + scout(s) + "-loco.at(from)";
  out += R"yaml(]
    subgoals:
      locate: primary-loco.locating(from)
      primary_turns: "primary-loco.facing(from, to)"
      merge: primary-path.merging(to)
      path: primary-path.planning(to)
      map: antenna.sending_map
      follow: "primary-loco.traversing(from, to)"
)yaml";
  std::string constraints =
      "      - locate before primary_turns\n      - primary_turns.start to merge.start [0, none]\n"
      "      - merge before path\n      - path before map\n";
  std::string last = "map";
  for (int s = 1; s < team.rovers; ++s) {
    const std::string n = std::to_string(s);
    out += "      scout_turns" + n + ": \"" + scout(s) + "-loco.facing(from, to)\"\n      update" + n + ": " +
           scout(s) + "-path.updating(to)\n      scout_goes" + n + ": \"" + scout(s) +
           "-loco.traversing(from, to)\"\n";
    constraints += "      - locate.end to scout_turns" + n + ".start [0, none]\n      - " + last +
                   " before update" + n + " before scout_goes" + n + "\n      - scout_turns" + n +
                   ".start to scout_goes" + n + ".start [0, none]\n";
    last = "scout_goes" + n;
  }
  return out + "    constraints:\n" + constraints + "      - " + last + " before follow\n";
}

std::string problem(const TeamTraverse& team) {
  std::string out =
      "problem:\n  horizon_s: " + std::to_string(1000 * team.waypoints * team.rovers) +
      "\n  initial: {mission: idle, navigation: idle, team: in_formation, antenna: idle, primary-loco: at(" +
      waypoint(0) + "), primary-path: idle";
  for (int s = 1; s < team.rovers; ++s)
    out += ", " + scout(s) + "-loco: at(" + waypoint(0) + "), " + scout(s) + "-path: idle";
  out += "}\n  goals:\n";
  const int traverses = std::max(1, team.goals - 1);
  std::string before;
  for (int g = 0; g < team.goals; ++g) {
    const std::string name = "g" + std::to_string(g);
    const int from = g * (team.waypoints - 1) / traverses, to = (g + 1) * (team.waypoints - 1) / traverses;
    const std::string state = g == traverses
                                  ? "mission.communicate"
                                  : "\"mission.traverse(" + waypoint(from) + ", " + waypoint(to) + ")\"";
    out += "    " + name + ": {state: " + state + (before.empty() ? "" : ", after: [" + before + "]") + "}\n";
    before = name;
  }
  return out;
}

}  // namespace

std::string text_of(const TeamTraverse& team) {
  return "format: 1\ndomain: team-traverse\n" + objects(team) + components(team) + behaviours(team) +
         problem(team);
}

}  // namespace roci::bench::timeline_htn
