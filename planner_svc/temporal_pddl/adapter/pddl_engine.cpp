#include "planner_svc/temporal_pddl/adapter/pddl_engine.hpp"

#include <algorithm>
#include <exception>
#include <functional>
#include <new>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/pddl/check.hpp"
#include "core/pddl/plan_text.hpp"
#include "planner_svc/engine/table_functions.hpp"
#include "planner_svc/temporal_pddl/adapter/owners_verdicts.hpp"
#include "planner_svc/temporal_pddl/extraction/flexible_plan_export.hpp"
#include "planner_svc/temporal_pddl/planner.hpp"

namespace roci::planner::temporal_pddl::adapter {

using call::BlockedFact, call::Budget, call::Monitor, call::NamedGoal, call::Options;
using engine::Answer, engine::BlockingGoal, engine::FunctionSource, engine::FunctionUse, engine::Limits,
    engine::RemainingAction, engine::Request;
using temporal::Verdict;

namespace {

std::vector<pddl::PlanStep> steps_of(const std::vector<RemainingAction>& remaining) {
  std::vector<pddl::PlanStep> out;
  out.reserve(remaining.size());
  for (const RemainingAction& action : remaining) {
    pddl::PlanStep step;
    step.start = action.start;
    step.duration = action.duration;
    step.action.symbol = action.name;
    for (const std::string& object : action.arguments) step.action.arguments.push_back({object, {}});
    out.push_back(std::move(step));
  }
  return out;
}

// The facts that a goal asks for. Its condition is a conjunction over facts as timelines; other conditions
// stand in the problem alone.
std::vector<std::string> facts_of(const engine::Goal& goal) {
  std::vector<std::string> facts;
  for (const temporal::ConditionNode& node : goal.achieved.nodes) {
    if (node.op == temporal::ConditionOp::any_of || node.op == temporal::ConditionOp::negation) return {};
    const bool* holds = std::get_if<bool>(&node.operand);
    if (node.op != temporal::ConditionOp::eq || holds == nullptr) continue;
    facts.push_back(*holds ? node.timeline : "(not " + node.timeline + ")");
  }
  return facts;
}

std::vector<NamedGoal> named_goals(const std::vector<engine::Goal>& goals) {
  std::vector<NamedGoal> out;
  for (const engine::Goal& goal : goals) out.push_back({goal.key(), facts_of(goal)});
  return out;
}

// Each goal of which a fact is out of reach, once; where an owner of functions said so, with its words.
std::vector<BlockingGoal> blocking_goals(const std::vector<BlockedFact>& blocked, const Request& request,
                                         const pddl::Problem& problem, const std::vector<FunctionUse>& uses) {
  std::vector<BlockingGoal> out;
  for (const engine::Goal& goal : request.goals) {
    const std::vector<std::string> facts = facts_of(goal);
    const auto found = std::ranges::find_if(
        blocked, [&](const BlockedFact& one) { return std::ranges::count(facts, one.fact) > 0; });
    if (found == blocked.end()) continue;
    const engine::OwnersWords words = words_against(facts, problem, request.objects, uses);
    out.push_back(
        {goal.issuer, goal.id, found->fact, words.text.empty() ? found->reason : words.text, words.proved});
  }
  return out;
}

Answer plan_for(const Request& request, const Limits& limits, FunctionSource& functions,
                const std::vector<pddl::PlanStep>& remaining, std::vector<FunctionUse>& used) {
  const pddl::Domain domain = pddl::load_domain(request.model, "domain");
  const pddl::Problem problem = pddl::load_problem(request.problem_text, "problem", domain);
  Budget budget;
  if (request.work != 0) budget.evaluations = request.work;
  if (request.memory_bytes != 0) budget.memory_bytes = request.memory_bytes;
  budget.out_of_time = limits.out_of_time;
  Monitor monitor;
  monitor.cancelled = limits.cancelled;
  Options options;
  options.improvement_evaluations = request.improvement;
  options.functions = request.functions;
  const std::vector<NamedGoal> goals = named_goals(request.goals);
  Result result = temporal_pddl::plan(domain, problem, functions, budget, monitor, options, remaining, goals);
  Answer out;
  for (const auto* warnings : {&domain.warnings, &problem.warnings})
    for (const pddl::Diagnostic& warning : *warnings) out.warnings.push_back(pddl::to_string(warning));
  out.verdict = result.verdict;
  out.reason = std::move(result.reason);
  out.lacks_values = result.lacks_values;
  out.statistics.expanded = result.statistics.expanded;
  out.statistics.evaluated = result.statistics.evaluated;
  out.statistics.bytes_per_state = result.statistics.bytes_per_state;
  out.statistics.from_remaining = result.statistics.from_remaining;
  out.warnings.insert(out.warnings.end(), result.warnings.begin(), result.warnings.end());
  out.blocking = blocking_goals(result.blocked, request, problem, result.functions);
  // A search that ends for want of one goal's values has reached no other goal, either.
  const auto stands_on_unknown = [](const BlockingGoal& goal) { return !goal.proved; };
  if (result.lacks_values && std::ranges::any_of(out.blocking, stands_on_unknown))
    std::erase_if(out.blocking, std::not_fn(stands_on_unknown));
  std::vector<std::string> names;
  for (const NamedGoal& goal : goals) names.push_back(goal.name);
  if (result.plan) out.plan = export_plan(*result.plan, result.functions, names);
  used = std::move(result.functions);
  return out;
}

}  // namespace

Answer PddlEngine::answer(const Request& request, const Limits& limits, FunctionSource& functions) {
  const std::vector<pddl::PlanStep> remaining = steps_of(request.remaining);
  std::vector<FunctionUse> used;
  Answer out;
  try {
    out = plan_for(request, limits, functions, remaining, used);
  } catch (const pddl::ParseError& error) {
    out = engine::without_plan(error.unsupported() ? Verdict::unsupported : Verdict::invalid_input,
                               error.what());
  } catch (const std::bad_alloc&) {
    out = engine::without_plan(Verdict::out_of_memory,
                               "memory ran out outside the search; give the call a larger budget");
  } catch (const std::exception& error) {
    out = engine::without_plan(Verdict::crashed, error.what());
  }
  out.record = {{".pddl", request.problem_text}, {".values", pddl::print(engine::tables_of(used))}};
  if (!remaining.empty()) out.record.push_back({".remaining", pddl::print_plan(remaining)});
  return out;
}

}  // namespace roci::planner::temporal_pddl::adapter
