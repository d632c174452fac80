#include "planner_svc/planning_call.hpp"

#include <exception>
#include <limits>

#include "core/pddl/parser.hpp"
#include "planner_svc/plan_export.hpp"
#include "planner_svc/temporal_pddl/planner.hpp"
#include "planner_svc/validate/validator.hpp"

namespace roci::planner {
namespace {

// Evaluations spent on better plans once there is one: some 60 ms in the missions at hand.
constexpr std::size_t kImprovementEvaluations = 1000;

PlanningVerdict verdict_of(temporal_pddl::Verdict verdict) {
  switch (verdict) {
    case temporal_pddl::Verdict::solved:
      return PlanningVerdict::solved;
    case temporal_pddl::Verdict::unsolvable:
      return PlanningVerdict::unsolvable;
    case temporal_pddl::Verdict::timeout:
      return PlanningVerdict::timeout;
    case temporal_pddl::Verdict::out_of_memory:
      return PlanningVerdict::out_of_memory;
    case temporal_pddl::Verdict::unsupported:
      return PlanningVerdict::unsupported;
    case temporal_pddl::Verdict::function_unavailable:
      return PlanningVerdict::function_unavailable;
    case temporal_pddl::Verdict::cancelled:
      return PlanningVerdict::cancelled;
    case temporal_pddl::Verdict::invalid_input:
      return PlanningVerdict::invalid_input;
  }
  return PlanningVerdict::crashed;
}

PlanningAnswer refused(PlanningVerdict verdict, std::string reason) {
  PlanningAnswer out;
  out.verdict = verdict;
  out.reason = std::move(reason);
  return out;
}

pddl::FunctionTable table_of(const std::vector<temporal_pddl::FunctionUse>& uses) {
  pddl::FunctionTable table;
  for (const temporal_pddl::FunctionUse& use : uses) {
    std::string application = "(" + use.call.function;
    for (const std::string& argument : use.call.arguments) application += " " + argument;
    const bool has_value = use.answer.outcome == FunctionOutcome::value;
    table[application + ")"] = has_value ? std::optional(use.answer.value) : std::nullopt;
  }
  return table;
}

// What the independent validator has against the plan, empty if nothing. It sees the printed steps and the
// function values alone.
std::string fault_of(const pddl::Domain& domain, const pddl::Problem& problem,
                     const temporal_pddl::Result& result, const pddl::FunctionTable& table) {
  std::vector<pddl::PlanStep> steps;
  for (const temporal_pddl::Activity& activity : result.plan->activities) {
    pddl::PlanStep step;
    step.start = activity.start;
    step.action.symbol = activity.name;
    for (const std::string& object : activity.arguments) step.action.arguments.push_back({object, {}});
    if (activity.durative) step.duration = activity.end - activity.start;
    steps.push_back(std::move(step));
  }
  const validate::Report report = validate::validate(domain, problem, steps, table);
  return report.valid ? "" : validate::to_text(report, steps, "plan");
}

PlanningAnswer search(const PlanningCall& call, FunctionSource& functions) {
  const pddl::Domain domain = pddl::parse_domain(call.domain_text, "domain");
  const pddl::Problem problem = pddl::parse_problem(call.problem_text, "problem");
  temporal_pddl::Budget budget;
  if (call.evaluations != 0) budget.evaluations = call.evaluations;
  if (call.memory_bytes != 0) budget.memory_bytes = call.memory_bytes;
  budget.out_of_time = call.out_of_time;
  temporal_pddl::Monitor monitor;
  monitor.cancelled = call.cancelled;
  temporal_pddl::Options options;
  options.improvement_evaluations = kImprovementEvaluations;
  const temporal_pddl::Result result =
      temporal_pddl::plan(domain, problem, functions, budget, monitor, options, call.remaining);
  PlanningAnswer out;
  out.verdict = verdict_of(result.verdict);
  out.reason = result.where ? to_string(*result.where) : result.reason;
  out.statistics = {result.statistics.expanded, result.statistics.evaluated,
                    result.statistics.bytes_per_state, result.statistics.from_remaining};
  out.function_values = table_of(result.functions);
  if (result.plan) {
    const std::string fault = fault_of(domain, problem, result, out.function_values);
    if (!fault.empty())
      return refused(PlanningVerdict::crashed, "the validator rejects the engine's plan: " + fault);
    out.plan = export_plan(*result.plan, result.functions);
  }
  return out;
}

}  // namespace

PlanningAnswer answer_call(const PlanningCall& call, FunctionSource& functions) {
  if (call.engine != "temporal_pddl") {
    return refused(PlanningVerdict::unsupported,
                   "unknown engine '" + call.engine + "'; this planner has: temporal_pddl");
  }
  try {
    return search(call, functions);
  } catch (const pddl::ParseError& error) {
    return refused(PlanningVerdict::invalid_input, error.what());
  } catch (const std::bad_alloc&) {
    return refused(PlanningVerdict::out_of_memory,
                   "memory ran out outside the search; give the call a larger budget");
  } catch (const std::exception& error) {
    return refused(PlanningVerdict::crashed, error.what());
  }
}

const char* to_string(PlanningVerdict verdict) {
  switch (verdict) {
    case PlanningVerdict::solved:
      return "solved";
    case PlanningVerdict::unsolvable:
      return "unsolvable";
    case PlanningVerdict::timeout:
      return "timeout";
    case PlanningVerdict::out_of_memory:
      return "out_of_memory";
    case PlanningVerdict::unsupported:
      return "unsupported";
    case PlanningVerdict::function_unavailable:
      return "function_unavailable";
    case PlanningVerdict::cancelled:
      return "cancelled";
    case PlanningVerdict::invalid_input:
      return "invalid_input";
    case PlanningVerdict::crashed:
      return "crashed";
  }
  return "unknown";
}

}  // namespace roci::planner
