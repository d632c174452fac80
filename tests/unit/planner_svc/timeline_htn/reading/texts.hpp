// A model in which each kind of thing stands once.
#pragma once

#include <string>

#include "planner_svc/timeline_htn/reading/load.hpp"

namespace roci::planner::timeline_htn::reading {

inline const std::string kSound = R"yaml(format: 1
domain: rover
types: [waypoint, report]
objects: {waypoint: [wp0, wp1], report: [status]}
relations:
  edge: {arguments: [waypoint, waypoint], symmetric: true, rows: [[wp0, wp1]]}
numbers:
  metres: {arguments: [waypoint, waypoint], rows: [[wp0, wp1, 4], [wp1, wp0, 5]]}
components:
  navigation:
    layer: abstract
    states:
      idle: {kind: default}
      traverse: {kind: complex, parameters: {from: waypoint, to: waypoint}}
    transitions: ["idle <-> traverse(a, b)"]
  wheels:
    layer: primitive
    robot: primary
    states:
      at: {kind: default, parameters: {place: waypoint}, observed: {timeline: nav, value: parked(place)}}
      drive:
        kind: simple
        parameters: {from: waypoint, to: waypoint}
        where: ["edge(from, to)", "from != to", "metres(from, to) * 2 <= 10"]
        duration_s: ["metres(from, to) / 0.5", "(metres(from, to) + 1) * 4"]
        command: {owner: sim, component: drive, command: go, arguments: {goal: to, gear: slow}, answer_within_s: 5}
        needs: [during antenna.stowed, "at_start antenna.stowed"]
        contingency: halt
        retries: 2
      stuck: {kind: error, parameters: {place: waypoint}}
    transitions: ["at(x) -> drive(x, y)", "drive(x, y) -> at(y)", "stuck(x) -> at(x)"]
  antenna:
    layer: primitive
    states:
      stowed: {kind: default, observed: {timeline: antenna}}
      send: {kind: simple, parameters: {what: report}, duration_s: 10}
    transitions: [stowed <-> send(r)]
behaviours:
  step:
    achieves: navigation.traverse(from, to)
    priority: 2
    variables: {what: report}
    where: ["edge(from, to)"]
    conditions: ["wheels.at(from)", not wheels.stuck(to)]
    subgoals:
      drive: wheels.drive(from, to)
      tell: {state: antenna.send(what), contingency: silence}
      other: antenna.send(status)
    constraints: ["drive before tell [0, 60]", "self.start to drive.start [0, metres(from, to)]"]
    decisions:
      how: {resolver: rule, before: tell.start, choices: {a: {subgoals: tell, when: "nav = parked"}, b: {subgoals: other}}}
      what: {resolver: ground, asks: console, before: tell.start, binds: what}
  unstick:
    triggers: [wheels.stuck(place)]
    subgoals: {free: wheels.at(place)}
problem:
  horizon_s: 600
  initial: {navigation: idle, wheels: at(wp0), antenna: stowed}
  goals:
    there: {state: "navigation.traverse(wp0, wp1)", window_s: [5, 300]}
    told: {state: antenna.send(status), after: [there]}
)yaml";

/// Replaces the first `from` in the text, which must hold it.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) return "not found: " + from;
  return text.replace(at, from.size(), to);
}

/// Returns every fault of a text, one in each line.
inline std::string faults_of(const std::string& text) {
  mission::Findings findings;
  parse_model({{"m.yaml", text}}, findings);
  std::string out;
  for (const auto& finding : findings.all())
    out += finding.text() + (finding.remedy.empty() ? "" : "; " + finding.remedy) + "\n";
  return out;
}

}  // namespace roci::planner::timeline_htn::reading
