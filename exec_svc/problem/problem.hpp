// A planning problem is made of plain values: text for engines that read PDDL, timelines for all others.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/temporal/condition.hpp"
#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/goals/goal_set.hpp"

namespace roci::exec::problem {

/// Describes an object of the problem.
struct ProblemObject {
  std::string name;
  std::string type;
  std::vector<temporal::Property> properties;
};

/// Holds a value that a timeline is known to take at a future mission time.
struct PredictedValue {
  std::string timeline;
  temporal::Time at{0};
  temporal::Value value;
};

/// Describes a goal as an engine sees it. In a PDDL problem the timelines of the condition are facts, "(sent
/// image-a)", or whole conditions that timelines cannot express, "(exists (?m - module) …)".
struct ProblemGoal {
  goals::GoalKey key;
  temporal::Condition achieved;
  goals::GoalClass importance = goals::GoalClass::hard;
  temporal::RankVector utility;
  std::int32_t priority = 0;
  temporal::Time preferred = temporal::no_bound;  ///< mission time; no_bound: none
  temporal::Time opens{0};                        ///< mission time; 0: any
  temporal::Time closes{0};                       ///< mission time; 0: none
};

/// Names a known part that is left out of the problem because it would make the problem invalid.
struct LeftOut {
  std::string part;  ///< "(have-image image-7)"
  std::string why;   ///< in plain words
};

/// Names a goal that makes the problem invalid.
struct UnusableGoal {
  goals::GoalKey key;
  std::string why;  ///< in plain words
};

/// Holds all that an engine needs to plan: the state at the origin, what is predicted, the goals and the
/// objects.
struct Problem {
  std::string text;                              ///< in PDDL; empty without a domain
  std::map<std::string, temporal::Value> state;  ///< timelines at the origin; empty with a domain
  std::vector<PredictedValue> predictions;       ///< in order of time; empty with a domain
  std::vector<ProblemGoal> goals;                ///< open ones, in order of arrival
  std::vector<ProblemObject> objects;
  // The rest is found while the problem is written, and reported at once. It is no part of the problem, and
  // the archive omits it.
  std::vector<LeftOut> left_out;
  std::vector<UnusableGoal> unusable_goals;
};

/// Says whether the mission's reserves for waiting and surprises may be used (FluentSource::last).
enum class Reserves { kept, spent };

/// Holds what will have changed before the problem begins, by fact, fluent or timeline.
struct Forecast {
  std::map<std::string, temporal::Value> values{};  ///< values that they will have
  std::map<std::string, double> changes{};          ///< amounts by which numbers will have changed
};

}  // namespace roci::exec::problem
