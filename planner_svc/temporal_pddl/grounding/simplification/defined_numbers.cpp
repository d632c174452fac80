#include "planner_svc/temporal_pddl/grounding/simplification/defined_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace roci::planner::temporal_pddl::grounding::simplification {

using instantiation::Conjunction, instantiation::GroundAction, instantiation::GroundEffects,
    instantiation::GroundLiteral, instantiation::GroundModel;
using lifted::Symbols;
using task::ExpressionId, task::FunctionId, task::LinearExpression, task::NumberId, task::ObjectId,
    task::PredicateId;

namespace {

template <typename List>
void insert(List& sorted, const typename List::value_type& value) {
  const auto place = std::ranges::lower_bound(sorted, value);
  if (place == sorted.end() || *place != value) sorted.insert(place, value);
}

class DefinedNumbers {
 public:
  DefinedNumbers(GroundModel& model, Symbols& symbols)
      : model_(model), symbols_(symbols), entries_(model.numbers.size(), kNone) {}

  std::vector<UndefinedNumber> run() {
    for (GroundAction& action : model_.actions) ask_in(action);
    for (auto& rule : model_.rules) ask(rule.body, rule.body);
    for (Conjunction& goal : model_.goal) ask(goal, goal);
    for (GroundAction& action : model_.actions) {
      give(action.start_effects);
      give(action.end_effects);
    }
    for (auto& timed : model_.timed) give(timed.effects);
    drop_cancelled();
    return std::move(result_);
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  void ask_in(GroundAction& action) {
    ask(action.at_start, action.at_start);
    ask(action.over_all, action.over_all);
    ask(action.at_end, action.at_end);
    for (const auto& rule : action.duration_rules)
      ask(rule.bound, rule.at_end ? action.at_end : action.at_start);
    ask(action.start_effects, action.at_start);
    ask(action.end_effects, action.at_end);
  }

  void ask(const Conjunction& reader, Conjunction& to) {
    for (const auto& comparison : reader.comparisons) ask(comparison.expression, to);
  }

  void ask(const GroundEffects& effects, Conjunction& to) {
    for (const auto& effect : effects.numeric) {
      ask(effect.expression, to);
      if (!effect.assigns) ask(effect.variable, to);
    }
  }

  void ask(ExpressionId expression, Conjunction& to) {
    for (const auto& term : model_.expressions[expression].terms) ask(term.variable, to);
  }

  void ask(NumberId number, Conjunction& to) {
    if (!std::isnan(model_.initial_numbers[number.index()])) return;
    insert(to.literals, GroundLiteral{entry(number).has_value, false});
  }

  const UndefinedNumber& entry(NumberId number) {
    std::size_t& index = entries_[number.index()];
    if (index == kNone) {
      index = result_.size();
      result_.push_back({number, atom(number), false});
    }
    return result_[index];
  }

  std::uint32_t atom(NumberId number) {
    const FunctionId function(std::size_t{model_.numbers.symbol(number.value)});
    const auto [place, fresh] = predicates_.try_emplace(function);
    if (fresh) place->second = symbols_.add_predicate("has-value:" + symbols_[function].name);
    const auto objects = model_.numbers.objects(number.value);
    const std::uint32_t result =
        model_.atoms.intern(place->second.value, std::vector<ObjectId>(objects.begin(), objects.end()));
    model_.derived.resize(model_.atoms.size(), false);
    return result;
  }

  // Numbers that cancel were asked for, and have done their part.
  void drop_cancelled() {
    const auto is_cancelled = [](const LinearExpression::Term& term) { return term.weight == 0; };
    std::erase_if(model_.metric.expression.terms, is_cancelled);
    std::map<ExpressionId, ExpressionId> without;
    for (std::size_t i = 0; i < model_.expressions.size(); ++i) {
      LinearExpression expression = model_.expressions[ExpressionId(i)];
      if (std::erase_if(expression.terms, is_cancelled) > 0)
        without.emplace(ExpressionId(i), model_.expressions.intern(expression));
    }
    if (without.empty()) return;
    const auto replace = [&](ExpressionId& expression) {
      if (const auto found = without.find(expression); found != without.end()) expression = found->second;
    };
    const auto replace_in = [&](Conjunction& conjunction) {
      for (auto& comparison : conjunction.comparisons) replace(comparison.expression);
      std::ranges::sort(conjunction.comparisons);
      const auto again = std::unique(conjunction.comparisons.begin(), conjunction.comparisons.end());
      conjunction.comparisons.erase(again, conjunction.comparisons.end());
    };
    for (GroundAction& action : model_.actions) {
      for (auto* conjunction : {&action.at_start, &action.over_all, &action.at_end}) replace_in(*conjunction);
      for (auto* effects : {&action.start_effects, &action.end_effects})
        for (auto& effect : effects->numeric) replace(effect.expression);
      for (auto& rule : action.duration_rules) replace(rule.bound);
    }
    for (auto& rule : model_.rules) replace_in(rule.body);
    for (Conjunction& goal : model_.goal) replace_in(goal);
  }

  void give(GroundEffects& effects) {
    for (const auto& effect : effects.numeric) {
      const std::size_t index = entries_[effect.variable.index()];
      if (!effect.assigns || index == kNone) continue;
      result_[index].assigned = true;
      insert(effects.adds, result_[index].has_value);
    }
  }

  GroundModel& model_;
  Symbols& symbols_;
  std::vector<std::size_t> entries_;  // by number: index of result_
  std::map<FunctionId, PredicateId> predicates_;
  std::vector<UndefinedNumber> result_;
};

}  // namespace

std::vector<UndefinedNumber> require_values(GroundModel& model, Symbols& symbols) {
  const bool all_defined =
      std::ranges::none_of(model.initial_numbers, [](double value) { return std::isnan(value); });
  return all_defined ? std::vector<UndefinedNumber>() : DefinedNumbers(model, symbols).run();
}

}  // namespace roci::planner::temporal_pddl::grounding::simplification
