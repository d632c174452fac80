// A plan as it leaves the engine: activities, and the simple temporal network over their time points.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "core/temporal/duration.hpp"
#include "core/temporal/flexible_plan.hpp"

namespace roci::planner::temporal_pddl::extraction {

/// What a time point of the network is.
enum class PointKind { origin, start, end, timed_literal };

/// [earliest, latest] are shortest paths of the network from and to the origin (R48): every value between
/// them is taken in some schedule that obeys all constraints.
struct NetworkPoint {
  PointKind kind = PointKind::origin;
  std::size_t activity = 0;  ///< of start and end: index of Plan::activities
  temporal::Duration earliest{0};
  temporal::Duration latest = temporal::no_bound;
};

/// The simple temporal network of a plan. Orderings (R22, R23) have the lower bound 0 or ε and no upper one;
/// durations (R24) lead from the start to the end of one activity; windows (R32, R33) lead from the origin to
/// a time point that a timed initial literal bounds.
struct Network {
  std::vector<NetworkPoint> points;  ///< [0] is the origin, time 0 of the problem
  std::vector<temporal::TemporalConstraint> constraints;
};

/// One action of the plan. A plain PDDL action has one time point: start_point == end_point.
struct Activity {
  std::string name;
  std::vector<std::string> arguments;
  bool durative = true;
  temporal::TimePoint start_point = 0;  ///< index of Network::points
  temporal::TimePoint end_point = 0;    ///< likewise
  temporal::Duration start{0};          ///< in the schedule of earliest times
  temporal::Duration end{0};            ///< likewise
  temporal::Duration min_duration{0};
  temporal::Duration max_duration = temporal::no_bound;
  /// These have objects in place of parameters, and numbers in place of constant fluents and external
  /// functions. Conditions are parts of conjunctions; `forall` effects are written out.
  std::vector<pddl::Condition> at_start, over_all, at_end;
  std::vector<pddl::Effect> start_effects, end_effects;
  std::vector<std::size_t> goals_served;  ///< indices of the goals that were named, see goal_support.hpp
};

/// Holds a plan as it leaves the engine.
struct Plan {
  std::vector<Activity> activities;  ///< by start time
  Network network;
  temporal::Duration makespan{0};
  double metric = 0;  ///< as the problem states it; without a metric, the makespan in seconds
};

}  // namespace roci::planner::temporal_pddl::extraction
