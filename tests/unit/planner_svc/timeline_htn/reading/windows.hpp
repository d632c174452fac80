// A model with a timeline that is predicted: messages are sent while the ground is seen.
#pragma once

#include <string>

namespace roci::planner::timeline_htn::reading {

inline const std::string kWindows = R"yaml(format: 1
domain: relay
types: [text]
objects: {text: [first, second, third]}
components:
  mission:
    layer: abstract
    states:
      idle: {kind: default, observed: {timeline: mission}}
      telling: {kind: complex, parameters: {what: text}, observed: {timeline: mission}}
      told: {kind: default, parameters: {what: text}, observed: {timeline: mission}}
    transitions: ["idle -> telling(x)", "telling(x) -> told(x)", "told(x) -> telling(y)"]
  antenna:
    layer: primitive
    states:
      silent: {kind: default, observed: {timeline: antenna}}
      sending: {kind: simple, parameters: {what: text}, duration_s: [60, 90], needs: [during ground.seen]}
    transitions: ["silent <-> sending(x)"]
  ground:
    layer: primitive
    states:
      hidden: {kind: default, observed: {timeline: ground.window, value: false}}
      seen: {kind: default, observed: {timeline: ground.window, value: true}}
    transitions: [hidden <-> seen]
behaviours:
  tell: {achieves: mission.telling(what), subgoals: {send: antenna.sending(what)}}
problem:
  horizon_s: 3600
  initial: {mission: idle, antenna: silent, ground: hidden}
  predicted:
    ground:
      - {at_s: 100, state: seen}
      - {at_s: 130, state: hidden}
      - {at_s: 600, state: seen}
      - {at_s: 730, state: hidden}
      - {at_s: 2000, state: seen}
  goals: {one: mission.told(first), two: mission.told(second), three: mission.told(third)}
)yaml";

}  // namespace roci::planner::timeline_htn::reading
