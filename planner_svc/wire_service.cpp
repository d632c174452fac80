#include "planner_svc/wire_service.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "services/wire/function_wire.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::planner {

using engine::FunctionCall, engine::FunctionOutcome, engine::FunctionValue, engine::Provenance,
    engine::SharedProvenance, engine::RemainingAction;
using temporal::FunctionAccuracy;

namespace {

constexpr std::size_t kMostRemaining = 1000;
constexpr temporal::Duration kLatest = std::chrono::seconds(1'000'000'000);  // some thirty years

bool in_reach(temporal::Duration time) { return time >= temporal::Duration{0} && time <= kLatest; }

std::vector<RemainingAction> from_wire(const std::vector<v1::RemainingAction>& remaining) {
  std::vector<RemainingAction> out;
  for (std::size_t i = 0; i < std::min(remaining.size(), kMostRemaining); ++i) {
    const v1::RemainingAction& action = remaining[i];
    const temporal::Duration start(action.start_us());
    const temporal::Duration duration(action.duration_us());
    if (in_reach(start) && in_reach(duration))
      out.push_back({action.name(), action.arguments(), start, duration});
  }
  return out;
}

std::vector<temporal::Property> from_wire(const std::vector<v1::Property>& in) {
  std::vector<temporal::Property> out;
  out.reserve(in.size());
  for (const v1::Property& property : in) out.push_back({property.name(), property.value()});
  return out;
}

engine::GoalClass from_wire(v1::GoalClass in) {
  return static_cast<engine::GoalClass>(std::min<std::uint32_t>(in, v1::GOAL_OPPORTUNISTIC));
}

temporal::Time or_none(std::int64_t time_us, bool none) {
  return none ? temporal::no_bound : temporal::Time(time_us);
}

std::optional<temporal::Time> if_happened(std::int64_t time_us) {
  return time_us < 0 ? std::nullopt : std::optional(temporal::Time(time_us));
}

// Converts what goals of a call (v1::PlanGoal) and goals that are heard (v1::Goal) have in common.
template <class WireGoal>
engine::Goal common_part(const WireGoal& in) {
  engine::Goal out;
  out.issuer = in.issuer();
  out.id = in.id();
  out.importance = from_wire(in.importance());
  out.utility = temporal::RankVector(in.utility());
  out.priority = in.priority();
  out.preferred = or_none(in.preferred_us(), in.preferred_us() < 0);
  out.opens = temporal::Time(in.opens_us());
  out.closes = or_none(in.closes_us(), in.closes_us() == 0);
  return out;
}

engine::Goal from_wire(const v1::PlanGoal& in) {
  engine::Goal out = common_part(in);
  out.achieved = services::wire::from_wire(in.achieved());
  return out;
}

FunctionOutcome from_wire(v1::FunctionOutcome outcome, double number) {
  switch (outcome) {
    case v1::FUNCTION_VALUE:
      return std::isfinite(number) ? FunctionOutcome::value : FunctionOutcome::not_a_number;
    case v1::FUNCTION_UNREACHABLE:
      return FunctionOutcome::unreachable;
    case v1::FUNCTION_UNKNOWN_OBJECT:
      return FunctionOutcome::unknown_object;
    case v1::FUNCTION_WRONG_ARITY:
      return FunctionOutcome::wrong_arity;
    case v1::FUNCTION_UNKNOWN:
      return FunctionOutcome::unknown;
    case v1::FUNCTION_UNKNOWN_FUNCTION:
    case v1::FUNCTION_FAILED:
      return FunctionOutcome::unavailable;
  }
  return FunctionOutcome::unavailable;
}

// What the owner means by an outcome that has no name of its own here.
std::string reason_of(v1::FunctionOutcome outcome) {
  if (outcome == v1::FUNCTION_UNKNOWN) return "it found no value with the effort spent";
  if (outcome == v1::FUNCTION_UNKNOWN_FUNCTION) return "it does not know this function";
  if (outcome == v1::FUNCTION_FAILED) return "it failed to compute the value";
  return "";
}

FunctionOutcome outcome_of(services::rpc::CallStatus failure) {
  if (failure == services::rpc::CallStatus::timeout) return FunctionOutcome::late;
  if (failure == services::rpc::CallStatus::owner_lost) return FunctionOutcome::owner_lost;
  return FunctionOutcome::unavailable;
}

}  // namespace

engine::Request from_wire(const v1::PlanRequest& in) {
  engine::Request out;
  out.engine = in.engine();
  out.robot = in.header().robot();
  out.origin = temporal::Time(in.origin_us());
  out.model = in.model();
  out.problem_text = in.problem_text();
  for (const v1::NamedValue& value : in.state())
    out.state.insert_or_assign(value.name(), services::wire::from_wire(value.held()));
  for (const v1::PredictedValue& value : in.predictions())
    out.predictions.push_back(
        {value.timeline(), temporal::Time(value.at_us()), services::wire::from_wire(value.held())});
  for (const v1::PlanGoal& goal : in.goals()) out.goals.push_back(from_wire(goal));
  for (const v1::PlanObject& object : in.objects())
    out.objects.push_back({object.name(), object.object_type(), from_wire(object.properties())});
  out.remaining = from_wire(in.remaining());
  out.work = in.budget().work();
  out.memory_bytes = static_cast<std::size_t>(in.budget().memory_mb()) << 20U;
  return out;
}

v1::PlanReply to_wire(const engine::Answer& in) {
  v1::PlanReply out;
  out.verdict_code(static_cast<v1::Verdict>(in.verdict));
  out.reason(in.reason);
  for (const engine::BlockingGoal& goal : in.blocking) {
    v1::BlockingGoal wire;
    wire.issuer(goal.issuer);
    wire.id(goal.id);
    wire.timeline(goal.timeline);
    wire.reason(goal.reason);
    out.blocking().push_back(std::move(wire));
  }
  if (in.plan) out.solution(services::wire::to_wire(*in.plan));
  out.statistics().expanded(in.statistics.expanded);
  out.statistics().evaluated(in.statistics.evaluated);
  out.statistics().function_tuples(in.statistics.function_tuples);
  out.statistics().bytes_per_state(in.statistics.bytes_per_state);
  out.statistics().from_remaining(in.statistics.from_remaining);
  return out;
}

v1::PlanReply cancelled_reply() {
  v1::PlanReply reply;
  reply.verdict_code(v1::VERDICT_CANCELLED);
  reply.reason("cancelled by the caller");
  return reply;
}

v1::FunctionRequest to_wire(const std::vector<FunctionCall>& calls,
                            const std::vector<engine::Object>& objects) {
  v1::FunctionRequest out;
  std::map<std::string, std::uint32_t> index;
  const auto add = [&](const std::string& name) {
    const auto [found, added] = index.emplace(name, static_cast<std::uint32_t>(out.objects().size()));
    if (added) {
      out.objects().emplace_back();
      out.objects().back().name(name);
    }
    return found->second;
  };
  for (const engine::Object& object : objects) {
    v1::PlanObject& wire = out.objects()[add(object.name)];
    wire.object_type(object.type);
    for (const temporal::Property& property : object.properties)
      wire.properties().push_back(services::wire::to_wire(property));
  }
  v1::FunctionBatch batch;
  batch.function(calls.front().function);
  batch.arity(static_cast<std::uint32_t>(calls.front().arguments.size()));
  batch.accuracy(static_cast<v1::FunctionAccuracy>(calls.front().accuracy));
  for (const FunctionCall& call : calls)
    for (const std::string& argument : call.arguments) batch.tuples().push_back(add(argument));
  for (const engine::AssumedValue& assumed : calls.front().state) {
    v1::NamedValue named;
    named.name(assumed.timeline);
    named.held(services::wire::to_wire(temporal::Value(assumed.number)));
    out.state().push_back(std::move(named));
  }
  out.module_name(calls.front().module);
  out.batches({std::move(batch)});
  return out;
}

std::vector<FunctionValue> values_of(const std::vector<FunctionCall>& calls, const Provenance& asked,
                                     const services::CallResult<v1::FunctionReply>& result) {
  if (result.status != services::rpc::CallStatus::ok)
    return {calls.size(), FunctionValue{outcome_of(result.status), 0, asked, result.reason}};
  const v1::FunctionReply& reply = result.reply;
  const bool whole = reply.results().size() == 1 && reply.results()[0].numbers().size() == calls.size() &&
                     reply.results()[0].outcomes().size() == calls.size();
  if (!whole) {
    return {calls.size(), FunctionValue{FunctionOutcome::unavailable, 0, asked,
                                        "it answered with another number of values than asked for"}};
  }
  const auto accuracy = static_cast<FunctionAccuracy>(
      std::min<std::uint32_t>(reply.results()[0].accuracy(), v1::ACCURACY_ESTIMATE));
  if (accuracy != FunctionAccuracy::exact && accuracy != calls.front().accuracy) {
    return {calls.size(), FunctionValue{FunctionOutcome::unavailable, 0, asked,
                                        "it answered with another accuracy than asked for"}};
  }
  const SharedProvenance provenance(
      Provenance{reply.owner(), std::to_string(reply.model_version()), temporal::Time(reply.computed_us())});
  const std::map<std::string, std::string> words = services::wire::words_of(reply);
  std::vector<FunctionValue> values;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const double number = reply.results()[0].numbers()[i];
    const v1::FunctionOutcome outcome = reply.results()[0].outcomes()[i];
    std::string reason = reason_of(outcome);
    if (outcome == v1::FUNCTION_UNREACHABLE)
      for (const std::string& object : calls[i].arguments)
        if (const auto why = words.find(object); why != words.end()) reason = object + ": " + why->second;
    values.push_back({from_wire(outcome, number), number, provenance, std::move(reason), accuracy});
  }
  return values;
}

engine::Goal from_wire(const v1::Goal& in) {
  engine::Goal out = common_part(in);
  out.kind = in.goal_kind();
  out.arguments = from_wire(in.arguments());
  return out;
}

engine::Observation from_wire(const v1::Observation& in) {
  return {in.timeline(), services::wire::from_wire(in.observed()), temporal::Time(in.sampled_us())};
}

engine::DataProduct from_wire(const v1::DataProduct& in) {
  engine::DataProduct out;
  out.id = in.id();
  out.kind = in.product_kind();
  out.source = in.source();
  out.tier = static_cast<engine::DataTier>(std::min<std::uint32_t>(in.tier(), v1::TIER_RESIDUAL));
  out.bytes = std::min(in.bytes(), kProductBytes);
  out.created = std::clamp(temporal::Time(in.created_us()), temporal::Time{0}, temporal::Time(kLatest));
  out.utility = temporal::RankVector(in.utility());
  out.fate = static_cast<engine::DataFate>(std::min<std::uint32_t>(in.fate(), v1::PRODUCT_LOST));
  out.told = std::clamp(temporal::Time(in.header().stamp_us()), temporal::Time{0}, temporal::Time(kLatest));
  return out;
}

engine::StepStatus from_wire(const v1::StepStatus& in) {
  engine::StepStatus out;
  out.attempt = in.attempt();
  out.plan_version = in.plan_version();
  out.activity = in.activity();
  out.progress.state =
      static_cast<temporal::ActivityState>(std::min<std::uint32_t>(in.state(), v1::ACTIVITY_CANCELLED));
  out.progress.started = if_happened(in.started_us());
  out.progress.ended = if_happened(in.ended_us());
  out.cause = in.cause();
  return out;
}

engine::CommandResult from_wire(const v1::CommandAck& in) {
  engine::CommandResult out;
  out.activity = in.activity();
  out.attempt = in.attempt();
  if (std::isfinite(in.outcome().energy_j())) out.energy_j = in.outcome().energy_j();
  for (const v1::NamedValue& one : in.outcome().measured()) {
    if (out.values.size() == kResultValues) break;
    if (one.name().size() > kNameBytes || one.held().kind() != v1::VALUE_NUMBER) continue;
    if (std::isfinite(one.held().number())) out.values.insert_or_assign(one.name(), one.held().number());
  }
  return out;
}

engine::Receipt from_wire(const v1::PlanReceipt& in) {
  return {in.version(), in.refused(), in.reason(), in.conflict(), in.open()};
}

}  // namespace roci::planner
