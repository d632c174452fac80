#include "planner_svc/temporal_pddl/grounding/instantiate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pddl/printer.hpp"
#include "planner_svc/temporal_pddl/grounding/action_instantiator.hpp"
#include "planner_svc/temporal_pddl/grounding/formula_grounder.hpp"
#include "planner_svc/temporal_pddl/grounding/lowering.hpp"

namespace roci::planner::temporal_pddl {

namespace {

// The atoms that some instance or timed literal may delete.
TupleTable deletable_atoms(const std::vector<LiftedAction>& actions, const World& world,
                           const Reachability& reachability) {
  TupleTable result;
  for (const auto& timed : world.timed_atoms()) {
    if (timed.negated) result.intern(timed.predicate.value, timed.objects);
  }
  for (std::size_t schema = 0; schema < actions.size(); ++schema) {
    const LiftedAction& action = actions[schema];
    const auto& instances = reachability.instances[SchemaId(schema)];
    Binding binding(action.slots);
    for (std::size_t i = 0; i < instances.size(); ++i) {
      std::ranges::copy(instances[i], binding.begin());
      for (const auto* effects : {&action.start_effects, &action.end_effects}) {
        for (const auto& effect : *effects) {
          if (effect.kind != LiftedEffect::Kind::remove) continue;
          for_each_value(effect.quantified, binding, [&] {
            result.intern(effect.atom.predicate.value, objects_of(effect.atom.arguments, binding));
          });
        }
      }
    }
  }
  return result;
}

Duration from_seconds(double seconds) { return Duration(std::llround(seconds * 1e6)); }

void add_timed(const pddl::Problem& problem, const World& world, const Reachability& reachability,
               FormulaGrounder& formulas, GroundModel& model) {
  const auto change_at = [&](Duration time) -> GroundEffects& {
    auto place = std::ranges::lower_bound(model.timed, time, {}, &TimedChange::time);
    if (place == model.timed.end() || place->time != time) place = model.timed.insert(place, {time, {}});
    return place->effects;
  };
  for (const auto& timed : world.timed_atoms()) {
    const auto atom = reachability.atoms.find(timed.predicate.value, timed.objects);
    if (!atom || !reachability.reached[*atom]) continue;
    auto& effects = change_at(from_seconds(timed.time));
    (timed.negated ? effects.deletes : effects.adds).push_back(*atom);
  }
  for (const auto& timed : problem.timed_values) {
    std::vector<ObjectId> objects;
    for (const auto& term : timed.fluent.arguments) objects.push_back(world.symbols().object(term.name));
    const NumberId number = formulas.number(world.symbols().function(timed.fluent.symbol), objects);
    LinearExpression value;
    value.constant = timed.value;
    change_at(from_seconds(timed.time)).numeric.push_back({number, true, formulas.intern(value)});
  }
}

void ground_goal(const pddl::Problem& problem, FormulaGrounder& formulas, GroundModel& model) {
  const auto ground = [&](const pddl::Condition& condition) {
    std::uint32_t slots = 0;
    const LiftedFormula formula = lower_goal(condition, problem.file, formulas.world().symbols(), slots);
    Binding binding(slots);
    return formulas.ground(formula, binding);
  };
  model.goal = ground(problem.goal);
  const auto* conjunction = std::get_if<pddl::And>(&problem.goal.node);
  if (!model.goal.empty() || !conjunction) return;
  for (const auto& part : conjunction->parts) {
    if (ground(part).empty()) model.unreachable_goals.push_back(pddl::print(part));
  }
}

void set_initial(const pddl::Problem& problem, const World& world, const Reachability& reachability,
                 GroundModel& model) {
  const TupleTable& initial = world.initial_atoms();
  for (std::uint32_t i = 0; i < initial.size(); ++i) {
    if (world.is_static(PredicateId(initial.symbol(i)))) continue;
    model.initial_atoms.push_back(*reachability.atoms.find(initial.symbol(i), initial.objects(i)));
  }
  model.initial_numbers.assign(model.numbers.size(), std::numeric_limits<double>::quiet_NaN());
  for (const auto& value : problem.values) {
    std::vector<ObjectId> objects;
    for (const auto& term : value.fluent.arguments) objects.push_back(world.symbols().object(term.name));
    const auto number = model.numbers.find(world.symbols().function(value.fluent.symbol).value, objects);
    if (number) model.initial_numbers[*number] = value.value;
  }
}

}  // namespace

GroundModel instantiate(const pddl::Domain& domain, const pddl::Problem& problem,
                        const std::vector<LiftedAction>& actions, const World& world,
                        Reachability reachability, Watch& watch) {
  GroundModel model;
  const TupleTable deletable = deletable_atoms(actions, world, reachability);
  FormulaGrounder formulas(world, reachability, deletable, model.numbers, model.expressions, domain.file);
  ActionInstantiator instantiator(formulas);
  for (std::size_t schema = 0; schema < actions.size(); ++schema) {
    const auto& instances = reachability.instances[SchemaId(schema)];
    Binding binding(actions[schema].slots);
    for (std::size_t i = 0; i < instances.size(); ++i) {
      watch.step();
      std::ranges::copy(instances[i], binding.begin());
      instantiator.instantiate(SchemaId(schema), actions[schema], binding, model.actions);
    }
  }
  FormulaGrounder goals(world, reachability, deletable, model.numbers, model.expressions, problem.file);
  ground_goal(problem, goals, model);
  add_timed(problem, world, reachability, formulas, model);
  set_initial(problem, world, reachability, model);
  model.atoms = std::move(reachability.atoms);
  return model;
}

}  // namespace roci::planner::temporal_pddl
