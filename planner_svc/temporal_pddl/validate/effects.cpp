#include "planner_svc/temporal_pddl/validate/effects.hpp"

#include "core/pddl/overloaded.hpp"

namespace roci::planner::temporal_pddl::validate {

namespace {

void unfold_into(const std::vector<pddl::Effect>& effects, Bindings& bindings,
                 std::vector<const pddl::TimedCondition*>& conditions, const Model& model,
                 std::vector<PendingEffect>& out) {
  for (const pddl::Effect& effect : effects) {
    std::visit(pddl::Overloaded{[&](const pddl::When& when) {
                                  conditions.push_back(&when.condition);
                                  unfold_into(when.effects, bindings, conditions, model, out);
                                  conditions.pop_back();
                                },
                                [&](const pddl::ForallEffect& forall) {
                                  model.for_each_choice(forall.variables, bindings, [&] {
                                    unfold_into(forall.effects, bindings, conditions, model, out);
                                    return true;
                                  });
                                },
                                [&](const auto&) {
                                  out.push_back({&effect, bindings, conditions, true});
                                }},
               effect.node);
  }
}

}  // namespace

std::vector<PendingEffect> unfold(const std::vector<pddl::Effect>& effects, const Bindings& bindings,
                                  const Model& model) {
  std::vector<PendingEffect> out;
  Bindings scratch = bindings;
  std::vector<const pddl::TimedCondition*> conditions;
  unfold_into(effects, scratch, conditions, model, out);
  return out;
}

void check_conditions(std::vector<PendingEffect>& effects, pddl::Condition pddl::TimedCondition::*time,
                      Evaluator& evaluator) {
  for (PendingEffect& effect : effects) {
    for (const pddl::TimedCondition* condition : effect.conditions) {
      if (effect.alive) effect.alive = evaluator.holds(condition->*time, effect.bindings);
    }
  }
}

bool collect(const std::vector<PendingEffect>& effects, const Specials& specials, Evaluator& evaluator,
             Changes& changes) {
  bool all_defined = true;
  for (const PendingEffect& pending : effects) {
    if (!pending.alive) continue;
    if (const auto* literal = std::get_if<pddl::Literal>(&pending.effect->node)) {
      (literal->negated ? changes.deleted : changes.added).push_back(pending.bindings.ground(literal->atom));
    } else if (const auto* assignment = std::get_if<pddl::Assignment>(&pending.effect->node)) {
      if (const auto value = evaluator.value(assignment->value, pending.bindings, specials)) {
        changes.numeric.push_back({pending.bindings.ground(assignment->fluent), assignment->op, *value});
      } else {
        all_defined = false;
      }
    }
  }
  return all_defined;
}

}  // namespace roci::planner::temporal_pddl::validate
