#include "exec_svc/reactor/goal_relaxation.hpp"

#include <algorithm>

#include "exec_svc/reactor/goal_words.hpp"

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

GoalKey first_hard_to_leave(const GoalSet& goals) {
  const GoalRecord* out = nullptr;
  for (const GoalRecord* record : goals.open()) {
    if (record->request.importance == GoalClass::hard && (out == nullptr || leaves_first(*record, *out)))
      out = record;
  }
  return out == nullptr ? GoalKey{} : out->request.key;
}

/// Open goals that the planner blames, in the order of their arrival: by a proof, or for want of values that the owners
/// of functions did not find.
std::vector<GoalKey> blamed_goals(const PlanReply& reply, const GoalSet& goals) {
  std::vector<GoalKey> out;
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

std::string names_of(const std::vector<const GoalRecord*>& goals) {
  constexpr std::size_t kNamed = 7;
  std::string out;
  for (std::size_t i = 0; i < std::min(goals.size(), kNamed); ++i)
    out += (i == 0 ? "" : ", ") + goals[i]->request.key.id;
  return goals.size() > kNamed ? out + " and " + std::to_string(goals.size() - kNamed) + " more" : out;
}

// Why a goal leaves first of those that nothing blames.
std::string rank_of(const GoalSet& goals, const GoalKey& key) {
  const goals::GoalRequest& goal = goals.find(key)->request;
  if (goal.importance == GoalClass::optional) return "the optional goal of the lowest utility";
  const bool by_priority = std::ranges::any_of(goals.open(), [&](const GoalRecord* other) {
    return other->request.importance == goal.importance && other->request.priority != goal.priority;
  });
  return std::string("the newest ") + (goal.importance == GoalClass::hard ? "hard" : "opportunistic") +
         " goal" + (by_priority ? " of the lowest priority" : "");
}

// The goals that the planner was asked for.
GoalSet goals_of_call(const GoalSet& goals, const Relaxation& relaxed) {
  return relaxed.soft_goals_left_out.empty() ? goals : hard_goals(goals);
}

// The reason, with `besides` at the end of what is said in the words of the mission where a proof blames no goal and
// speaks of several.
std::string reason_with(const PlanReply& reply, const GoalSet& asked, const MissionModel& mission,
                        const GoalKey& key, const std::string& besides) {
  const goals::GoalRequest& goal = asked.find(key)->request;
  const auto blamed = std::ranges::find(reply.blocking, key, &BlockingGoal::key);
  if (blamed != reply.blocking.end())
    return with_details(words_of_blamed(reply, *blamed, goal, mission), reply);
  std::vector<const GoalRecord*> goals = asked.open();
  if (reply.verdict != Verdict::unsolvable) {
    std::erase_if(goals, [&](const GoalRecord* record) { return record->request.key == key; });
    return words_of_spent_budget(reply, goal, names_of(goals), mission) +
           "\ndetails: " + to_string(reply.verdict) + (reply.reason.empty() ? "" : ": " + reply.reason);
  }
  if (goals.size() < 2) return with_details("no plan achieves it", reply);
  return with_details("no plan achieves all of " + names_of(goals) + besides, reply);
}

std::vector<RelaxationStep::Leaving> leaving(const PlanReply& reply, const GoalSet& asked,
                                             const MissionModel& mission, const std::vector<GoalKey>& keys) {
  std::vector<RelaxationStep::Leaving> out;
  for (const GoalKey& key : keys)
    out.push_back(
        {key, reason_with(reply, asked, mission, key, "; this one leaves first, as " + rank_of(asked, key))});
  return out;
}

}  // namespace

std::string reason_to_leave(const PlanReply& reply, const GoalSet& goals, const MissionModel& mission,
                            const GoalKey& key, const Relaxation& relaxed) {
  return reason_with(reply, goals_of_call(goals, relaxed), mission, key, "");
}

RelaxationStep relax(const PlanReply& reply, const GoalSet& goals, const MissionModel& mission,
                     const Relaxation& relaxed) {
  using Kind = RelaxationStep::Kind;
  const GoalSet asked = goals_of_call(goals, relaxed);
  if (const auto soft = soft_goal_to_give_up(reply, goals, relaxed))
    return {Kind::give_up_soft, leaving(reply, asked, mission, {*soft}), ""};
  const std::vector<GoalKey> blamed = blamed_goals(reply, goals);
  if (!blamed.empty() && relaxed.soft_goals_left_out.empty() && goals.drop_candidate())
    return {Kind::leave_out_soft, {}, with_details("no plan has the hard goals beside it", reply)};
  const auto hard = blamed.empty() ? std::vector{first_hard_to_leave(goals)} : blamed;
  const bool spend = keeps_reserves(mission) && relaxed.reserves == problem::Reserves::kept;
  return {spend ? Kind::spend_reserves : Kind::give_up_hard, leaving(reply, asked, mission, hard), ""};
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
