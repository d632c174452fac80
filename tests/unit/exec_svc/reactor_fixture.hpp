// A reactor with a stand-in planner that answers its calls and a stand-in robot that answers its commands.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "exec_svc/reactor/reactor.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::exec::testing {

using temporal::seconds;
using temporal::state;
using temporal::Time;

// One image per planned goal: enough for the reactor, which knows nothing of planning.
inline temporal::FlexiblePlan images(const std::vector<std::string>& ids) {
  temporal::FlexiblePlan plan;
  for (const std::string& id : ids) {
    temporal::PlanActivity activity;
    activity.id = "a" + id;
    activity.name = "take-image";
    activity.arguments = {{"1", "image-" + id}, {"2", "place-" + id}};
    activity.goals_served = {"ground/" + id};
    activity.start_point = plan.point_count++;
    activity.end_point = plan.point_count++;
    activity.duration_lower = activity.duration_upper = seconds(40);
    if (!plan.activities.empty()) {
      plan.constraints.push_back({plan.activities.back().end_point, activity.start_point,
                                  temporal::ConstraintKind::ordering, seconds(0.001), temporal::no_bound});
    }
    plan.activities.push_back(std::move(activity));
  }
  return plan;
}

inline bool is_empty(const reactor::ReactorInputs& inputs) {
  return inputs.goals.empty() && inputs.observations.empty() && inputs.acks.empty() &&
         inputs.losses.empty() && inputs.arrivals.empty() && inputs.models.empty() && !inputs.reply &&
         inputs.deltas.empty() && inputs.answers.empty() && inputs.ground_orders.empty();
}

inline bool asks_for(const reactor::PlanRequest& call, const std::string& goal) {
  return std::ranges::any_of(call.problem.goals,
                             [&](const problem::ProblemGoal& one) { return one.key.id == goal; });
}

class ReactorTest : public ::testing::Test {
 protected:
  // The answer to a planner call; by default a plan with an image of every goal in the problem.
  using Planner = std::function<reactor::PlanReply(const reactor::PlanRequest&)>;
  using Events = std::multimap<Time, std::function<void()>>;

  // With these inputs now; the clock then stands at `until_s`.
  void run(double until_s, reactor::ReactorInputs inputs) {
    pending = std::move(inputs);
    for (int turns = 0; turns < 10000; ++turns) {
      const reactor::ReactorInputs now_inputs = std::exchange(pending, {});
      const reactor::ReactorOutputs out = reactor.step(now, now_inputs);
      take(out);
      if (!is_empty(pending)) continue;
      Time next = seconds(until_s);
      if (out.wake && *out.wake > now) next = std::min(next, *out.wake);
      for (const Events* events : {&robot_events, &other_events})
        if (!events->empty()) next = std::min(next, events->begin()->first);
      if (out.wake && *out.wake <= now) continue;
      if (next >= seconds(until_s)) break;
      now = next;
      for (Events* events : {&robot_events, &other_events}) {
        while (!events->empty() && events->begin()->first <= now) {
          const auto event = events->extract(events->begin());
          event.mapped()();
        }
      }
    }
    now = seconds(until_s);
  }

  void take(const reactor::ReactorOutputs& out) {
    for (const reactor::Event& event : out.events) trace.push_back(event.code);
    for (const goals::GoalRecord& goal : out.goal_changes) reasons[goal.request.key.id] = goal.reason;
    if (out.cancelled_call) {
      trace.push_back("cancel call");
      if (planner_hears_cancels) {
        EXPECT_TRUE(std::exchange(planner_is_busy, false)) << "nothing to cancel";
        other_events.erase(planned);
        pending.reply = reply(temporal::Verdict::cancelled);
        pending.reply->call = *out.cancelled_call;
      }
    }
    if (out.call) {
      trace.push_back("call");
      EXPECT_FALSE(std::exchange(planner_is_busy, true)) << "two planner calls at a time";
      planned = other_events.emplace(now + planning_time, [this, call = *out.call] {
        planner_is_busy = false;
        pending.reply = planner(call);
        pending.reply->call = call.id;
      });
    }
    for (const reactor::DecisionRecord& decision : out.decisions)
      decisions.push_back({temporal::to_seconds(now), decision});
    for (const reactor::AnswerReceipt& receipt : out.answer_receipts) receipts.push_back(receipt);
    for (const orders::OrderStatus& order : out.order_statuses) order_stages.push_back(order);
    for (const executive::Command& command : out.commands) obey(command);
  }

  virtual void obey(const executive::Command& command) {
    commands.push_back(command);
    if (robot_is_dead) return;
    if (command.action == executive::CommandAction::cancel) {
      trace.push_back("cancel");
      robot_events.clear();
      pending.acks.push_back({command.activity, command.attempt, executive::CommandStage::cancelled, "", ""});
      pending.observations.push_back({"rover.camera", state("idle")});
      return;
    }
    trace.push_back(command.command_name);
    pending.acks.push_back({command.activity, command.attempt, executive::CommandStage::accepted, "", ""});
    if (command.command_name != "image") return;
    pending.observations.push_back({"rover.camera", state("imaging")});
    const std::string image = command.arguments.front().value;
    robot_events.emplace(now + camera_time, [this, command, image] {
      pending.observations.push_back({"rover.camera", state("idle")});
      if (camera_works) pending.observations.push_back({"rover.image." + image, state("sent")});
      const auto stage = camera_works ? executive::CommandStage::completed : executive::CommandStage::failed;
      pending.acks.push_back({command.activity, command.attempt, stage, "", "shutter"});
    });
  }

  reactor::ReactorInputs robot_and(std::vector<goals::GoalRequest> goals) {
    reactor::ReactorInputs inputs;
    inputs.observations = standing_robot();
    inputs.goals = std::move(goals);
    return inputs;
  }

  static reactor::PlanReply reply(temporal::Verdict verdict, std::string reason = "") {
    reactor::PlanReply out;
    out.verdict = verdict;
    out.reason = std::move(reason);
    return out;
  }

  // A proof that these goals of the ground are out of reach.
  static reactor::PlanReply blocked(const std::vector<std::string>& ids) {
    reactor::PlanReply out = reply(temporal::Verdict::unsolvable, "never reached:");
    for (const std::string& id : ids) {
      out.reason += " (sent image-" + id + ")";
      out.blocking.push_back({{"ground", id}, "(sent image-" + id + ")", "never reached"});
    }
    return out;
  }

  reactor::PlanReply image_every_goal(const reactor::PlanRequest& call) {
    reactor::PlanReply out = reply(temporal::Verdict::solved);
    std::vector<std::string> ids;
    for (const goals::GoalRecord* goal : reactor.goals().open()) ids.push_back(goal->request.key.id);
    EXPECT_THAT(call.problem.text, ::testing::HasSubstr("(:goal"));
    out.plan = images(ids);
    return out;
  }

  mission::MissionModel mission = planetary();
  reactor::Reactor reactor{mission};
  Time now{0};
  Time planning_time{0};
  Time camera_time = seconds(40);
  bool camera_works = true;
  temporal::Value battery = 900000.0;
  Planner planner = [this](const reactor::PlanRequest& call) { return image_every_goal(call); };
  reactor::ReactorInputs pending;
  Events robot_events;  // a cancel clears them
  Events other_events;
  bool planner_is_busy = false;
  bool planner_hears_cancels = true;
  Events::iterator planned;    // of the call under way
  bool robot_is_dead = false;  // hears no command
  std::vector<executive::Command> commands;
  std::vector<std::string> trace;
  std::map<std::string, std::string> reasons;
  std::vector<std::pair<double, reactor::DecisionRecord>> decisions;  // as they changed, with their times
  std::vector<reactor::AnswerReceipt> receipts;
  std::vector<orders::OrderStatus> order_stages;  // each stage as it came
};

}  // namespace roci::exec::testing
