#include "planner_svc/temporal_pddl/adapter/planning_call.hpp"

#include <exception>
#include <limits>

#include "core/pddl/parser.hpp"
#include "planner_svc/temporal_pddl/extraction/flexible_plan_export.hpp"
#include "planner_svc/temporal_pddl/planner.hpp"
#include "planner_svc/temporal_pddl/validate/validator.hpp"

namespace roci::planner::temporal_pddl::adapter {

using call::Budget;
using call::Monitor;
using call::Options;
using extraction::Activity;
using grounding::lifted::FunctionUse;
using temporal::Verdict;

namespace {

// Evaluations spent on better plans once there is one: some 60 ms in the missions at hand.
constexpr std::size_t kImprovementEvaluations = 1000;

PlanningAnswer failed(Verdict verdict, std::string reason) {
  PlanningAnswer out;
  out.verdict = verdict;
  out.reason = std::move(reason);
  return out;
}

pddl::FunctionTable table_of(const std::vector<FunctionUse>& uses) {
  pddl::FunctionTable table;
  for (const FunctionUse& use : uses) {
    std::string application = "(" + use.call.function;
    for (const std::string& argument : use.call.arguments) application += " " + argument;
    const bool has_value = use.answer.outcome == FunctionOutcome::value;
    table[application + ")"] = has_value ? std::optional(use.answer.value) : std::nullopt;
  }
  return table;
}

// What the independent validator has against the plan, empty if nothing. It sees the printed steps and the
// function values alone.
std::string fault_of(const pddl::Domain& domain, const pddl::Problem& problem, const Result& result,
                     const pddl::FunctionTable& table) {
  std::vector<pddl::PlanStep> steps;
  for (const Activity& activity : result.plan->activities) {
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

PlanningAnswer plan_and_check(const PlanningCall& call, FunctionSource& functions) {
  const pddl::Domain domain = pddl::parse_domain(call.domain_text, "domain");
  const pddl::Problem problem = pddl::parse_problem(call.problem_text, "problem");
  Budget budget;
  if (call.evaluations != 0) budget.evaluations = call.evaluations;
  if (call.memory_bytes != 0) budget.memory_bytes = call.memory_bytes;
  budget.out_of_time = call.out_of_time;
  Monitor monitor;
  monitor.cancelled = call.cancelled;
  Options options;
  options.improvement_evaluations = kImprovementEvaluations;
  const Result result =
      temporal_pddl::plan(domain, problem, functions, budget, monitor, options, call.remaining);
  PlanningAnswer out;
  out.verdict = result.verdict;
  out.reason = result.reason;
  out.statistics = {result.statistics.expanded, result.statistics.evaluated,
                    result.statistics.bytes_per_state, result.statistics.from_remaining};
  out.function_values = table_of(result.functions);
  if (result.plan) {
    const std::string fault = fault_of(domain, problem, result, out.function_values);
    if (!fault.empty()) return failed(Verdict::crashed, "the validator rejects the engine's plan: " + fault);
    out.plan = export_plan(*result.plan, result.functions);
  }
  return out;
}

}  // namespace

PlanningAnswer answer_call(const PlanningCall& call, FunctionSource& functions) {
  if (call.engine != "temporal_pddl") {
    return failed(Verdict::unsupported,
                  "unknown engine '" + call.engine + "'; this planner has: temporal_pddl");
  }
  try {
    return plan_and_check(call, functions);
  } catch (const pddl::ParseError& error) {
    return failed(Verdict::invalid_input, error.what());
  } catch (const std::bad_alloc&) {
    return failed(Verdict::out_of_memory, "memory ran out outside the search; give the call a larger budget");
  } catch (const std::exception& error) {
    return failed(Verdict::crashed, error.what());
  }
}

}  // namespace roci::planner::temporal_pddl::adapter
