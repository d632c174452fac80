#include "planner_svc/temporal_pddl/grounding/lifted/constant_functions.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "planner_svc/engine/function_words.hpp"
#include "planner_svc/temporal_pddl/call/planning_failure.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/model_failure.hpp"

namespace roci::planner::temporal_pddl::grounding::lifted {

using call::PlanningFailure;
using engine::FunctionCall, engine::FunctionOutcome, engine::FunctionSource, engine::FunctionUse,
    engine::FunctionValue;
using task::FunctionId;
using task::ObjectId;
using temporal::Verdict;

namespace {

// Returns all tuples of the product, the last position running fastest.
std::vector<std::vector<ObjectId>> all_tuples(const std::vector<std::vector<ObjectId>>& domains) {
  std::vector<std::vector<ObjectId>> tuples{{}};
  for (const auto& domain : domains) {
    std::vector<std::vector<ObjectId>> longer;
    longer.reserve(tuples.size() * domain.size());
    for (const auto& tuple : tuples) {
      for (const ObjectId object : domain) {
        longer.push_back(tuple);
        longer.back().push_back(object);
      }
    }
    tuples = std::move(longer);
  }
  return tuples;
}

void require_usable(const FunctionUse& use, const Symbols& symbols, const FunctionSymbol& symbol) {
  const std::string fault = fault_of(use);
  if (fault.empty()) return;
  throw ModelFailure(Verdict::function_unavailable,
                     pddl::Diagnostic{symbols.domain_file(), symbol.declared, fault, remedy_of(use)});
}

}  // namespace

ConstantFunctions::ConstantFunctions(const pddl::Problem& problem, const std::vector<LiftedAction>& actions,
                                     const Symbols& symbols)
    : constant_(symbols.functions(), true),
      external_(symbols.functions(), false),
      missed_(symbols.functions(), std::nullopt) {
  for (const auto& action : actions) {
    for (const auto* effects : {&action.start_effects, &action.end_effects}) {
      for (const auto& effect : *effects) {
        if (effect.kind == LiftedEffect::Kind::numeric) constant_[effect.function] = false;
      }
    }
  }
  for (const auto& timed : problem.timed_values) constant_[symbols.function(timed.fluent.symbol)] = false;
  for (const auto& initial : problem.values) {
    const FunctionId function = symbols.function(initial.fluent.symbol);
    if (!constant_[function]) continue;
    std::vector<ObjectId> objects;
    for (const auto& term : initial.fluent.arguments) objects.push_back(symbols.object(term.name));
    define(function, objects, initial.value);
  }
  const auto total_cost = symbols.total_cost();
  if (total_cost && constant_[*total_cost] && !tuples_.find(total_cost->value, {}))
    define(*total_cost, {}, 0);
}

void ConstantFunctions::load_external(FunctionSource& source, const std::function<bool()>& cancelled,
                                      const Symbols& symbols, std::vector<FunctionUse>& used) {
  for (std::size_t i = 0; i < symbols.functions(); ++i) {
    const FunctionId function(i);
    const FunctionSymbol& symbol = symbols[function];
    if (symbol.module.empty()) continue;
    external_[function] = true;
    const auto tuples = all_tuples(symbol.parameters);
    std::vector<FunctionCall> calls;
    for (const auto& tuple : tuples) {
      FunctionCall call{symbol.module, symbol.name, {}};
      for (const ObjectId object : tuple) call.arguments.push_back(symbols.name(object));
      calls.push_back(std::move(call));
    }
    auto answers = source.evaluate(calls, cancelled);
    if (cancelled())
      throw PlanningFailure(Verdict::cancelled, "cancelled while waiting for external functions");
    if (answers.size() != calls.size()) answers.assign(calls.size(), FunctionValue{});
    for (std::size_t k = 0; k < calls.size(); ++k) {
      FunctionValue& answer = answers[k];
      if (answer.outcome == FunctionOutcome::value && !std::isfinite(answer.value)) {
        answer.outcome = FunctionOutcome::not_a_number;
      }
      used.push_back({calls[k], answer});
      if (answer.outcome == FunctionOutcome::value) define(function, tuples[k], answer.value);
    }
    for (std::size_t k = 0; k < calls.size(); ++k) require_usable({calls[k], answers[k]}, symbols, symbol);
  }
}

std::optional<double> ConstantFunctions::value(FunctionId function, std::span<const ObjectId> objects) const {
  const auto tuple = tuples_.find(function.value, objects);
  if (tuple) return values_[*tuple];
  // A way from a thing to itself hardly ever has a value, and nobody misses it.
  const bool one_thing =
      objects.size() > 1 && std::ranges::count(objects, objects.front()) == std::ssize(objects);
  if (!external_[function] && !missed_[function] && !one_thing)
    missed_[function].emplace(objects.begin(), objects.end());
  return std::nullopt;
}

void ConstantFunctions::define(FunctionId function, std::span<const ObjectId> objects, double value) {
  const std::uint32_t tuple = tuples_.intern(function.value, objects);
  values_.resize(tuples_.size());
  values_[tuple] = value;
}

}  // namespace roci::planner::temporal_pddl::grounding::lifted
