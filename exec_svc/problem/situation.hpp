/// What a problem is written from.
#pragma once

#include <string>
#include <vector>

#include "exec_svc/beliefs/beliefs.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/problem/problem.hpp"

namespace roci::exec::problem {

/// References to what outlives the writing.
struct Situation {
  const mission::MissionModel& mission;
  const beliefs::Beliefs& beliefs;
  const goals::GoalSet& goals;
  temporal::Time now;
  temporal::Time origin;  ///< mission time at which the plan begins
  const Forecast& forecast;
};

/// Part of a predicted window that a plan from the origin on can meet.
struct OpenInterval {
  temporal::Time from;
  temporal::Time to;
};

/// The intervals of a window that end after the origin; one that should be open now and was seen closed is left
/// out.
std::vector<OpenInterval> intervals_ahead(const mission::WindowModel& window, const Situation& situation);

/// The objects of a goal's kind, with the goal's own names and values.
std::vector<mission::ObjectModel> objects_of(const mission::MissionModel& mission,
                                             const goals::GoalRequest& goal);

/// The properties of an object, observed ones with their newest values.
std::vector<temporal::Property> properties_of(const mission::ObjectModel& object,
                                              const beliefs::Beliefs& beliefs);

/// A number as owners of functions and problems read it: six decimals.
std::string number_text(double value);

}  // namespace roci::exec::problem
