// What an engine is asked for: the problem as plain values, whatever the engine's own language.
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

/// Has the order of GoalClass in idl/goal.idl.
enum class GoalClass { hard, optional, opportunistic };

/// A goal, known by its issuer and its id. In a call it comes as a condition, which the executive has made of
/// the goal's kind; an engine that plans all the time hears kind and arguments, and its model says what they
/// mean.
struct Goal {
  std::string issuer;
  std::string id;
  temporal::Condition achieved;  ///< is to hold at the end; empty in goals that are heard
  std::string kind;              ///< of goals that are heard
  std::vector<temporal::Property> arguments;
  GoalClass importance = GoalClass::hard;
  temporal::RankVector utility;
  std::int32_t priority = 0;
  temporal::Time preferred = temporal::no_bound;  ///< mission time; no_bound: none
  temporal::Time opens{0};                        ///< earliest mission time of its achievement
  temporal::Time closes = temporal::no_bound;     ///< latest; no_bound: none

  /// "issuer/id", as PlanActivity::goals_served names it.
  std::string key() const { return issuer + "/" + id; }
  friend bool operator==(const Goal&, const Goal&) = default;
};

/// A value that a timeline is known to take at a mission time to come.
struct PredictedValue {
  std::string timeline;
  temporal::Time at{0};
  temporal::Value value;
};

/// An object with what owners of functions need to know of it, e.g. x = 12.5 in metres.
struct Object {
  std::string name;
  std::string type;
  std::vector<temporal::Property> properties;
};

/// An action that is left of an earlier plan; times count from that plan's origin.
struct RemainingAction {
  std::string name;
  std::vector<std::string> arguments;
  temporal::Duration start{0};
  temporal::Duration duration{0};
};

/// Values of timelines by their names.
using Timelines = std::map<std::string, temporal::Value>;

/// Is the budget for better plans of a mission that says none: some 60 ms in the missions at hand.
inline constexpr std::uint64_t kImprovement = 1000;

/// One planning problem. Of an engine that plans all the time it is what was heard so far: `origin` is then
/// the time of the step, `state` the newest observations, and `goals` are those that are open.
struct Request {
  std::string engine;  ///< its name in the table
  std::string robot;   ///< whose plan it is; empty: the only one
  temporal::Time origin{0};
  /// Is the mission's, in the engine's own language, with what it includes (mission::model_text).
  std::string model;
  std::string problem_text;  ///< for engines that read text; else empty
  Timelines state;           ///< at the origin
  std::vector<PredictedValue> predictions;
  std::vector<Goal> goals;
  std::vector<Object> objects;
  /// Stands in order of time; what is unknown or impossible by now is to be passed over.
  std::vector<RemainingAction> remaining;
  std::uint64_t work = 0;                          ///< budget in evaluations; 0: no bound
  std::size_t memory_bytes = 0;                    ///< budget; 0: no bound
  FunctionsMode functions = FunctionsMode::eager;  ///< which values owners are asked for
  /// Evaluations that may be spent on better plans once there is one, beside `work`; 0: none. It is the mission's and
  /// not on the wire: whoever hosts the engine sets it.
  std::uint64_t improvement = kImprovement;
  /// Ways to search that run side by side, by the engine's own names (R132), and on how many threads; none: as the
  /// engine does of itself. Likewise the host's to say.
  std::vector<std::string> resolvers{};
  std::size_t threads = 1;
};

/// What may end a call early. Both functions may be called from any thread, and as often as every
/// millisecond.
struct Limits {
  std::function<bool()> cancelled = [] { return false; };    ///< nobody waits for the answer any more
  std::function<bool()> out_of_time = [] { return false; };  ///< the budget of wall time is spent
};

}  // namespace roci::planner::engine
