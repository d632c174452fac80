#include "exec_svc/problem/problem_writer.hpp"

#include "exec_svc/mission/condition_entry.hpp"
#include "exec_svc/mission/template_text.hpp"
#include "exec_svc/problem/pddl_problem.hpp"
#include "exec_svc/problem/timeline_problem.hpp"

namespace roci::exec::problem {

using beliefs::Beliefs;
using goals::GoalRecord;
using goals::GoalRequest;
using goals::GoalSet;
using mission::fill_names;
using mission::GoalKind;
using mission::MissionModel;

namespace {

const GoalKind* kind_of(const MissionModel& mission, const GoalRequest& goal) {
  const auto kind = mission.goal_kinds.find(goal.kind);
  return kind == mission.goal_kinds.end() ? nullptr : &kind->second;
}

temporal::Condition achieved(const MissionModel& mission, const GoalRequest& goal) {
  const GoalKind* kind = kind_of(mission, goal);
  return kind == nullptr ? temporal::Condition{} : fill_names(kind->achieved, template_values(goal));
}

temporal::Condition all_facts(const std::vector<std::string>& facts) {
  std::vector<temporal::Condition> parts;
  for (const std::string& fact : facts)
    parts.push_back(temporal::compare(fact, temporal::ConditionOp::eq, true));
  return parts.size() == 1 ? parts.front() : temporal::all_of(parts);
}

ProblemGoal problem_goal(const MissionModel& mission, const GoalRequest& goal) {
  return {
      goal.key,        mission.has_domain() ? all_facts(goal_facts(mission, goal)) : achieved(mission, goal),
      goal.importance, goal.utility,
      goal.priority,   goal.preferred,
      goal.opens,      goal.closes};
}

}  // namespace

std::vector<std::string> goal_facts(const MissionModel& mission, const GoalRequest& goal) {
  std::vector<std::string> out;
  const GoalKind* kind = kind_of(mission, goal);
  if (kind == nullptr) return out;
  for (const std::string& fact : kind->goal) out.push_back(fill_names(fact, template_values(goal)));
  return out;
}

bool is_achieved(const MissionModel& mission, const Beliefs& beliefs, const GoalRequest& goal) {
  const temporal::Condition condition = achieved(mission, goal);
  if (condition.empty()) return beliefs.holds(goal_facts(mission, goal));
  return evaluate(condition, [&](const std::string& name) { return beliefs.lookup(name); }) ==
         temporal::Truth::yes;
}

Problem write_problem(const MissionModel& mission, const Beliefs& beliefs, const GoalSet& goals,
                      const std::string& name, temporal::Time now, temporal::Time origin, Reserves reserves,
                      const Forecast& forecast) {
  const Situation situation{mission, beliefs, goals, now, origin, forecast};
  Problem out = mission.has_domain() ? write_pddl_problem(situation, name, reserves)
                                     : write_timeline_problem(situation);
  for (const GoalRecord* record : goals.open()) out.goals.push_back(problem_goal(mission, record->request));
  return out;
}

}  // namespace roci::exec::problem
