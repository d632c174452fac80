// FlexiblePlan is the one plan type of all engines: activities, tokens, decision points and a simple temporal
// network. idl/plan.idl is its wire form; the names there are the names here.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/temporal/condition.hpp"
#include "core/temporal/duration.hpp"
#include "core/temporal/rank_vector.hpp"
#include "core/temporal/stn.hpp"
#include "core/temporal/value.hpp"

namespace roci::temporal {

/// Says what a temporal constraint is for; the network treats all kinds alike.
enum class ConstraintKind { ordering, duration, window };

/// Requires lower <= t[to_point] - t[from_point] <= upper. Point 0 is the plan's origin. upper must be >= 0
/// (a constraint is turned round otherwise).
struct TemporalConstraint {
  TimePoint from_point = 0;
  TimePoint to_point = 0;
  ConstraintKind kind = ConstraintKind::ordering;
  Duration lower{0};
  Duration upper = no_bound;
  friend bool operator==(const TemporalConstraint&, const TemporalConstraint&) = default;
};

/// Says how an impact changes a timeline.
enum class ImpactKind { assign, delta, rate };  ///< rate: per second

/// Says when in its activity an impact acts.
enum class ImpactWhen { at_start, at_end, during };

/// Says what an activity does to a timeline, and when.
struct Impact {
  std::string timeline;
  ImpactKind kind = ImpactKind::assign;
  ImpactWhen moment = ImpactWhen::at_start;
  Value amount;
  friend bool operator==(const Impact&, const Impact&) = default;
};

/// Says what happens when an activity's latest start has passed.
enum class LatenessPolicy {
  /// Breaks the plan (Stellar, R49).
  replan,
  /// Lets it wait on until wait_timeout, and succeed only after the shortest duration has elapsed (MEXEC,
  /// R86, R98).
  push,
  /// Does as `replan`; the activity must moreover end before the latest next change of its timeline
  /// (SanchoExpress, R144).
  deadline,
};

/// Says whether an engine may still change an activity in its next versions (R78).
enum class CommitState { planned, committed };

/// Says what else fails with an activity that has failed for good.
enum class FailureScope {
  of_plan,      ///< the plan is broken
  of_activity,  ///< nothing: it fails alone, what needs its effects fails or is skipped when its turn comes
};

/// Says how far an activity has come, as everybody sees it.
enum class ActivityState { waiting, dispatched, running, succeeded, failed, skipped, cancelled };
/// Returns whether the activity has ended, or never will start.
constexpr bool is_over(ActivityState state) {
  return state != ActivityState::waiting && state != ActivityState::dispatched &&
         state != ActivityState::running;
}

/// Holds a named word, such as an argument of a command.
struct Property {
  std::string name;
  std::string value;
  friend bool operator==(const Property&, const Property&) = default;
};

/// Describes one command of a sequence; the members mean what they mean in PlanActivity.
struct PlanCommand {
  std::string owner;
  std::string robot;
  std::string subsystem;
  std::string command_name;
  std::vector<Property> arguments;
  Duration answer_within = no_bound;
  friend bool operator==(const PlanCommand&, const PlanCommand&) = default;
};

/// Describes one activity. The executive sends (id, attempt) as a command's key: ids must not be used again
/// in later plans for anything else.
struct PlanActivity {
  std::string id;
  std::string name;    ///< action or task name
  std::string level;   ///< level of the hierarchy, e.g. "mission" (R130); empty: plans without one
  std::string parent;  ///< activity of the level above; empty: none
  std::string owner;   ///< service that executes the command; empty: no command, internal states only
  std::string robot;   ///< robot that has the subsystem; empty: the owner's only one
  std::string subsystem;
  std::string command_name;
  std::vector<Property> arguments;
  /// Bounds the time from sending the command to its first answer; no_bound leaves it to the executive's
  /// settings.
  Duration answer_within = no_bound;
  /// Holds the commands that follow, each after the end of the one before (R67).
  std::vector<PlanCommand> then;
  TimePoint start_point = 0;  ///< own points: no two activities share one, none is the origin
  TimePoint end_point = 0;
  Duration duration_lower{0};
  Duration duration_upper = no_bound;
  Duration preferred_start = no_bound;  ///< counts from the origin (R67); no_bound: none
  Condition pre;
  Condition maintenance;
  Condition post;
  std::vector<Impact> impacts;
  Duration wait_timeout = no_bound;  ///< bounds its wait after its earliest start; push needs one
  std::uint32_t retries = 0;
  bool may_skip = false;  ///< skipped instead of failed when it cannot start in time
  Condition skip_if;      ///< not empty and true at the start: skipped
  LatenessPolicy lateness = LatenessPolicy::replan;
  CommitState commit = CommitState::planned;
  FailureScope failure = FailureScope::of_plan;
  std::string contingency;
  std::int32_t priority = 0;
  std::vector<std::string> goals_served;  ///< "issuer/id"
  RankVector utility;
  friend bool operator==(const PlanActivity&, const PlanActivity&) = default;
};

/// Says that a timeline holds a value between two time points.
struct Token {
  std::string timeline;
  Value held;
  TimePoint start_point = 0;
  TimePoint end_point = 0;
  friend bool operator==(const Token&, const Token&) = default;
};

/// Says who resolves a decision at run time.
enum class ResolverKind {
  engine,  ///< the engine that made the plan
  ground,
  rule,  ///< the choices' own conditions: the first choice whose rule holds is taken
};

/// Describes one of the ways in which a decision may go.
struct DecisionChoice {
  std::string name;
  std::vector<std::string> activities{};  ///< ids; those of the other choices are skipped
  Condition rule{};                       ///< resolves with resolver `rule`; empty: always true
  friend bool operator==(const DecisionChoice&, const DecisionChoice&) = default;
};

/// Names an argument of an activity's command that an answer binds.
struct ArgumentBinding {
  std::string activity;
  std::string argument;
  friend bool operator==(const ArgumentBinding&, const ArgumentBinding&) = default;
};

/// Describes an open choice that is made at run time, before `decide_before` may happen (R131): an answer
/// picks one of the choices' activities, or binds a value to arguments of activities that have not started.
struct DecisionPoint {
  std::string id;
  std::string resolver;  ///< service or issuer that is asked; empty: whoever is of the kind
  std::vector<DecisionChoice> choices{};
  TimePoint decide_before = 0;
  ResolverKind resolver_kind = ResolverKind::engine;
  std::vector<ArgumentBinding> bindings{};
  std::vector<std::string> admissible{};  ///< values that may be bound; empty: any
  friend bool operator==(const DecisionPoint&, const DecisionPoint&) = default;
};

/// Says how a function value stands to the true one.
enum class FunctionAccuracy {
  exact,
  lower_bound,  ///< never above it: admissible
  estimate,     ///< neither
};

/// Tells the provenance of a value of an external function on which the plan stands.
struct FunctionValueUse {
  std::string function;
  std::vector<std::string> arguments;
  double number = 0;
  std::string owner;
  std::uint64_t model_version = 0;
  Time computed{0};
  FunctionAccuracy accuracy = FunctionAccuracy::exact;
  friend bool operator==(const FunctionValueUse&, const FunctionValueUse&) = default;
};

/// Holds a whole plan; times are relative to `origin`.
struct FlexiblePlan {
  std::string id;
  std::uint32_t version = 0;
  std::string engine;
  Time origin{0};  ///< mission time of time point 0
  std::uint32_t point_count = 1;
  std::vector<PlanActivity> activities;
  std::vector<Token> tokens;
  std::vector<DecisionPoint> decisions;
  std::vector<TemporalConstraint> constraints;
  std::vector<FunctionValueUse> function_values;
  friend bool operator==(const FlexiblePlan&, const FlexiblePlan&) = default;
};

/// Returns everything wrong with the plan's form, one plain sentence each; with none it can be executed. It
/// checks ids, indices, bounds, condition trees, references of parents and choices, and that the network has
/// a solution in which no point lies before the origin.
std::vector<std::string> check(const FlexiblePlan& plan);

/// Returns the plan's whole network: first one constraint of kind duration per activity, at the activity's
/// index (those of the plan between the same two points are merged into it); then "not before the origin" for
/// every point, "start before end" for every token, and the plan's other constraints.
std::vector<TemporalConstraint> all_constraints(const FlexiblePlan& plan);

}  // namespace roci::temporal
