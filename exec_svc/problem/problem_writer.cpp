#include "exec_svc/problem/problem_writer.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/pddl/printer.hpp"
#include "exec_svc/mission/condition_entry.hpp"
#include "exec_svc/mission/goal_formula.hpp"
#include "exec_svc/mission/template_text.hpp"
#include "exec_svc/problem/closed_world.hpp"
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

// Writes numbers without exponents, which PDDL lacks.
void write_numbers_out(const GoalKind& kind, std::map<std::string, std::string>& values) {
  for (const auto& [name, argument] : kind.arguments) {
    std::string& text = values[name];
    double number = 0;
    const bool has_exponent = text.find_first_of("eE") != std::string::npos;
    if (argument != mission::ArgumentKind::number || !has_exponent) continue;
    if (std::from_chars(text.data(), text.data() + text.size(), number).ec == std::errc())
      text = number_text(number);
  }
}

// Returns the condition over timelines; what these cannot express, such as quantifiers, is one fact by its own
// text, as the engine prints it when it names what is out of reach.
temporal::Condition condition_of(const pddl::Condition& formula) {
  temporal::Condition out = mission::over_timelines(formula);
  return out.empty() ? temporal::compare(pddl::print(formula), temporal::ConditionOp::eq, true) : out;
}

// Returns the kind's PDDL goal over timelines.
temporal::Condition pddl_goal(const MissionModel& mission, const GoalRequest& goal) {
  const GoalKind* kind = kind_of(mission, goal);
  if (kind == nullptr || !kind->formula) return all_facts(goal_facts(mission, goal));
  std::vector<temporal::Condition> parts;
  for (const std::string& fact : goal_facts(mission, goal))
    parts.push_back(condition_of(mission::read_goal_formula(fact)));
  return parts.size() == 1 ? parts.front() : temporal::all_of(parts);
}

ProblemGoal problem_goal(const MissionModel& mission, const GoalRequest& goal) {
  return {goal.key,        mission.has_domain() ? pddl_goal(mission, goal) : achieved(mission, goal),
          goal.importance, goal.utility,
          goal.priority,   goal.preferred,
          goal.opens,      goal.closes};
}

bool is_judged_by_formula(const MissionModel& mission, const GoalRequest& goal) {
  const GoalKind* kind = kind_of(mission, goal);
  return kind != nullptr && kind->formula && kind->achieved.empty();
}

// Which part of domain or goal ranges over too many objects to be judged; empty: none does.
std::string unjudged_part(const pddl::Problem& known, const MissionModel& mission, const GoalRequest& goal) {
  ClosedWorld world(*mission.domain, known);
  for (const std::string& fact : goal_facts(mission, goal)) world.truth_of(mission::read_goal_formula(fact));
  return world.given_up_at();
}

// A goal whose end nobody could see would never end.
void name_unjudged_goals(const Situation& situation, Problem& out) {
  std::optional<pddl::Problem> known;
  for (const GoalRecord* record : situation.goals.open()) {
    const GoalRequest& goal = record->request;
    if (!is_judged_by_formula(situation.mission, goal)) continue;
    if (std::ranges::find(out.unusable_goals, goal.key, &UnusableGoal::key) != out.unusable_goals.end())
      continue;
    if (!known) known = pddl_tree(situation, Reserves::kept);
    const std::string part = unjudged_part(*known, situation.mission, goal);
    if (!part.empty())
      out.unusable_goals.push_back(
          {goal.key, "whether it holds takes over " + std::to_string(ClosedWorld::kMostSteps) +
                         " steps to tell: " + part + " ranges over too many objects"});
  }
}

}  // namespace

std::vector<std::string> goal_facts(const MissionModel& mission, const GoalRequest& goal) {
  std::vector<std::string> out;
  const GoalKind* kind = kind_of(mission, goal);
  if (kind == nullptr) return out;
  auto values = template_values(goal);
  if (kind->formula) write_numbers_out(*kind, values);
  for (const std::string& fact : kind->goal) out.push_back(fill_names(fact, values));
  return out;
}

bool is_achieved(const MissionModel& mission, const Beliefs& beliefs, const GoalRequest& goal) {
  const temporal::Condition condition = achieved(mission, goal);
  if (condition.empty()) return beliefs.holds(goal_facts(mission, goal));
  const auto lookup = [&](const std::string& name) {
    const auto concluded = beliefs.concluded().find(name);
    return concluded == beliefs.concluded().end() ? beliefs.lookup(name) : std::optional(concluded->second);
  };
  return evaluate(condition, lookup) == temporal::Truth::yes;
}

bool is_achieved(const MissionModel& mission, const Beliefs& beliefs, const GoalSet& goals,
                 const GoalRequest& goal, temporal::Time now) {
  if (!is_judged_by_formula(mission, goal)) return is_achieved(mission, beliefs, goal);
  if (!beliefs.unobserved().empty()) return false;
  const Forecast none;
  const pddl::Problem known = pddl_tree({mission, beliefs, goals, now, now, none}, Reserves::kept);
  ClosedWorld world(*mission.domain, known);
  for (const std::string& fact : goal_facts(mission, goal))
    if (world.truth_of(mission::read_goal_formula(fact)) != temporal::Truth::yes) return false;
  return true;
}

Problem write_problem(const MissionModel& mission, const Beliefs& beliefs, const GoalSet& goals,
                      const std::string& name, temporal::Time now, temporal::Time origin, Reserves reserves,
                      const Forecast& forecast) {
  const Situation situation{mission, beliefs, goals, now, origin, forecast};
  Problem out = mission.has_domain() ? write_pddl_problem(situation, name, reserves)
                                     : write_timeline_problem(situation);
  if (mission.domain) name_unjudged_goals(situation, out);
  for (const GoalRecord* record : goals.open()) out.goals.push_back(problem_goal(mission, record->request));
  return out;
}

}  // namespace roci::exec::problem
