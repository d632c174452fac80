/// A planning problem as plain values: as text for engines that read PDDL, as timelines for all others.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/temporal/condition.hpp"
#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/goals/goal_set.hpp"

namespace roci::exec::problem {

struct ProblemObject {
  std::string name;
  std::string type;
  std::vector<temporal::Property> properties;
};

/// A value that a timeline is known to take at a mission time to come.
struct PredictedValue {
  std::string timeline;
  temporal::Time at{0};
  temporal::Value value;
};

/// A goal as an engine sees it. In a PDDL problem the timelines of the condition are facts, "(sent image-a)", or whole
/// conditions that timelines cannot say, "(exists (?m - module) …)".
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

/// A part of what is known that the problem does without, since with it the problem would be invalid.
struct LeftOut {
  std::string part;  ///< "(have-image image-7)"
  std::string why;   ///< in plain words
};

/// A goal that makes the problem invalid.
struct UnusableGoal {
  goals::GoalKey key;
  std::string why;  ///< in plain words
};

struct Problem {
  std::string text;                              ///< in PDDL; empty without a domain
  std::map<std::string, temporal::Value> state;  ///< timelines at the origin; empty with a domain
  std::vector<PredictedValue> predictions;       ///< in order of time; empty with a domain
  std::vector<ProblemGoal> goals;                ///< open ones, in order of arrival
  std::vector<ProblemObject> objects;
  // Found while it is written, told at once, and no part of the problem: the archive passes over them.
  std::vector<LeftOut> left_out;
  std::vector<UnusableGoal> unusable_goals;
};

/// What the mission keeps back for waiting and surprises (FluentSource::last).
enum class Reserves { kept, spent };

/// What will have changed before the problem begins, by fact, fluent or timeline.
struct Forecast {
  std::map<std::string, temporal::Value> values{};  ///< that they will have
  std::map<std::string, double> changes{};          ///< by which numbers will have changed
};

}  // namespace roci::exec::problem
