#include "planner_svc/temporal_pddl/grounding/simplification/relevance.hpp"

#include <utility>
#include <vector>

namespace roci::planner::temporal_pddl::grounding::simplification {

using instantiation::Conjunction, instantiation::GroundEffects, instantiation::GroundModel,
    instantiation::GroundRule, instantiation::ReadVariable, instantiation::TimedChange;
using task::ExpressionId, task::NumericEffect;

namespace {

template <typename Visit>
void for_each_effects(GroundModel& model, const Visit& visit) {
  for (auto& action : model.actions) {
    visit(action.start_effects);
    visit(action.end_effects);
  }
  for (auto& timed : model.timed) visit(timed.effects);
}

template <typename Visit>
void for_each_condition(const GroundModel& model, const Visit& visit) {
  for (const auto& action : model.actions) {
    visit(action.at_start);
    visit(action.over_all);
    visit(action.at_end);
  }
  for (const auto& rule : model.rules) visit(rule.body);
  for (const auto& goal : model.goal) visit(goal);
}

// Drops rules whose heads nothing asks for, directly or through other rules.
void drop_irrelevant_rules(GroundModel& model) {
  std::vector<bool> asked(model.atoms.size(), false);
  const auto ask = [&](const Conjunction& conjunction) {
    for (const auto literal : conjunction.literals) asked[literal.atom] = true;
  };
  const std::vector<GroundRule> rules = std::exchange(model.rules, {});
  for_each_condition(model, ask);
  std::vector<bool> kept(rules.size(), false);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = rules.size(); i-- > 0;) {
      if (kept[i] || !asked[rules[i].head.atom]) continue;
      kept[i] = changed = true;
      ask(rules[i].body);
    }
  }
  for (std::size_t i = 0; i < rules.size(); ++i) {
    if (kept[i]) model.rules.push_back(rules[i]);
  }
}

std::vector<bool> relevant_numbers(GroundModel& model) {
  std::vector<bool> relevant(model.numbers.size(), false);
  const auto mark = [&](ExpressionId expression) {
    bool changed = false;
    for (const auto& term : model.expressions[expression].terms) {
      changed = changed || !relevant[term.variable.index()];
      relevant[term.variable.index()] = true;
    }
    return changed;
  };
  for_each_condition(model, [&](const Conjunction& conjunction) {
    for (const auto& comparison : conjunction.comparisons) mark(comparison.expression);
  });
  for (const auto& action : model.actions) {
    for (const auto& rule : action.duration_rules) mark(rule.bound);
    for (const ReadVariable& read : model.read_set_of(action)) {
      if (read.is_number) relevant[read.index] = true;
    }
  }
  const auto close = [&] {
    for (bool changed = true; changed;) {
      changed = false;
      for_each_effects(model, [&](GroundEffects& effects) {
        for (const auto& effect : effects.numeric) {
          if (relevant[effect.variable.index()]) changed = mark(effect.expression) || changed;
        }
      });
    }
  };
  close();
  model.only_metric_asks.assign(relevant.size(), false);
  for (const auto& term : model.metric.expression.terms) {
    model.only_metric_asks[term.variable.index()] = !relevant[term.variable.index()];
    relevant[term.variable.index()] = true;
  }
  close();
  for_each_effects(model, [&](GroundEffects& effects) {
    for (const auto& effect : effects.numeric) {
      if (effect.assigns) model.only_metric_asks[effect.variable.index()] = false;
      for (const auto& term : model.expressions[effect.expression].terms)
        model.only_metric_asks[term.variable.index()] = false;
    }
  });
  return relevant;
}

}  // namespace

void drop_irrelevant_effects(GroundModel& model) {
  drop_irrelevant_rules(model);
  const std::size_t atoms = model.atoms.size();
  std::vector<bool> read(atoms, false), added(atoms, false), deleted(atoms, false);
  for_each_condition(model, [&](const Conjunction& conjunction) {
    for (const auto literal : conjunction.literals) read[literal.atom] = true;
  });
  for (const auto& action : model.actions) {
    for (const ReadVariable& variable : model.read_set_of(action)) {
      if (!variable.is_number) read[variable.index] = true;
    }
  }
  for_each_effects(model, [&](GroundEffects& effects) {
    for (const std::uint32_t atom : effects.adds) added[atom] = true;
    for (const std::uint32_t atom : effects.deletes) deleted[atom] = true;
    for (const std::uint32_t atom : effects.resets) deleted[atom] = true;
  });
  const std::vector<bool> relevant = relevant_numbers(model);
  const auto irrelevant_atom = [&](std::uint32_t atom) {
    return !read[atom] && !(added[atom] && deleted[atom]);
  };
  for_each_effects(model, [&](GroundEffects& effects) {
    erase_if(effects.adds, irrelevant_atom);
    erase_if(effects.deletes, irrelevant_atom);
    erase_if(effects.resets, irrelevant_atom);
    erase_if(effects.numeric,
             [&](const NumericEffect& effect) { return !relevant[effect.variable.index()]; });
  });
  std::erase_if(model.timed, [](const TimedChange& timed) {
    return timed.effects.adds.empty() && timed.effects.deletes.empty() && timed.effects.numeric.empty();
  });
}

}  // namespace roci::planner::temporal_pddl::grounding::simplification
