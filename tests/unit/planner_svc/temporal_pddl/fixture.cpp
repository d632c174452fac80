#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

#include "core/pddl/check.hpp"
#include "planner_svc/temporal_pddl/call/search_limits.hpp"

namespace roci::planner::temporal_pddl::testing {

using call::Budget, call::Monitor, call::Options, call::SearchLimits;
using engine::FunctionCall, engine::FunctionOutcome, engine::FunctionSource, engine::FunctionValue,
    engine::NoFunctions;
using grounding::ground;
using grounding::Grounding;
using task::ActionId, task::FactId, task::NumberId, task::Task;

Model model(const std::string& domain, const std::string& problem) {
  Model result;
  result.domain = pddl::load_domain("(define (domain d)\n" + domain + ")", "domain.pddl");
  result.problem =
      pddl::load_problem("(define (problem p) (:domain d)\n" + problem + ")", "problem.pddl", result.domain);
  return result;
}

void MapFunctions::set(const std::string& application, double value) {
  answers[application].outcome = FunctionOutcome::value;
  answers[application].value = value;
}

void MapFunctions::set(const std::string& application, FunctionOutcome outcome) {
  answers[application].outcome = outcome;
}

std::vector<FunctionValue> MapFunctions::evaluate(std::span<const FunctionCall> asked,
                                                  const std::function<bool()>&) {
  ++batches;
  calls += asked.size();
  std::vector<FunctionValue> result;
  for (const auto& call : asked) {
    std::string application = "(" + call.function;
    for (const auto& argument : call.arguments) application += " " + argument;
    const auto found = answers.find(application + ")");
    result.push_back(found == answers.end() ? FunctionValue{} : found->second);
  }
  return result;
}

Grounding grounded(const Model& model, const Options& options) {
  NoFunctions functions;
  const Budget budget;
  const Monitor monitor;
  SearchLimits limits(budget, monitor);
  grounding::GroundingReport report;
  return ground(model.domain, model.problem, functions, options, limits, report);
}

Result solved(const Model& model, const Options& options, const Budget& budget) {
  NoFunctions functions;
  return plan(model.domain, model.problem, functions, budget, {}, options);
}

Result solved(const Model& model, FunctionSource& functions, const Options& options) {
  return plan(model.domain, model.problem, functions, {}, {}, options);
}

FactId fact(const Task& task, const std::string& wanted) {
  for (std::size_t i = 0; i < task.fact_names.size(); ++i) {
    if (name(task, FactId(i)) == wanted) return FactId(i);
  }
  return {};
}

ActionId action(const Task& task, const std::string& wanted) {
  for (std::size_t i = 0; i < task.actions.size(); ++i) {
    if (name(task, ActionId(i)) == wanted) return ActionId(i);
  }
  return {};
}

NumberId number(const Task& task, const std::string& wanted) {
  for (std::size_t i = 0; i < task.number_names.size(); ++i) {
    if (task.number_names[i] == wanted) return NumberId(i);
  }
  return {};
}

}  // namespace roci::planner::temporal_pddl::testing
