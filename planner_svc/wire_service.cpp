#include "planner_svc/wire_service.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "services/wire/plan_wire.hpp"

namespace roci::planner {
namespace {

using temporal_pddl::adapter::PlanningAnswer;
using temporal_pddl::adapter::PlanningCall;

constexpr std::size_t kMostRemaining = 1000;
constexpr temporal::Duration kLatest = std::chrono::seconds(1'000'000'000);  // as pddl::parse_plan

bool in_reach(temporal::Duration time) { return time >= temporal::Duration{0} && time <= kLatest; }

std::vector<pddl::PlanStep> from_wire(const std::vector<v1::RemainingAction>& remaining) {
  std::vector<pddl::PlanStep> out;
  for (std::size_t i = 0; i < std::min(remaining.size(), kMostRemaining); ++i) {
    pddl::PlanStep step;
    step.start = temporal::Duration(remaining[i].start_us());
    step.duration = temporal::Duration(remaining[i].duration_us());
    if (!in_reach(step.start) || !in_reach(*step.duration)) continue;
    step.action.symbol = remaining[i].name();
    for (const std::string& object : remaining[i].arguments()) step.action.arguments.push_back({object, {}});
    out.push_back(std::move(step));
  }
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
    case v1::FUNCTION_UNKNOWN_FUNCTION:
    case v1::FUNCTION_FAILED:
      return FunctionOutcome::unavailable;
  }
  return FunctionOutcome::unavailable;
}

// What the owner means by an outcome that has no name of its own here.
std::string reason_of(v1::FunctionOutcome outcome) {
  if (outcome == v1::FUNCTION_UNKNOWN) return "it found no value with the effort that it spends";
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

PlanningCall from_wire(const v1::PlanRequest& in) {
  PlanningCall out;
  out.engine = in.engine();
  out.domain_text = in.model();
  out.problem_text = in.problem_text();
  out.remaining = from_wire(in.remaining());
  out.evaluations = in.budget().work();
  out.memory_bytes = static_cast<std::size_t>(in.budget().memory_mb()) << 20U;
  return out;
}

v1::PlanReply to_wire(const PlanningAnswer& in) {
  v1::PlanReply out;
  out.verdict_code(static_cast<v1::Verdict>(in.verdict));
  out.reason(in.reason);
  if (in.plan) out.solution(services::wire::to_wire(*in.plan));
  out.statistics().expanded(in.statistics.expanded);
  out.statistics().evaluated(in.statistics.evaluated);
  out.statistics().function_tuples(in.function_values.size());
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

v1::FunctionRequest to_wire(const std::vector<FunctionCall>& calls, std::vector<v1::PlanObject> objects) {
  std::map<std::string, std::uint32_t> index;
  for (std::size_t i = 0; i < objects.size(); ++i)
    index.emplace(objects[i].name(), static_cast<std::uint32_t>(i));
  v1::FunctionBatch batch;
  batch.function(calls.front().function);
  batch.arity(static_cast<std::uint32_t>(calls.front().arguments.size()));
  for (const FunctionCall& call : calls) {
    for (const std::string& argument : call.arguments) {
      const auto [found, added] = index.emplace(argument, static_cast<std::uint32_t>(objects.size()));
      if (added) {
        objects.emplace_back();
        objects.back().name(argument);
      }
      batch.tuples().push_back(found->second);
    }
  }
  v1::FunctionRequest out;
  out.module_name(calls.front().module);
  out.objects(std::move(objects));
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
  const Provenance provenance{reply.owner(), std::to_string(reply.model_version()),
                              temporal::Time(reply.computed_us())};
  std::vector<FunctionValue> values;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const double number = reply.results()[0].numbers()[i];
    const v1::FunctionOutcome outcome = reply.results()[0].outcomes()[i];
    values.push_back({from_wire(outcome, number), number, provenance, reason_of(outcome)});
  }
  return values;
}

}  // namespace roci::planner
