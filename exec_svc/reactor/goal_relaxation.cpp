#include "exec_svc/reactor/goal_relaxation.hpp"

#include <algorithm>

#include "exec_svc/problem/problem_writer.hpp"

namespace roci::exec::reactor {

using goals::GoalClass;
using goals::GoalKey;
using goals::GoalRecord;
using goals::GoalSet;
using goals::GoalState;
using mission::FluentSource;
using mission::MissionModel;
using temporal::Verdict;

namespace {

GoalKey newest_hard(const GoalSet& goals) {
  GoalKey out;
  for (const GoalRecord* record : goals.open())
    if (record->request.importance == GoalClass::hard) out = record->request.key;
  return out;
}

/// Open goals that a proof blames; where it blames none by name, those of which a fact stands in its reason.
std::vector<GoalKey> named_goals(const PlanReply& reply, const GoalSet& goals, const MissionModel& mission) {
  std::vector<GoalKey> out;
  if (reply.verdict != Verdict::unsolvable) return out;
  const auto blamed = [&](const GoalRecord& record) {
    return std::ranges::find(reply.blocking, record.request.key, &BlockingGoal::key) != reply.blocking.end();
  };
  for (const GoalRecord* record : goals.open())
    if (blamed(*record)) out.push_back(record->request.key);
  if (!reply.blocking.empty()) return out;
  for (const GoalRecord* record : goals.open()) {
    const auto facts = problem::goal_facts(mission, record->request);
    const auto named = [&](const std::string& fact) { return reply.reason.find(fact) != std::string::npos; };
    if (std::any_of(facts.begin(), facts.end(), named)) out.push_back(record->request.key);
  }
  return out;
}

bool keeps_reserves(const MissionModel& mission) {
  return std::any_of(mission.fluents.begin(), mission.fluents.end(),
                     [](const FluentSource& source) { return source.last.has_value(); });
}

}  // namespace

RelaxationStep relax(const PlanReply& reply, const GoalSet& goals, const MissionModel& mission,
                     const Relaxation& relaxed) {
  using Kind = RelaxationStep::Kind;
  const bool proved = reply.verdict == Verdict::unsolvable;
  const std::string reason =
      std::string(proved ? "proved that not all goals fit" : to_string(reply.verdict)) +
      (reply.reason.empty() ? "" : ": " + reply.reason);
  if (const auto soft = soft_goal_to_give_up(reply, goals, mission, relaxed))
    return {Kind::give_up_soft, {*soft}, reason};
  const std::vector<GoalKey> named = named_goals(reply, goals, mission);
  if (!named.empty() && relaxed.soft_goals_left_out.empty() && goals.drop_candidate())
    return {Kind::leave_out_soft, {}, reason};
  const auto hard = named.empty() ? std::vector{newest_hard(goals)} : named;
  const bool spend = keeps_reserves(mission) && relaxed.reserves == problem::Reserves::kept;
  return {spend ? Kind::spend_reserves : Kind::give_up_hard, hard, reason};
}

std::optional<GoalKey> soft_goal_to_give_up(const PlanReply& reply, const GoalSet& goals,
                                            const MissionModel& mission, const Relaxation& relaxed) {
  const std::vector<GoalKey> named = named_goals(reply, goals, mission);
  const bool of_hard_alone = reply.verdict == Verdict::unsolvable && !relaxed.soft_goals_left_out.empty();
  return named.empty() && !of_hard_alone ? goals.drop_candidate() : goals.drop_candidate(named);
}

GoalSet hard_goals(const GoalSet& goals) {
  GoalSet out = goals;
  for (const GoalRecord* record : goals.open())
    if (record->request.importance != GoalClass::hard)
      out.set_state(record->request.key, GoalState::dropped, "");
  return out;
}

}  // namespace roci::exec::reactor
