#include "exec_svc/wire_service.hpp"

#include <algorithm>
#include <string_view>

#include "services/owner/command.hpp"
#include "services/owner/command_wire.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::exec {

using executive::Command;
using executive::CommandAck;
using executive::CommandStage;
using executive::Observation;
using executive::StepStatus;
using goals::GoalClass;
using goals::GoalRecord;
using goals::GoalRequest;
using mission::MissionModel;
using problem::PredictedValue;
using problem::ProblemGoal;
using problem::ProblemObject;
using reactor::Event;
using reactor::PlannedAction;
using reactor::PlanReceipt;
using reactor::PlanReply;
using reactor::PlanRequest;
using reactor::Severity;
using temporal::Verdict;

namespace {

static_assert(std::string_view(executive::kFallbackPrefix) == services::owner::kFallbackPrefix);

v1::NamedValue named_value(const std::string& name, const temporal::Value& value) {
  v1::NamedValue out;
  out.name(name);
  out.held(services::wire::to_wire(value));
  return out;
}

v1::PlanGoal to_wire(const ProblemGoal& in) {
  v1::PlanGoal out;
  out.issuer(in.key.issuer);
  out.id(in.key.id);
  out.achieved(services::wire::to_wire(in.achieved));
  out.importance(static_cast<v1::GoalClass>(in.importance));
  out.utility(in.utility.scores());
  out.priority(in.priority);
  out.preferred_us(services::wire::bound_to_wire(in.preferred));
  out.opens_us(in.opens.count());
  out.closes_us(in.closes.count());
  return out;
}

v1::PredictedValue to_wire(const PredictedValue& in) {
  v1::PredictedValue out;
  out.timeline(in.timeline);
  out.at_us(in.at.count());
  out.held(services::wire::to_wire(in.value));
  return out;
}

}  // namespace

GoalRequest from_wire(const v1::Goal& in) {
  GoalRequest out;
  out.key = {in.issuer(), in.id()};
  out.robot = in.robot();
  out.kind = in.goal_kind();
  for (const v1::Property& argument : in.arguments()) out.arguments[argument.name()] = argument.value();
  out.importance = static_cast<GoalClass>(std::min<std::uint32_t>(in.importance(), v1::GOAL_OPPORTUNISTIC));
  out.utility = temporal::RankVector(in.utility());
  out.priority = in.priority();
  if (in.preferred_us() >= 0) out.preferred = temporal::Time(in.preferred_us());
  out.opens = temporal::Time(in.opens_us());
  out.closes = temporal::Time(in.closes_us());
  out.recalled = in.recalled();
  out.sample = {in.header().sender(), in.header().incarnation(), in.header().seq()};
  return out;
}

Observation from_wire(const v1::Observation& in) {
  return {in.timeline(), services::wire::from_wire(in.observed())};
}

CommandAck from_wire(const v1::CommandAck& in) {
  const auto stage = static_cast<CommandStage>(std::min<std::uint32_t>(in.stage(), v1::STAGE_UNKNOWN));
  CommandAck out{in.activity(), in.attempt(),       stage, in.code(), in.reason(),
                 in.epoch(),    in.refused_epoch(), {}};
  services::owner::Results results = services::owner::status_from_wire(in).results;
  out.results = {results.duration, results.energy_j, std::move(results.values)};
  return out;
}

PlanReply from_wire(std::uint64_t call, const v1::PlanReply& in) {
  PlanReply out;
  out.call = call;
  out.verdict = static_cast<Verdict>(std::min<std::uint32_t>(in.verdict_code(), v1::VERDICT_NO_REPLY));
  out.reason = in.reason();
  for (const v1::BlockingGoal& goal : in.blocking())
    out.blocking.push_back({{goal.issuer(), goal.id()}, goal.timeline(), goal.reason()});
  if (out.verdict == Verdict::solved) out.plan = services::wire::from_wire(in.solution());
  return out;
}

v1::Goal to_wire(const GoalRequest& in) {
  v1::Goal out;
  out.issuer(in.key.issuer);
  out.id(in.key.id);
  out.goal_kind(in.kind);
  for (const auto& [name, value] : in.arguments) {
    v1::Property argument;
    argument.name(name);
    argument.value(value);
    out.arguments().push_back(std::move(argument));
  }
  out.importance(static_cast<v1::GoalClass>(in.importance));
  out.robot(in.robot);
  out.utility(in.utility.scores());
  out.preferred_us(services::wire::bound_to_wire(in.preferred));
  out.priority(in.priority);
  out.opens_us(in.opens.count());
  out.closes_us(in.closes.count());
  out.recalled(in.recalled);
  return out;
}

v1::GoalStatus to_wire(const GoalRecord& in, const std::string& executive, goals::AckStage stage) {
  v1::GoalStatus out;
  out.executive(executive);
  out.issuer(in.request.key.issuer);
  out.id(in.request.key.id);
  out.answers().sender(in.answers.sender);
  out.answers().incarnation(in.answers.incarnation);
  out.answers().seq(in.answers.number);
  out.goal_state(static_cast<v1::GoalState>(in.state));
  out.importance(static_cast<v1::GoalClass>(in.request.importance));
  out.goal_kind(in.request.kind);
  out.reason(in.reason);
  out.plan_version(in.plan_version);
  out.ack_stage(static_cast<v1::AckStage>(stage));
  return out;
}

v1::Command to_wire(const Command& in, const std::string& commander, std::uint32_t plan_version,
                    std::uint64_t epoch) {
  v1::Command out;
  out.commander(commander);
  out.activity(in.activity);
  out.attempt(in.attempt);
  out.action(static_cast<v1::CommandAction>(in.action));
  out.owner(in.owner);
  out.robot(in.robot);
  out.subsystem(in.subsystem);
  out.command_name(in.command_name);
  for (const temporal::Property& argument : in.arguments)
    out.arguments().push_back(services::wire::to_wire(argument));
  out.plan_version(in.plan != 0 ? in.plan : plan_version);
  out.epoch(in.epoch != 0 ? in.epoch : epoch);
  out.sender_epoch(epoch);
  out.expected_us(in.expected.count());
  out.latest_end_us(services::wire::bound_to_wire(in.latest_end));
  return out;
}

v1::StepStatus to_wire(const StepStatus& in, const std::string& executive, std::uint32_t plan_version) {
  v1::StepStatus out;
  out.executive(executive);
  out.activity(in.activity);
  out.plan_version(plan_version);
  out.attempt(in.attempt);
  out.name(in.name);
  out.state(static_cast<v1::ActivityState>(in.state));
  out.earliest_start_us(in.earliest_start.count());
  out.latest_start_us(services::wire::bound_to_wire(in.latest_start));
  out.started_us(in.started ? in.started->count() : -1);
  out.ended_us(in.ended ? in.ended->count() : -1);
  out.cause(in.reason);
  return out;
}

v1::ExecutedPlan to_wire(const reactor::ExecutedPlan& in, const std::string& executive) {
  v1::ExecutedPlan out;
  out.executive(executive);
  out.version(in.version);
  out.id(in.id);
  out.origin_us(in.origin.count());
  out.outcome(static_cast<v1::ExecutedOutcome>(in.outcome));
  out.reason(in.reason);
  for (const reactor::ExecutedActivity& activity : in.activities) {
    v1::ExecutedActivity one;
    one.id(activity.id);
    one.name(activity.name);
    one.level(activity.level);
    one.parent(activity.parent);
    one.robot(activity.robot);
    one.state(static_cast<v1::ActivityState>(activity.state));
    one.started_us(activity.started ? activity.started->count() : -1);
    one.ended_us(activity.ended ? activity.ended->count() : -1);
    one.attempts(activity.attempts);
    one.cause(activity.cause);
    one.results(services::owner::to_wire(
        {activity.results.duration, activity.results.energy_j, activity.results.values}));
    out.activities().push_back(std::move(one));
  }
  return out;
}

v1::PlanRequest to_wire(const PlanRequest& in, const MissionModel& mission) {
  v1::PlanRequest out;
  out.engine(mission.planner.engine);
  out.origin_us(in.origin.count());
  out.model(mission.model_text);
  out.problem_text(in.problem.text);
  for (const auto& [timeline, value] : in.problem.state) out.state().push_back(named_value(timeline, value));
  for (const PredictedValue& value : in.problem.predictions) out.predictions().push_back(to_wire(value));
  for (const ProblemGoal& goal : in.problem.goals) out.goals().push_back(to_wire(goal));
  for (const ProblemObject& object : in.problem.objects) {
    v1::PlanObject wire;
    wire.name(object.name);
    wire.object_type(object.type);
    for (const temporal::Property& property : object.properties)
      wire.properties().push_back(services::wire::to_wire(property));
    out.objects().push_back(std::move(wire));
  }
  for (const PlannedAction& action : in.remaining) {
    v1::RemainingAction wire;
    wire.name(action.name);
    wire.arguments(action.arguments);
    wire.start_us(action.start.count());
    wire.duration_us(action.duration.count());
    out.remaining().push_back(std::move(wire));
  }
  out.budget().work(mission.planner.work);
  out.budget().memory_mb(mission.planner.memory_mb);
  out.budget().wall_us(mission.planner.wall.count());
  return out;
}

v1::PlanReceipt to_wire(const PlanReceipt& in, const std::string& executive) {
  v1::PlanReceipt out;
  out.executive(executive);
  out.version(in.version);
  out.refused(in.refused);
  out.reason(in.reason);
  out.conflict(in.conflict);
  out.open(in.open);
  return out;
}

v1::Event to_wire(const Event& in) {
  v1::Event out;
  out.severity_level(in.level == Severity::info      ? v1::SEVERITY_INFO
                     : in.level == Severity::warning ? v1::SEVERITY_WARNING
                                                     : v1::SEVERITY_ERROR);
  out.code(in.code);
  out.text(in.text);
  return out;
}

std::string trace_line(const v1::CommandAck& in) {
  return "ack " + in.activity() + " " + std::to_string(in.attempt()) +
         " stage=" + std::to_string(in.stage()) + " " + in.owner() + " " + in.code() + " " + in.reason();
}

std::string trace_line(const v1::Observation& in) {
  return "observation " + in.timeline() + " " + temporal::to_text(services::wire::from_wire(in.observed())) +
         " sampled " + std::to_string(in.sampled_us());
}

}  // namespace roci::exec
