#include "exec_svc/output_publisher_service.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "exec_svc/mission/observed_names.hpp"
#include "exec_svc/wire_service.hpp"
#include "services/owner/command.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::exec {

using executive::Command;
using executive::StepStatus;
using goals::GoalRecord;
using journal::CrashPoints;
using mission::Component;
using mission::MissionModel;
using reactor::Event;
using reactor::PlannedAction;
using reactor::Reactor;
using reactor::ReactorOutputs;

namespace {

namespace topics = services::topics;

namespace owner = services::owner;

// Names the command that tells owners a leader's epoch; no activity has this key.
constexpr char kEpochKey[] = "epoch";

constexpr std::size_t kToldExecuted = 8;
constexpr std::size_t kSentKeys = 256;    // more are never awaited at a time
constexpr std::uint64_t kMostSteps = 64;  // of a climb

}  // namespace

OutputPublisher::OutputPublisher(services::Node& node, const MissionModel& mission, std::uint64_t epoch,
                                 CrashPoints& crash)
    : mission_(&mission),
      executive_(node.options().name),
      epoch_(epoch),
      crash_(&crash),
      commands_(services::advertise(node, topics::command)),
      goal_statuses_(services::advertise(node, topics::goal_status)),
      plans_(services::advertise(node, topics::plan)),
      executed_(services::advertise(node, topics::executed_plan)),
      steps_(services::advertise(node, topics::step_status)),
      missions_(services::advertise(node, topics::mission_status)),
      events_(services::advertise(node, topics::event)) {}

void OutputPublisher::send_goals(const Reactor& reactor) const {
  for (const GoalRecord* goal : reactor.goals().all()) tell(*goal);
}

// A late joiner gets all goals that are open, and of those that have ended the newest ones.
bool OutputPublisher::tell(const GoalRecord& goal) const {
  const v1::GoalStatus status = to_wire(goal, executive_, ack_stage_);
  const bool written = goal_statuses_.write(status);
  if (goals::is_final(goal.state)) goal_statuses_.dispose(status);
  return written;
}

void OutputPublisher::send_plan(const Reactor& reactor) {
  if (reactor.plan().version != 0) plans_.write(plan_sample(reactor.plan(), reactor.planned_actions()));
  if (const auto& executed = reactor.last_executed()) executed_.write(to_wire(*executed, executive_));
  for (const StepStatus& step : reactor.steps()) {
    steps_.write(to_wire(step, executive_, reactor.plan_version()));
    told_steps_.insert(step.activity);
  }
}

void OutputPublisher::send(const ReactorOutputs& out, std::uint32_t version,
                           const std::vector<PlannedAction>& actions) {
  withdraw_what_is_cancelled(out.commands);
  for (const GoalRecord& goal : out.goal_changes) sent(tell(goal));
  if (out.adopted) sent(plans_.write(plan_sample(*out.adopted, actions)));
  for (const Command& command : out.commands) {
    v1::Command sample = to_wire(command, executive_, version, epoch_);
    sent_keys_.emplace_back(sample.epoch(), sample.activity(), sample.attempt());
    if (sent_keys_.size() > kSentKeys) sent_keys_.pop_front();
    send(std::move(sample));
  }
  for (const StepStatus& step : out.steps) {
    sent(steps_.write(to_wire(step, executive_, version)));
    told_steps_.insert(step.activity);
  }
  if (out.adopted)
    end_steps_outside(*out.adopted);
  else if (out.executed)
    end_steps_outside({});
  if (out.executed) tell(*out.executed);
  for (const Event& event : out.events) report(event);
}

// Ends the statuses of steps that have left the plan. Until then they count, since an engine that is started
// meanwhile goes on from them.
void OutputPublisher::end_steps_outside(const temporal::FlexiblePlan& plan) {
  std::set<std::string> gone = std::move(told_steps_);
  told_steps_.clear();
  for (const temporal::PlanActivity& activity : plan.activities)
    if (gone.erase(activity.id) > 0) told_steps_.insert(activity.id);
  for (const std::string& activity : gone) {
    v1::StepStatus name;
    name.executive(executive_);
    name.activity(activity);
    steps_.dispose(name);
  }
}

// Before anything is told of why, and before the leases may let the rest go: else a command would begin whose recall
// was acknowledged already.
void OutputPublisher::withdraw_what_is_cancelled(const std::vector<Command>& commands) {
  for (const Command& cancel : commands) {
    if (cancel.action != executive::CommandAction::cancel) continue;
    std::erase_if(waiting_, [&](const v1::Command& one) {
      return one.activity() == cancel.activity && one.attempt() == cancel.attempt &&
             one.epoch() == (cancel.epoch != 0 ? cancel.epoch : epoch_);
    });
  }
}

void OutputPublisher::send(v1::Command command) {
  send_waiting();
  const bool safety =
      command.command_name() == owner::kStopCommand || command.activity().starts_with(owner::kFallbackPrefix);
  const auto same_key = [&](const v1::Command& other) {
    return other.epoch() == command.epoch() && other.activity() == command.activity() &&
           other.attempt() == command.attempt();
  };
  const bool begins = command.action() == v1::COMMAND_EXECUTE && !safety;
  if (!begins || !may_command_ || may_command_()) {
    sent(commands_.write(std::move(command)));
  } else if (std::ranges::none_of(waiting_, same_key)) {
    waiting_.push_back(std::move(command));
  }
}

void OutputPublisher::send_waiting() {
  while (!waiting_.empty() && may_command_()) {
    commands_.write(std::move(waiting_.front()));
    waiting_.pop_front();
  }
}

// Publishes the plan, and disposes the oldest, so that a late joiner gets the newest few.
void OutputPublisher::tell(const reactor::ExecutedPlan& executed) {
  v1::ExecutedPlan sample = to_wire(executed, executive_);
  v1::ExecutedPlan name;
  name.executive(executive_);
  name.version(executed.version);
  sent(executed_.write(std::move(sample)));
  told_executed_.push_back(std::move(name));
  if (told_executed_.size() <= kToldExecuted) return;
  executed_.dispose(told_executed_.front());
  told_executed_.pop_front();
}

void OutputPublisher::lose_owner(const std::string& owner) {
  std::erase_if(waiting_, [&](const v1::Command& command) { return command.owner() == owner; });
}

// Makes the sample of a plan, with the arguments of each action beside those of its commands.
v1::Plan OutputPublisher::plan_sample(const temporal::FlexiblePlan& plan,
                                      const std::vector<PlannedAction>& actions) const {
  v1::Plan out = services::wire::to_wire(mission::with_observed_names(plan, *mission_));
  std::map<std::string, const PlannedAction*> by_activity;
  for (const PlannedAction& action : actions) by_activity[action.activity] = &action;
  for (v1::PlanActivity& activity : out.activities()) {
    const auto planned = by_activity.find(activity.id());
    if (planned == by_activity.end() || activity.commands().empty()) continue;
    activity.arguments().clear();
    for (const std::string& object : planned->second->arguments)
      activity.arguments().push_back(services::wire::to_wire(
          temporal::Property{std::to_string(activity.arguments().size() + 1), object}));
  }
  out.executive(executive_);
  return out;
}

void OutputPublisher::report(const Event& event) const { events_.write(to_wire(event)); }

bool OutputPublisher::publish(v1::MissionStatus status, const std::string& trace_sha256) {
  if (status == last_status_) return false;
  last_status_ = status;
  status.executive(executive_);
  status.trace_sha256(trace_sha256);
  missions_.write(std::move(status));
  return true;
}

void OutputPublisher::announce_epoch() {
  if (commands_.matched_readers() == 0) return;
  for (const Component& component : mission_->components)
    if (told_epoch_.insert(component.owner).second) lead(component.owner, epoch_);
}

bool OutputPublisher::climb(const std::string& service, std::uint64_t held) {
  if (held >= epoch_ || (epoch_ - held) / owner::kEpochJump > kMostSteps) return false;
  for (std::uint64_t epoch = held + owner::kEpochJump; epoch < epoch_; epoch += owner::kEpochJump)
    lead(service, epoch);
  return true;
}

void OutputPublisher::lead(const std::string& service, std::uint64_t epoch) const {
  Command command;
  command.activity = kEpochKey;
  command.owner = service;
  command.command_name = owner::kLeadCommand;
  commands_.write(to_wire(command, executive_, 0, epoch));
}

bool OutputPublisher::answers_command(const v1::CommandAck& ack) const {
  return std::ranges::find(sent_keys_, std::tuple(ack.epoch(), ack.activity(), ack.attempt())) !=
         sent_keys_.end();
}

bool OutputPublisher::answers_epoch(const v1::CommandAck& ack) { return ack.activity() == kEpochKey; }

}  // namespace roci::exec
