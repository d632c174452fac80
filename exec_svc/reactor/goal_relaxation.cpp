#include "exec_svc/reactor/goal_relaxation.hpp"

#include <algorithm>

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

/// Returns the open goals that a proof blames, in the order of their arrival.
std::vector<GoalKey> blamed_goals(const PlanReply& reply, const GoalSet& goals) {
  std::vector<GoalKey> out;
  if (reply.verdict != Verdict::unsolvable) return out;
  for (const GoalRecord* record : goals.open()) {
    const GoalKey& key = record->request.key;
    if (std::ranges::find(reply.blocking, key, &BlockingGoal::key) != reply.blocking.end())
      out.push_back(key);
  }
  return out;
}

bool keeps_reserves(const MissionModel& mission) {
  return std::any_of(mission.fluents.begin(), mission.fluents.end(),
                     [](const FluentSource& source) { return source.last.has_value(); });
}

std::string with_details(const std::string& reason, const PlanReply& reply) {
  return reply.reason.empty() ? reason : reason + "\ndetails: " + reply.reason;
}

std::string names_of_others(const GoalSet& goals, const GoalKey& key) {
  constexpr std::size_t kNamed = 6;
  std::string out;
  std::size_t count = 0;
  for (const GoalRecord* record : goals.open()) {
    if (record->request.key == key || ++count > kNamed) continue;
    out += (out.empty() ? "" : ", ") + record->request.key.id;
  }
  return count > kNamed ? out + " and " + std::to_string(count - kNamed) + " more" : out;
}

std::vector<RelaxationStep::Leaving> leaving(const PlanReply& reply, const GoalSet& goals,
                                             const std::vector<GoalKey>& keys) {
  std::vector<RelaxationStep::Leaving> out;
  for (const GoalKey& key : keys) out.push_back({key, reason_to_leave(reply, goals, key)});
  return out;
}

}  // namespace

// Says nothing of whether a goal would fit alone that no proof blames, since nobody knows.
std::string reason_to_leave(const PlanReply& reply, const GoalSet& goals, const GoalKey& key) {
  if (reply.verdict != Verdict::unsolvable)
    return std::string(to_string(reply.verdict)) + (reply.reason.empty() ? "" : ": " + reply.reason);
  const auto blamed = std::ranges::find(reply.blocking, key, &BlockingGoal::key);
  if (blamed != reply.blocking.end())
    return with_details("out of reach: " + (blamed->reason.empty() ? blamed->timeline : blamed->reason),
                        reply);
  const std::string others = names_of_others(goals, key);
  return with_details(others.empty() ? "no plan achieves it" : "no plan achieves it together with " + others,
                      reply);
}

RelaxationStep relax(const PlanReply& reply, const GoalSet& goals, const MissionModel& mission,
                     const Relaxation& relaxed) {
  using Kind = RelaxationStep::Kind;
  if (const auto soft = soft_goal_to_give_up(reply, goals, relaxed))
    return {Kind::give_up_soft, leaving(reply, goals, {*soft}), ""};
  const std::vector<GoalKey> blamed = blamed_goals(reply, goals);
  if (!blamed.empty() && relaxed.soft_goals_left_out.empty() && goals.drop_candidate())
    return {Kind::leave_out_soft, {}, with_details("no plan has the hard goals beside it", reply)};
  const auto hard = blamed.empty() ? std::vector{newest_hard(goals)} : blamed;
  const bool spend = keeps_reserves(mission) && relaxed.reserves == problem::Reserves::kept;
  return {spend ? Kind::spend_reserves : Kind::give_up_hard, leaving(reply, goals, hard), ""};
}

std::optional<GoalKey> soft_goal_to_give_up(const PlanReply& reply, const GoalSet& goals,
                                            const Relaxation& relaxed) {
  const std::vector<GoalKey> blamed = blamed_goals(reply, goals);
  const bool of_hard_alone = reply.verdict == Verdict::unsolvable && !relaxed.soft_goals_left_out.empty();
  return blamed.empty() && !of_hard_alone ? goals.drop_candidate() : goals.drop_candidate(blamed);
}

std::vector<GoalKey> hard_goals_at_stake(const PlanReply& reply, const GoalSet& goals) {
  std::vector<GoalKey> out = blamed_goals(reply, goals);
  if (!out.empty()) return out;
  for (const GoalRecord* record : goals.open())
    if (record->request.importance == GoalClass::hard) out.push_back(record->request.key);
  return out;
}

std::optional<GoalKey> next_suspect(const GoalSet& goals, const std::optional<GoalKey>& suspect) {
  const auto open = goals.open();
  if (open.size() < 2) return std::nullopt;
  bool passed = !suspect;
  for (auto record = open.rbegin(); record != open.rend(); ++record) {
    if (passed) return (*record)->request.key;
    passed = (*record)->request.key == *suspect;
  }
  return std::nullopt;
}

GoalSet without(const GoalSet& goals, const GoalKey& key) {
  GoalSet out = goals;
  out.set_state(key, GoalState::dropped, "");
  return out;
}

GoalSet hard_goals(const GoalSet& goals) {
  GoalSet out = goals;
  for (const GoalRecord* record : goals.open())
    if (record->request.importance != GoalClass::hard)
      out.set_state(record->request.key, GoalState::dropped, "");
  return out;
}

}  // namespace roci::exec::reactor
