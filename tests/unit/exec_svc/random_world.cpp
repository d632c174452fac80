#include "tests/unit/exec_svc/random_world.hpp"

#include <algorithm>

namespace roci::exec::testing {

using executive::Command;
using executive::CommandAction;
using executive::CommandStage;
using executive::Observation;
using executive::StartPolicy;
using executive::StepStatus;
using goals::GoalClass;
using goals::GoalRecord;
using goals::GoalRequest;
using goals::GoalState;
using mission::ActionBinding;
using mission::MissionModel;
using mission::RecoveryStrategy;
using mission::Replanning;
using reactor::Event;
using reactor::MissionPhase;
using reactor::PlanReply;
using reactor::PlanRequest;
using reactor::ReactorInputs;
using reactor::ReactorOutputs;
using temporal::Verdict;

using temporal::seconds;
using temporal::state;
using temporal::Time;

namespace {

MissionModel random_mission(std::mt19937_64& random) {
  static const MissionModel planetary_once = planetary();
  MissionModel mission = planetary_once;
  mission.executive.recovery = static_cast<RecoveryStrategy>(random() % 8 < 5 ? 0 : random() % 5);
  mission.executive.replan_limit = 30;
  mission.executive.start = random() % 8 == 0 ? StartPolicy::latest : StartPolicy::earliest;
  if (random() % 2 == 0) mission.executive.replanning = Replanning::background;
  ActionBinding& image = mission.actions["take-image"];
  image.retries = static_cast<std::uint32_t>(random() % 3);
  image.lateness = static_cast<temporal::LatenessPolicy>(random() % 3);
  image.wait_timeout = seconds(120);
  mission.contingencies["restart"] = {
      "restart",
      {{"sim_svc", "camera", "restart", {}}, {"sim_svc", "camera", "stop", {}}},
      random() % 2 == 0,
      static_cast<std::uint32_t>(1 + random() % 2),
      seconds(60)};
  if (random() % 2 == 0) image.contingency = "restart";
  return mission;
}

}  // namespace

RandomWorld::RandomWorld(std::uint64_t seed)
    : random_(seed), mission_(random_mission(random_)), reactor_(mission_) {
  pending_.observations = standing_robot();
}

Time RandomWorld::time_up_to(std::int64_t most) {
  return Time{static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(most * 1'000'000))};
}

void RandomWorld::run() {
  send_goal();
  for (int rule = 0; rule < 40 && !::testing::Test::HasFatalFailure(); ++rule) {
    fire_rule();
    let_pass(now_ + time_up_to(60));
  }
  wild_ = false;
  dead_ = false;
  pending_.arrivals = {"sim_svc", "planner_svc"};
  for (const Observation& observation : standing_robot()) pending_.observations.push_back(observation);
  let_pass(now_ + seconds(20'000));
  for (const GoalRecord* goal : reactor_.goals().open()) {
    EXPECT_EQ(reactor_.phase(), MissionPhase::safe) << goal->request.key.text() << " is open in a calm world";
    pending_.goals.push_back(goal->request);
    pending_.goals.back().recalled = true;
  }
  let_pass(now_ + seconds(1000));
  EXPECT_TRUE(reactor_.goals().open().empty());
}

void RandomWorld::fire_rule() {
  switch (random_() % 9) {
    case 0:
    case 1:
      ++events["rule: goal"];
      return send_goal();
    case 2:
      ++events["rule: owner dies or comes back"];
      dead_ = !dead_;
      jobs_.clear();
      if (dead_) pending_.losses = {{"sim_svc", "killed"}};
      if (!dead_) pending_.arrivals = {"sim_svc"};
      return;
    case 3:
      ++events["rule: contradictory observation"];
      return observe("rover.camera", one_in(2) ? state("imaging") : state("idle"));
    case 4:
      ++events["rule: nonsense"];
      return observe(one_in(2) ? "rover.nav" : "rover.battery",
                     one_in(2) ? state("tumbling") : temporal::Value{-1.0});
    case 5:
      ++events["rule: the robot stands as at first"];
      for (const Observation& observation : standing_robot()) pending_.observations.push_back(observation);
      return;
    case 6:
      ++events["rule: clock jumps"];
      now_ = one_in(2) ? now_ + time_up_to(2000) : std::max(Time{0}, now_ - time_up_to(20));
      return;
    case 7:
      ++events["rule: model changes"];
      pending_.models.push_back({"pathplan_svc", random_() % 5});
      return;
    default:
      ++events["rule: stray words"];
      pending_.acks.push_back({one_in(2) ? "p1.1-take-image" : "nobody",
                               static_cast<std::uint32_t>(random_() % 3),
                               static_cast<CommandStage>(random_() % 7), "", "stray"});
  }
}

void RandomWorld::send_goal() {
  GoalRequest goal = photo("g" + std::to_string(random_() % 8), static_cast<GoalClass>(random_() % 3),
                           static_cast<double>(random_() % 5));
  if (one_in(6)) goal.arguments["x"] = one_in(2) ? "far" : "120";
  if (one_in(6)) goal.recalled = true;
  if (one_in(4)) goal.closes = now_ + time_up_to(500);
  pending_.goals.push_back(goal);
}

void RandomWorld::let_pass(Time until) {
  while (!::testing::Test::HasFatalFailure()) {
    step();
    if (::testing::Test::HasFatalFailure()) return;
    const bool more = !pending_.acks.empty() || !pending_.observations.empty();
    if (more) continue;
    Time next = wake_.value_or(temporal::no_bound);
    for (const auto& [activity, job] : jobs_) next = std::min(next, job.ends);
    if (!answers_.empty()) next = std::min(next, answers_.begin()->first);
    if (next > until) break;
    if (next > now_) steps_at_this_time_ = 0;
    now_ = std::max(now_, next);
    std::vector<std::string> ended;
    for (const auto& [activity, job] : jobs_)
      if (job.ends <= now_) ended.push_back(activity);
    for (const std::string& activity : ended) end_job(activity);
    if (!answers_.empty() && answers_.begin()->first <= now_)
      pending_.reply = std::move(answers_.extract(answers_.begin()).mapped());
  }
  now_ = std::max(now_, until);
  steps_at_this_time_ = 0;
}

void RandomWorld::step() {
  ASSERT_LT(++steps_at_this_time_, 200) << "it does not come to rest";
  if (pending_.reply) --outstanding_calls_;
  const ReactorInputs inputs = std::exchange(pending_, {});
  for (const GoalRequest& goal : inputs.goals) final_.erase(goal.key);  // what is asked again may begin again
  const ReactorOutputs out = reactor_.step(now_, inputs);
  check(out);
  take(out);
}

void RandomWorld::take(const ReactorOutputs& out) {
  wake_ = out.wake;
  for (const Event& event : out.events) ++events[event.code];
  if (out.call) {
    ++outstanding_calls_;
    answers_.emplace(now_ + time_up_to(wild_ ? 100 : 5), answer_of(*out.call));
  }
  for (const Command& command : out.commands)
    if (!dead_) obey(command);
}

PlanReply RandomWorld::answer_of(const PlanRequest& call) {
  PlanReply reply;
  reply.call = call.id;
  reply.verdict = Verdict::solved;
  if (wild_ && one_in(4)) reply.verdict = static_cast<Verdict>(random_() % 10);
  if (reply.verdict != Verdict::solved) return reply;
  for (const GoalRecord* goal : reactor_.goals().open()) {
    temporal::PlanActivity activity;
    activity.id = "a" + goal->request.key.id;
    activity.name = wild_ && one_in(60) ? "dance" : "take-image";
    activity.arguments = {{"1", "image-" + goal->request.key.id}, {"2", "place-" + goal->request.key.id}};
    activity.goals_served = {goal->request.key.text()};
    activity.start_point = reply.plan.point_count++;
    activity.end_point = reply.plan.point_count++;
    activity.duration_lower = activity.duration_upper = seconds(40);
    if (one_in(3)) activity.pre = temporal::compare("(camera-idle)", temporal::ConditionOp::eq, true);
    activity.impacts = {
        {"(camera-idle)", temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, !wild_ || !one_in(10)},
        {"(battery)", temporal::ImpactKind::delta, temporal::ImpactWhen::at_start, -600.0}};
    if (!reply.plan.activities.empty()) {
      reply.plan.constraints.push_back({reply.plan.activities.back().end_point, activity.start_point,
                                        temporal::ConstraintKind::ordering, seconds(0.001),
                                        temporal::no_bound});
    }
    reply.plan.activities.push_back(std::move(activity));
  }
  if (one_in(3) && !reply.plan.activities.empty()) {
    const double latest =
        45.0 * static_cast<double>(reply.plan.activities.size()) + (wild_ && one_in(3) ? -20 : 60);
    reply.plan.constraints.push_back({temporal::origin_point, reply.plan.activities.back().start_point,
                                      temporal::ConstraintKind::window, seconds(0), seconds(latest)});
  }
  return reply;
}

void RandomWorld::obey(const Command& command) {
  if (command.action == CommandAction::execute) return execute(command);
  const bool known = jobs_.contains(command.activity);
  if (command.action == CommandAction::query)
    return acknowledge(command, known ? CommandStage::accepted : CommandStage::unknown);
  if (wild_ && one_in(12)) return;  // not heard
  if (wild_ && known && one_in(12)) return acknowledge(command, CommandStage::cancel_failed);
  jobs_.erase(command.activity);
  observe("rover.camera", state("idle"));
  acknowledge(command, known ? CommandStage::cancelled : CommandStage::unknown);
}

void RandomWorld::execute(const Command& command) {
  if (wild_ && one_in(20)) return;  // not heard
  if (wild_ && one_in(20)) return acknowledge(command, CommandStage::rejected);
  acknowledge(command, CommandStage::accepted);
  if (command.command_name == "stop") {
    std::erase_if(jobs_, [&](const auto& job) { return job.second.command.subsystem == command.subsystem; });
    if (command.subsystem == "nav") observe("rover.nav", state("idle-at", {"here"}));
    if (command.subsystem == "camera") observe("rover.camera", state("idle"));
    return acknowledge(command, CommandStage::completed);
  }
  if (command.command_name != "image") return acknowledge(command, CommandStage::completed);
  observe("rover.camera", state("imaging"));
  jobs_[command.activity] = {command, now_ + (wild_ && one_in(6) ? time_up_to(400) : seconds(40))};
}

void RandomWorld::end_job(const std::string& activity) {
  const Job job = jobs_.extract(activity).mapped();
  const bool works = !wild_ || !one_in(5);
  observe("rover.camera", state("idle"));
  if (works && !job.command.arguments.empty())
    observe("rover.image." + job.command.arguments.front().value, state("sent"));
  acknowledge(job.command, works ? CommandStage::completed : CommandStage::failed);
}

void RandomWorld::acknowledge(const Command& command, CommandStage stage) {
  pending_.acks.push_back({command.activity, command.attempt, stage, "", ""});
  if (wild_ && one_in(15)) pending_.acks.push_back(pending_.acks.back());  // told twice
}

void RandomWorld::observe(const std::string& timeline, temporal::Value value) {
  if (!wild_ || !one_in(15)) pending_.observations.push_back({timeline, std::move(value)});
}

void RandomWorld::check(const ReactorOutputs& out) {
  ASSERT_LE(outstanding_calls_ + (out.call ? 1 : 0), 1) << "two planner calls at a time";
  const std::string live = "p" + std::to_string(reactor_.plan_version()) + ".";
  for (const Command& command : out.commands) {
    if (command.action != CommandAction::execute) continue;
    ASSERT_TRUE(executed_.emplace(command.activity, command.attempt).second)
        << command.activity << " was commanded twice under one key";
    if (command.activity.starts_with("fallback.")) continue;
    ASSERT_EQ(reactor_.phase() == MissionPhase::executing || reactor_.phase() == MissionPhase::pausing ||
                  reactor_.phase() == MissionPhase::idle,
              true)
        << command.activity << " commanded while " << to_string(reactor_.phase());
    ASSERT_TRUE(command.activity.starts_with(live)) << command.activity << " without a live plan";
  }
  for (const StepStatus& step : out.steps) {
    if (step.state == temporal::ActivityState::failed || step.state == temporal::ActivityState::skipped) {
      ASSERT_FALSE(step.reason.empty()) << step.activity << " ended without a cause";
    }
  }
  for (const GoalRecord* goal : reactor_.goals().all()) {
    const bool hard = goal->request.importance == GoalClass::hard;
    ASSERT_FALSE(hard && goal->state == GoalState::dropped) << "a hard goal was dropped";
    const auto known = final_.find(goal->request.key);
    if (known != final_.end()) {
      ASSERT_EQ(known->second, goal->state) << "a final state was left";
    }
    if (is_final(goal->state)) {
      ASSERT_TRUE(goal->state == GoalState::achieved || !goal->reason.empty())
          << "a goal ended without a reason";
      final_[goal->request.key] = goal->state;
    }
  }
  if (reactor_.phase() == MissionPhase::executing) check_steps();
}

/// The steps of one component never overlap in time.
void RandomWorld::check_steps() {
  std::map<std::string, std::vector<std::pair<Time, Time>>> spans;
  const std::vector<StepStatus> steps = reactor_.steps();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!steps[i].started) continue;
    spans[reactor_.plan().activities[i].subsystem].emplace_back(*steps[i].started,
                                                                steps[i].ended.value_or(temporal::no_bound));
  }
  for (auto& [component, of_it] : spans) {
    std::sort(of_it.begin(), of_it.end());
    for (std::size_t i = 1; i < of_it.size(); ++i)
      ASSERT_LE(of_it[i - 1].second, of_it[i].first) << "two steps of " << component << " at a time";
  }
}

}  // namespace roci::exec::testing
