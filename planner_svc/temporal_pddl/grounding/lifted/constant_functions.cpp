#include "planner_svc/temporal_pddl/grounding/lifted/constant_functions.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

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

// The tuples of a function, which are many: they are counted and made one by one, never listed.
std::size_t number_of_tuples(const std::vector<std::vector<ObjectId>>& domains) {
  std::size_t count = 1;
  for (const auto& domain : domains) count *= domain.size();
  return count;
}

// Gives tuple `index` of the product, of which the last position runs fastest.
void make_tuple(const std::vector<std::vector<ObjectId>>& domains, std::size_t index,
                std::vector<ObjectId>& tuple) {
  tuple.resize(domains.size());
  for (std::size_t position = domains.size(); position-- > 0;) {
    tuple[position] = domains[position][index % domains[position].size()];
    index /= domains[position].size();
  }
}

std::size_t external_tuples(const Symbols& symbols) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < symbols.functions(); ++i) {
    const FunctionSymbol& symbol = symbols[FunctionId(i)];
    if (!symbol.module.empty()) count += number_of_tuples(symbol.parameters);
  }
  return count;
}

std::vector<FunctionCall> calls_of_all_tuples(const FunctionSymbol& symbol, const Symbols& symbols) {
  const std::size_t count = number_of_tuples(symbol.parameters);
  std::vector<FunctionCall> calls;
  calls.reserve(count);
  std::vector<ObjectId> tuple;
  for (std::size_t i = 0; i < count; ++i) {
    make_tuple(symbol.parameters, i, tuple);
    FunctionCall& call = calls.emplace_back();
    call.module = symbol.module;
    call.function = symbol.name;
    call.arguments.reserve(tuple.size());
    for (const ObjectId object : tuple) call.arguments.push_back(symbols.name(object));
  }
  return calls;
}

[[noreturn]] void refuse(const FunctionUse& use, const Symbols& symbols, const FunctionSymbol& symbol) {
  throw ModelFailure(Verdict::function_unavailable,
                     pddl::Diagnostic{symbols.domain_file(), symbol.declared, fault_of(use), remedy_of(use)});
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
                                      const Symbols& symbols, std::vector<FunctionUse>* used) {
  if (used)
    used->reserve(used->size() + external_tuples(symbols));  // one that grows is there twice meanwhile
  std::vector<ObjectId> tuple;
  for (std::size_t i = 0; i < symbols.functions(); ++i) {
    const FunctionId function(i);
    const FunctionSymbol& symbol = symbols[function];
    if (symbol.module.empty()) continue;
    external_[function] = true;
    auto calls = calls_of_all_tuples(symbol, symbols);
    auto answers = source.evaluate(calls, cancelled);
    if (cancelled())
      throw PlanningFailure(Verdict::cancelled, "cancelled while waiting for external functions");
    if (answers.size() != calls.size()) answers.assign(calls.size(), FunctionValue{});
    std::optional<FunctionUse> unusable;
    for (std::size_t k = 0; k < calls.size(); ++k) {
      FunctionValue& answer = answers[k];
      if (answer.outcome == FunctionOutcome::value && !std::isfinite(answer.value)) {
        answer.outcome = FunctionOutcome::not_a_number;
      }
      make_tuple(symbol.parameters, k, tuple);
      if (answer.outcome == FunctionOutcome::value) define(function, tuple, answer.value);
      if (!unusable && !is_usable(answer)) unusable = FunctionUse{calls[k], answer};
      if (used) used->push_back({std::move(calls[k]), std::move(answer)});
    }
    if (unusable) refuse(*unusable, symbols, symbol);
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
