// A situation is what a problem is written from.
#pragma once

#include <string>
#include <vector>

#include "exec_svc/beliefs/beliefs.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/problem/problem.hpp"

namespace roci::exec::problem {

/// Refers to what a problem is written from, all of which must outlive the writing.
struct Situation {
  const mission::MissionModel& mission;
  const beliefs::Beliefs& beliefs;
  const goals::GoalSet& goals;
  temporal::Time now;
  temporal::Time origin;  ///< mission time at which the plan begins
  const Forecast& forecast;
};

/// Holds a part of a predicted window that a plan from the origin on can meet.
struct OpenInterval {
  temporal::Time from;
  temporal::Time to;
};

/// Returns the intervals of a window that end after the origin, without one that should be open now but was
/// seen closed.
std::vector<OpenInterval> intervals_ahead(const mission::WindowModel& window, const Situation& situation);

/// Returns the objects of a goal's kind, with the goal's own names and values.
std::vector<mission::ObjectModel> objects_of(const mission::MissionModel& mission,
                                             const goals::GoalRequest& goal);

/// Returns the properties of an object, observed ones with their newest values.
std::vector<temporal::Property> properties_of(const mission::ObjectModel& object,
                                              const beliefs::Beliefs& beliefs);

/// Formats a number as owners of functions and problems read it: with six decimals.
std::string number_text(double value);

}  // namespace roci::exec::problem
