#include "planner_svc/temporal_pddl/grounding/instantiation/instantiate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pddl/printer.hpp"
#include "planner_svc/temporal_pddl/grounding/instantiation/action_instantiator.hpp"
#include "planner_svc/temporal_pddl/grounding/instantiation/formula_grounder.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/lowering.hpp"

namespace roci::planner::temporal_pddl::grounding::instantiation {

using call::SearchLimits;
using lifted::Binding, lifted::LiftedAction, lifted::LiftedEffect, lifted::LiftedExpression,
    lifted::LiftedFormula, lifted::StaticModel, lifted::TupleTable, lifted::for_each_value,
    lifted::objects_of;
using reachability::Reachability;
using task::IdVector, task::LinearExpression, task::NumberId, task::ObjectId, task::PredicateId,
    task::SchemaId;
using temporal::Duration;

namespace {

void note_negated(const LiftedFormula& formula, IdVector<PredicateId, bool>& negated) {
  if (formula.kind == LiftedFormula::Kind::not_atom) negated[formula.atom.predicate] = true;
  for (const LiftedFormula& part : formula.parts) note_negated(part, negated);
}

void note_read(const LiftedFormula& formula, IdVector<PredicateId, bool>& read) {
  if (formula.kind == LiftedFormula::Kind::atom) read[formula.atom.predicate] = true;
  for (const LiftedFormula& part : formula.parts) note_read(part, read);
}

// Marks the predicates in conditions at a time point: `negated` ones that a condition may want to be false,
// and `read` ones that stand in a condition with alternatives or of an effect.
struct UsesOfPredicates {
  IdVector<PredicateId, bool> negated, read;
};

UsesOfPredicates uses_of_predicates(const std::vector<LiftedAction>& actions, std::size_t predicates) {
  UsesOfPredicates result{IdVector<PredicateId, bool>(predicates, false),
                          IdVector<PredicateId, bool>(predicates, false)};
  for (const LiftedAction& action : actions) {
    for (const auto* condition : {&action.at_start, &action.at_end}) {
      note_negated(*condition, result.negated);
      if (has_choice(*condition)) note_read(*condition, result.read);
    }
    for (const auto* effects : {&action.start_effects, &action.end_effects}) {
      for (const LiftedEffect& effect : *effects) {
        for (const auto* condition : {&effect.start_condition, &effect.start_otherwise, &effect.end_condition,
                                      &effect.end_otherwise}) {
          note_negated(*condition, result.negated);
          note_read(*condition, result.read);
        }
      }
    }
  }
  return result;
}

// Returns those atoms that effects of instances and timed literals are about and that hold at first or are
// never reached. Of the latter, those that a condition may want to be false count as reached from now on;
// those that one only reads are known.
TupleTable touched_atoms(const std::vector<LiftedAction>& actions, const StaticModel& static_model,
                         Reachability& reachability) {
  TupleTable result;
  const UsesOfPredicates uses = uses_of_predicates(actions, static_model.symbols().predicates());
  const auto touch = [&](PredicateId predicate, std::span<const ObjectId> objects, bool removes) {
    if (static_model.holds_initially(predicate, objects)) {
      result.intern(predicate.value, objects);
      return;
    }
    if (!removes || (!uses.negated[predicate] && !uses.read[predicate])) return;
    const std::uint32_t atom = reachability.atoms.intern(predicate.value, objects);
    if (atom >= reachability.reached.size()) reachability.reached.resize(reachability.atoms.size(), false);
    if (uses.negated[predicate]) reachability.reached[atom] = true;
  };
  for (const auto& timed : static_model.timed_atoms()) touch(timed.predicate, timed.objects, timed.negated);
  for (std::size_t schema = 0; schema < actions.size(); ++schema) {
    const LiftedAction& action = actions[schema];
    const auto& instances = reachability.instances[SchemaId(schema)];
    Binding binding(action.slots);
    for (std::size_t i = 0; i < instances.size(); ++i) {
      std::ranges::copy(instances[i], binding.begin());
      for (const auto* effects : {&action.start_effects, &action.end_effects}) {
        for (const auto& effect : *effects) {
          if (effect.kind == LiftedEffect::Kind::numeric) continue;
          for_each_value(effect.quantified, binding, [&] {
            touch(effect.atom.predicate, objects_of(effect.atom.arguments, binding),
                  effect.kind == LiftedEffect::Kind::remove);
          });
        }
      }
    }
  }
  return result;
}

// No plan can tell a time after kLatest, so that all of these count as that one.
Duration from_seconds(double seconds) {
  constexpr double kLatest = 1e12;
  return Duration(std::llround(std::min(seconds, kLatest) * 1e6));
}

void add_timed(const pddl::Problem& problem, const StaticModel& static_model,
               const Reachability& reachability, FormulaGrounder& formulas, GroundModel& model) {
  const auto change_at = [&](Duration time) -> GroundEffects& {
    auto place = std::ranges::lower_bound(model.timed, time, {}, &TimedChange::time);
    if (place == model.timed.end() || place->time != time) place = model.timed.insert(place, {time, {}});
    return place->effects;
  };
  for (const auto& timed : static_model.timed_atoms()) {
    const auto atom = reachability.atoms.find(timed.predicate.value, timed.objects);
    if (!atom || !reachability.reached[*atom]) continue;
    auto& effects = change_at(from_seconds(timed.time));
    (timed.negated ? effects.deletes : effects.adds).push_back(*atom);
  }
  for (const auto& timed : problem.timed_values) {
    std::vector<ObjectId> objects;
    for (const auto& term : timed.fluent.arguments)
      objects.push_back(static_model.symbols().object(term.name));
    const NumberId number = formulas.number(static_model.symbols().function(timed.fluent.symbol), objects);
    LinearExpression value;
    value.constant = timed.value;
    change_at(from_seconds(timed.time)).numeric.push_back({number, true, formulas.intern(value)});
  }
}

void add_rules(const LiftedAction& rule, Binding& binding, FormulaGrounder& formulas, GroundModel& model) {
  const GroundLiteral head{*formulas.reached_atom(rule.start_effects.front().atom, binding), false};
  for (auto& body : formulas.ground(rule.at_start, binding))
    model.rules.push_back({head, *rule.layer, std::move(body)});
}

void ground_goal(const pddl::Problem& problem, FormulaGrounder& formulas, GroundModel& model) {
  const auto ground = [&](const pddl::Condition& condition) {
    std::uint32_t slots = 0;
    const LiftedFormula formula =
        lower_goal(condition, problem.file, formulas.static_model().symbols(), slots);
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

void ground_metric(const pddl::Metric& source, FormulaGrounder& formulas, const std::string& file,
                   GroundModel& model) {
  const LiftedExpression lifted = lower_metric(source.expression, file, formulas.static_model().symbols());
  const auto value = formulas.linear(lifted, {});
  if (!value) {
    formulas.fail(source.where, "the metric depends on a constant without a value",
                  "give each fluent in it an initial value");
  }
  model.metric.maximized = source.sense == pddl::Metric::Sense::maximize;
  model.metric.expression = scaled(*value, model.metric.maximized ? -1 : 1);
}

void set_initial(const pddl::Problem& problem, const StaticModel& static_model,
                 const Reachability& reachability, GroundModel& model) {
  const TupleTable& initial = static_model.initial_atoms();
  for (std::uint32_t i = 0; i < initial.size(); ++i) {
    if (static_model.is_static(PredicateId(initial.symbol(i)))) continue;
    model.initial_atoms.push_back(*reachability.atoms.find(initial.symbol(i), initial.objects(i)));
  }
  model.initial_numbers.assign(model.numbers.size(), std::numeric_limits<double>::quiet_NaN());
  for (const auto& value : problem.values) {
    std::vector<ObjectId> objects;
    for (const auto& term : value.fluent.arguments)
      objects.push_back(static_model.symbols().object(term.name));
    const auto number =
        model.numbers.find(static_model.symbols().function(value.fluent.symbol).value, objects);
    if (number) model.initial_numbers[*number] = value.value;
  }
  const auto total_cost = static_model.symbols().total_cost();
  const auto counted = total_cost ? model.numbers.find(total_cost->value, {}) : std::nullopt;
  if (counted && std::isnan(model.initial_numbers[*counted])) model.initial_numbers[*counted] = 0;
}

std::size_t bytes_of(const Conjunction& conjunction) {
  return conjunction.literals.heap_bytes() + conjunction.comparisons.heap_bytes();
}

std::size_t bytes_of(const GroundEffects& effects) {
  return effects.adds.heap_bytes() + effects.deletes.heap_bytes() + effects.numeric.heap_bytes() +
         effects.resets.heap_bytes();
}

// Returns how many actions there are without alternatives, which make more of them.
std::size_t planned_actions(const std::vector<LiftedAction>& actions, const Reachability& reachability) {
  std::size_t result = 0;
  for (std::size_t schema = 0; schema < actions.size(); ++schema) {
    if (!actions[schema].layer) result += reachability.instances[SchemaId(schema)].size();
  }
  return result;
}

}  // namespace

std::size_t heap_bytes(const GroundAction& action) {
  return action.arguments.heap_bytes() + action.duration_rules.heap_bytes() + bytes_of(action.at_start) +
         bytes_of(action.over_all) + bytes_of(action.at_end) + bytes_of(action.start_effects) +
         bytes_of(action.end_effects);
}

GroundModel instantiate(const pddl::Domain& domain, const pddl::Problem& problem,
                        const std::vector<LiftedAction>& actions, const StaticModel& static_model,
                        Reachability reachability, SearchLimits& limits) {
  GroundModel model;
  const TupleTable touched = touched_atoms(actions, static_model, reachability);
  FormulaGrounder formulas(static_model, reachability, touched, model.numbers, model.expressions, problem,
                           domain.file);
  ActionInstantiator instantiator(formulas);
  std::size_t counted = 0, lists = 0;
  const std::size_t planned = planned_actions(actions, reachability);
  limits.require_room(planned * sizeof(GroundAction));
  model.actions.reserve(planned);
  std::size_t bytes = reachability.atoms.bytes();
  for (std::size_t schema = 0; schema < actions.size(); ++schema) {
    const auto& instances = reachability.instances[SchemaId(schema)];
    Binding binding(actions[schema].slots);
    for (std::size_t i = 0; i < instances.size(); ++i) {
      limits.step();
      std::ranges::copy(instances[i], binding.begin());
      if (actions[schema].layer) {
        add_rules(actions[schema], binding, formulas, model);
      } else {
        instantiator.instantiate(SchemaId(schema), actions[schema], binding, model);
      }
      for (; lists < model.read_sets.size(); ++lists)
        bytes += model.read_sets[lists].capacity() * sizeof(ReadVariable);
      for (; counted < model.actions.size(); ++counted) bytes += heap_bytes(model.actions[counted]);
      limits.memory(bytes + instances.bytes() + model.actions.capacity() * sizeof(GroundAction));
    }
  }
  FormulaGrounder goals(static_model, reachability, touched, model.numbers, model.expressions, problem,
                        problem.file);
  ground_goal(problem, goals, model);
  if (problem.metric) ground_metric(*problem.metric, goals, problem.file, model);
  add_timed(problem, static_model, reachability, formulas, model);
  set_initial(problem, static_model, reachability, model);
  model.atoms = std::move(reachability.atoms);
  for (std::uint32_t atom = 0; atom < model.atoms.size(); ++atom)
    model.derived.push_back(static_model.is_derived(PredicateId(std::size_t{model.atoms.symbol(atom)})));
  return model;
}

}  // namespace roci::planner::temporal_pddl::grounding::instantiation
