#include "exec_svc/reactor/goal_words.hpp"

#include "core/temporal/duration.hpp"

namespace roci::exec::reactor {

using goals::GoalRequest;
using mission::MissionModel;
using temporal::Verdict;

namespace {

std::string budget_of(const mission::PlannerSettings& planner, Verdict verdict) {
  if (verdict == Verdict::out_of_memory)
    return planner.memory_mb == 0 ? "memory" : "budget of " + std::to_string(planner.memory_mb) + " MB";
  std::string out;
  if (planner.work != 0) out = std::to_string(planner.work) + " evaluations";
  if (planner.wall.count() != 0) out += (out.empty() ? "" : " or ") + temporal::to_text(planner.wall);
  return "budget" + (out.empty() ? "" : " of " + out);
}

}  // namespace

std::string asked_for(const GoalRequest& goal, const MissionModel& mission) {
  const auto kind = mission.goal_kinds.find(goal.kind);
  const bool has_help = kind != mission.goal_kinds.end() && !kind->second.help.empty();
  std::string arguments;
  for (const auto& [name, value] : goal.arguments)
    arguments += (arguments.empty() ? " (" : ", ") + name + " " + value;
  return (has_help ? kind->second.help : goal.kind) + (arguments.empty() ? "" : arguments + ")");
}

std::string words_of_blamed(const PlanReply& reply, const BlockingGoal& blamed, const GoalRequest& goal,
                            const MissionModel& mission) {
  const std::string what = reply.verdict == Verdict::unsolvable ? "out of reach: " : "not known: ";
  if (!blamed.reason.empty()) return what + blamed.reason;
  return what + "no plan brings it about: " + asked_for(goal, mission);
}

std::string words_of_spent_budget(const PlanReply& reply, const GoalRequest& goal, const std::string& others,
                                  const MissionModel& mission) {
  return "no plan was found within the planner's " + budget_of(mission.planner, reply.verdict) + ": " +
         asked_for(goal, mission) + (others.empty() ? "" : ", together with " + others);
}

}  // namespace roci::exec::reactor
