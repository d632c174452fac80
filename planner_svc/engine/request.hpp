// A request is what an engine is asked for: the problem as plain values, whatever the engine's own language.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/temporal/condition.hpp"
#include "core/temporal/duration.hpp"
#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/rank_vector.hpp"
#include "core/temporal/value.hpp"
#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::engine {

/// Says how much a goal matters, in the order of GoalClass in idl/goal.idl.
enum class GoalClass { hard, optional, opportunistic };

/// Describes a goal, known by its issuer and its id. In a call it comes as a condition, which the executive
/// has made of the goal's kind; an engine that plans all the time hears kind and arguments, and its model
/// says what they mean.
struct Goal {
  std::string issuer;
  std::string id;
  temporal::Condition achieved;  ///< condition at the end; empty in goals that are heard
  std::string kind;              ///< set in goals that are heard
  std::vector<temporal::Property> arguments;
  GoalClass importance = GoalClass::hard;
  temporal::RankVector utility;
  std::int32_t priority = 0;
  temporal::Time preferred = temporal::no_bound;  ///< mission time; no_bound: none
  temporal::Time opens{0};                        ///< earliest mission time of its achievement
  temporal::Time closes = temporal::no_bound;     ///< latest; no_bound: none

  /// Returns "issuer/id", as PlanActivity::goals_served names it.
  std::string key() const { return issuer + "/" + id; }
  friend bool operator==(const Goal&, const Goal&) = default;
};

/// Holds a value that a timeline is known to take at a future mission time.
struct PredictedValue {
  std::string timeline;
  temporal::Time at{0};
  temporal::Value value;
};

/// Describes an object with what owners of functions need to know of it, e.g. x = 12.5 in metres.
struct Object {
  std::string name;
  std::string type;
  std::vector<temporal::Property> properties;
};

/// Holds an action that is left of an earlier plan; times count from that plan's origin.
struct RemainingAction {
  std::string name;
  std::vector<std::string> arguments;
  temporal::Duration start{0};
  temporal::Duration duration{0};
};

/// Holds values of timelines by their names.
using Timelines = std::map<std::string, temporal::Value>;

/// Gives the budget for better plans of a mission that says none: some 60 ms in the missions at hand.
inline constexpr std::uint64_t kImprovement = 1000;

/// Holds one planning problem. For an engine that plans all the time it is what was heard so far: `origin` is
/// then the time of the step, `state` the newest observations, and `goals` are those that are open.
struct Request {
  std::string engine;  ///< its name in the table
  std::string robot;   ///< whose plan it is; empty: the only one
  temporal::Time origin{0};
  /// Holds the mission's model in the engine's own language, with what it includes (mission::model_text).
  std::string model;
  std::string problem_text;  ///< for engines that read text; else empty
  Timelines state;           ///< at the origin
  std::vector<PredictedValue> predictions;
  std::vector<Goal> goals;
  std::vector<Object> objects;
  /// Lists what remains of an earlier plan, in order of time; actions that are unknown or impossible by now
  /// are to be ignored.
  std::vector<RemainingAction> remaining;
  std::uint64_t work = 0;                          ///< budget in evaluations; 0: no bound
  std::size_t memory_bytes = 0;                    ///< budget; 0: no bound
  FunctionsMode functions = FunctionsMode::eager;  ///< which values owners are asked for
  /// Bounds the evaluations that may be spent on better plans once there is one, beside `work`; 0: none. It is set by
  /// the engine's host from the mission and is not on the wire.
  std::uint64_t improvement = kImprovement;
  /// Name the ways to search that run side by side, by the engine's own names (R132; none: the engine's default),
  /// and the number of threads. The host sets them, too.
  std::vector<std::string> resolvers{};
  std::size_t threads = 1;
};

/// Says what may end a call early. Both functions may be called from any thread, and as often as every
/// millisecond.
struct Limits {
  std::function<bool()> cancelled = [] { return false; };    ///< nobody waits for the answer any more
  std::function<bool()> out_of_time = [] { return false; };  ///< the budget of wall time is spent
};

}  // namespace roci::planner::engine
