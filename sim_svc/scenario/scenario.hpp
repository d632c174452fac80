// A scenario is made of values: how a run starts, what is done to it at which time, and which events are
// expected of it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/mission/entry.hpp"
#include "sim_svc/scenario/event_order.hpp"
#include "sim_svc/world/disturbance.hpp"
#include "sim_svc/world/values.hpp"
#include "sim_svc/world/windows.hpp"

namespace roci::sim::scenario {

/// Says how much a goal of the scenario matters.
enum class Importance { hard, optional, opportunistic };

/// Describes a goal that somebody else than the robot publishes during the run.
struct GoalStimulus {
  std::string issuer;
  std::string id;
  std::string kind;
  std::string robot;  ///< robot that is to achieve it; empty: the only one
  Importance importance = Importance::optional;
  std::vector<double> utility{1};  ///< by rank, the highest first
  std::int32_t priority = 0;
  std::optional<temporal::Time> preferred;
  temporal::Time opens{};   ///< 0: any time
  temporal::Time closes{};  ///< 0: none
  std::vector<std::pair<std::string, std::string>> arguments;
  std::optional<mission::Entry> entry{};  ///< where it stands in the file
};

/// Lets the issuer recall a goal.
struct RecallStimulus {
  std::string issuer;
  std::string id;
};

/// Lets the ground tell those who keep a map of an obstacle.
struct HazardStimulus {
  std::string id;
  world::Rock rock;
};

/// Lets the ground replace the network of a planner, or set one of its parameters.
struct NetworkStimulus {
  std::string issuer;
  std::string id;
  std::string robot;    ///< whose planner; empty: the only one
  std::string content;  ///< of the file in binary form, as it is; empty: a parameter is set
  std::string parameter;
  double value = 0;
};

/// Names what the ground may order; the words are those of `roci order`.
enum class OrderKind { hold, release, approve, set_value, autonomy, answer, drop, relaunch, safe, command };

/// Describes an order of the ground to an executive (docs/orders.md); which of the members count depends on
/// its kind.
struct OrderStimulus {
  std::string issuer;
  std::string id;
  std::string robot;  ///< whose executive; empty: the only one
  OrderKind kind = OrderKind::hold;
  std::string target{};  ///< an activity, a timeline, a decision or a component
  temporal::Value value{};
  std::string choice{};
  int level = 4;  ///< of autonomy: 1 to 4
};

/// Describes something that the scenario lets happen at a time.
struct Stimulus {
  temporal::Time at{};
  std::variant<GoalStimulus, RecallStimulus, HazardStimulus, NetworkStimulus, OrderStimulus,
               world::Disturbance>
      what;
  /// Says where `what` stands in the file, if it was read from one.
  std::optional<mission::Entry> entry{};
};

/// Says how a robot begins.
struct Start {
  std::optional<world::Pose> pose;
  std::optional<mission::Entry> pose_entry;  ///< where it stands in the file
  std::optional<double> battery_j;
  std::map<std::string, mission::Entry> components;  ///< component → what its type makes of it
};

/// Says what happens in a run: scenarios/<name>.yaml of a mission.
struct Scenario {
  std::string description;
  temporal::Duration duration{};        ///< the run ends here at the latest
  std::map<std::string, Start> starts;  ///< go by robot
  /// Holds settings for every component that has one of the name, instead of the mission's.
  std::map<std::string, mission::Entry> conditions;
  std::vector<world::Rock> rocks;      ///< there from the start, on no map
  std::vector<world::Window> windows;  ///< true ones where they differ from the predicted
  std::vector<Stimulus> stimuli;       ///< stand in order of time
  std::vector<ExpectedEvent> expect;   ///< empty: anything may happen
};

}  // namespace roci::sim::scenario
