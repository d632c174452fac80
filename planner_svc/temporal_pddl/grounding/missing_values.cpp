#include "planner_svc/temporal_pddl/grounding/missing_values.hpp"

#include <algorithm>
#include <cmath>

#include "planner_svc/temporal_pddl/grounding/simplification/relaxed_pruning.hpp"

namespace roci::planner::temporal_pddl::grounding {

using lifted::Argument, lifted::Binding, lifted::LiftedAction, lifted::LiftedEffect, lifted::LiftedExpression,
    lifted::LiftedFormula, lifted::objects_of;
using simplification::literal_index;
using task::FunctionId, task::PredicateId;

std::vector<std::string> MissingValues::of(const LiftedAction& action,
                                           const std::vector<const LiftedFormula*>& conditions,
                                           const Binding& binding, const std::string& by) const {
  std::vector<std::string> told;
  for (const LiftedFormula* condition : conditions) {
    if (condition->kind != LiftedFormula::Kind::comparison) continue;
    for (const LiftedExpression& side : condition->sides) collect(side, by, binding, told);
  }
  for (const auto& rule : action.duration) collect(rule.bound, by, binding, told);
  for (const auto* effects : {&action.start_effects, &action.end_effects}) {
    for (const LiftedEffect& effect : *effects) {
      if (effect.kind != LiftedEffect::Kind::numeric || effect.conditional()) continue;
      collect(effect.value, by, binding, told);
      if (effect.op != pddl::AssignmentOperator::assign)
        collect(effect.function, effect.atom.arguments, by, binding, told);
    }
  }
  return told;
}

void MissingValues::collect(const LiftedExpression& expression, const std::string& by, const Binding& binding,
                            std::vector<std::string>& told) const {
  if (expression.kind == LiftedExpression::Kind::function)
    collect(expression.function, expression.arguments, by, binding, told);
  for (const LiftedExpression& operand : expression.operands) collect(operand, by, binding, told);
}

void MissingValues::collect(FunctionId function, const std::vector<Argument>& arguments,
                            const std::string& by, const Binding& binding,
                            std::vector<std::string>& told) const {
  const auto objects = objects_of(arguments, binding);
  const Pattern pattern{PredicateId(), {objects.begin(), objects.end()}};
  const std::string fluent = patterns_.text(known_.symbols[function].name, pattern.objects);
  const std::string text =
      by + " reads " + fluent + ", which has no value: give it one in :init, (= " + fluent + " …)";
  if (known_.static_model.constants().is_constant(function)) {
    if (!pattern.is_ground() || known_.static_model.constants().value(function, pattern.objects)) return;
    told.push_back(
        known_.symbols[function].module.empty() ? text : by + " reads " + fluent + ", which is unreachable");
    return;
  }
  for (std::uint32_t i = 0; i < known_.model.numbers.size(); ++i) {
    if (known_.model.numbers.symbol(i) != function.value || !pattern.fits(known_.model.numbers.objects(i)))
      continue;
    if (!std::isnan(known_.model.initial_numbers[i]) || is_assigned(i)) return;
  }
  told.push_back(text);
}

// The atom that says that the number has a value was made by simplification/defined_numbers.
bool MissingValues::is_assigned(std::uint32_t number) const {
  const std::string name =
      "has-value:" + known_.symbols[FunctionId(std::size_t{known_.model.numbers.symbol(number)})].name;
  for (std::uint32_t i = 0; i < known_.model.atoms.size(); ++i) {
    const PredicateId predicate(std::size_t{known_.model.atoms.symbol(i)});
    if (predicate.index() < known_.symbols.predicates() && known_.symbols.name(predicate) == name &&
        std::ranges::equal(known_.model.atoms.objects(i), known_.model.numbers.objects(number)))
      return known_.reached[literal_index({i, false})];
  }
  return true;  // nothing reads it
}

}  // namespace roci::planner::temporal_pddl::grounding
