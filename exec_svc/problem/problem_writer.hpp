/// Writes the PDDL problem from observations and goals: one code path for planning and replanning (R42). The
/// domain file never changes (R8); everything that does change stands here.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/beliefs/beliefs.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/mission/mission_model.hpp"

namespace roci::exec::problem {

struct ProblemObject {
  std::string name;
  std::string type;
  std::vector<temporal::Property> properties;
};

struct Problem {
  std::string text;
  std::vector<ProblemObject> objects;
};

/// What the mission keeps back for waiting and surprises (FluentSource::last).
enum class Reserves { kept, spent };

/// What will have changed before the problem's 0: facts come and go, fluents by so much.
struct Forecast {
  std::map<std::string, bool> facts{};
  std::map<std::string, double> changes{};
};

/// `origin`: the mission time that the problem calls 0. Windows that ended before it are left out.
Problem write_problem(const mission::MissionModel& mission, const beliefs::Beliefs& beliefs,
                      const goals::GoalSet& goals, const std::string& name, temporal::Time now,
                      temporal::Time origin, Reserves reserves = Reserves::kept,
                      const Forecast& forecast = {});

/// The goal's PDDL facts; it is achieved when all are observed.
std::vector<std::string> goal_facts(const mission::MissionModel& mission, const goals::GoalRequest& goal);

}  // namespace roci::exec::problem
