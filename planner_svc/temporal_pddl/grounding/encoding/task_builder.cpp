#include "planner_svc/temporal_pddl/grounding/encoding/task_builder.hpp"

#include <algorithm>
#include <array>

#include "planner_svc/temporal_pddl/grounding/encoding/variable_cover.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/derived_support.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/relaxed_pruning.hpp"

namespace roci::planner::temporal_pddl::grounding::encoding {

using call::SearchLimits;
using instantiation::ActionWindows, instantiation::Conjunction, instantiation::GroundAction,
    instantiation::GroundEffects, instantiation::GroundLiteral, instantiation::GroundModel,
    instantiation::GroundRule, instantiation::ReadVariable;
using invariants::Compression, invariants::MutexGroup, invariants::only_goals_ask;
using lifted::LiftedAction, lifted::Symbols;
using simplification::DerivedSupport, simplification::Support, simplification::literal_index;
using task::Action, task::ActionId, task::DerivationRule, task::DerivedFacts, task::ExpressionId,
    task::FactId, task::FactName, task::FunctionId, task::IdVector, task::NumberId, task::NumericEffect,
    task::ObjectId, task::PredicateId, task::Snap, task::SnapId, task::SnapKind, task::StateLayout,
    task::Task, task::TimeWindow, task::TimeWindows, task::VariableId, task::is_any_time;

namespace {

class Builder {
 public:
  Builder(const GroundModel& model, const Symbols& symbols)
      : model_(model),
        symbols_(symbols),
        facts_(2 * model.atoms.size()),
        unordered_(only_goals_ask(model)),
        support_(model) {}

  Task run(const std::vector<LiftedAction>& schemas, const std::vector<MutexGroup>& groups,
           const std::vector<Compression>& compression, SearchLimits& limits) {
    name_symbols(schemas);
    number_facts();
    task_.expressions = model_.expressions;
    task_.metric = model_.metric;
    reserve();
    for (std::size_t i = 0; i < model_.actions.size(); ++i) {
      add_action(model_.actions[i], compression[i]);
      limits.step();
      limits.memory_on_top(task_.bytes());
    }
    for (const auto& timed : model_.timed) {
      task_.timed_steps.push_back(
          {add_snap({SnapKind::timed_literal, ActionId()}, {}, timed.effects, {{timed.time, timed.time}}, {}),
           timed.time});
    }
    for (const auto& goal : model_.goal) {
      task_.goals.push_back({facts_of(goal.literals), {goal.comparisons.begin(), goal.comparisons.end()}});
      task_.derived_goal_reads.push_back(derived_reads(goal));
    }
    add_rules();
    lay_out(groups, limits);
    for_each_snap_list([](auto& lists) { lists.shrink(); });
    for_each_action_list([](auto& lists) { lists.shrink(); });
    return std::move(task_);
  }

 private:
  template <typename Visit>
  void for_each_snap_list(const Visit& visit) {
    visit(task_.conditions);
    visit(task_.comparisons);
    visit(task_.adds);
    visit(task_.deletes);
    visit(task_.numeric_effects);
    visit(task_.reads);
    visit(task_.writes);
    visit(task_.windows);
  }

  template <typename Visit>
  void for_each_action_list(const Visit& visit) {
    visit(task_.action_arguments);
    visit(task_.invariants);
    visit(task_.numeric_invariants);
    visit(task_.invariant_reads);
    visit(task_.span_windows);
    visit(task_.duration_rules);
    visit(task_.derived_invariant_reads);
    visit(task_.absent_for_compression);
  }

  // There may be a million actions: growing by doubling would take up to twice as much.
  void reserve() {
    const std::size_t actions = model_.actions.size();
    std::size_t snaps = actions + model_.timed.size() + model_.rules.size() + negations_.size();
    for (const GroundAction& action : model_.actions) snaps += action.durative ? 1 : 0;
    task_.actions.reserve(actions);
    task_.snaps.reserve(snaps);
    for_each_action_list([&](auto& lists) { lists.reserve(actions); });
    for_each_snap_list([&](auto& lists) { lists.reserve(snaps); });
  }

  void name_symbols(const std::vector<LiftedAction>& schemas) {
    for (std::size_t i = 0; i < symbols_.objects(); ++i) task_.objects.push_back(symbols_.name(ObjectId(i)));
    for (std::size_t i = 0; i < symbols_.predicates(); ++i)
      task_.predicates.push_back(symbols_.name(PredicateId(i)));
    for (const auto& schema : schemas) task_.schemas.push_back(schema.name);
    for (std::uint32_t i = 0; i < model_.numbers.size(); ++i) {
      std::string text = "(" + symbols_[FunctionId(std::size_t{model_.numbers.symbol(i)})].name;
      for (const ObjectId object : model_.numbers.objects(i)) text += " " + symbols_.name(object);
      task_.number_names.push_back(text + ")");
    }
  }

  // An atom gets a fact if it is in a condition, an effect or a goal; its negation gets one if a condition or
  // goal asks for it.
  void number_facts() {
    std::vector<bool> atom_needed(model_.atoms.size(), false), negation_needed(model_.atoms.size(), false);
    const auto need_literal = [&](GroundLiteral literal) {
      atom_needed[literal.atom] = true;
      if (literal.negated) negation_needed[literal.atom] = true;
    };
    std::vector<bool> supported(facts_.size(), false);
    const auto need = [&](const Conjunction& conjunction) {
      for (const auto literal : conjunction.literals) {
        need_literal(literal);
        if (!support_.is_derived(literal.atom) || supported[literal_index(literal)]) continue;
        supported[literal_index(literal)] = true;
        for (const auto part : support_.of(literal).literals) need_literal(part);
      }
    };
    const auto touch = [&](const GroundEffects& effects) {
      for (const std::uint32_t atom : effects.adds) atom_needed[atom] = true;
      for (const std::uint32_t atom : effects.deletes) atom_needed[atom] = true;
    };
    for (const auto& action : model_.actions) {
      for (const auto* conjunction : {&action.at_start, &action.over_all, &action.at_end}) need(*conjunction);
      touch(action.start_effects);
      touch(action.end_effects);
    }
    for (const auto& timed : model_.timed) touch(timed.effects);
    for (const auto& goal : model_.goal) need(goal);
    for (const auto& rule : model_.rules) need(rule.body);
    std::vector<std::uint32_t> negated;
    for (std::uint32_t atom = 0; atom < model_.atoms.size(); ++atom) {
      if (negation_needed[atom]) negated.push_back(atom);
    }
    negations_ = support_.negations(std::move(negated));
    for (const auto& rule : negations_) need(rule.body);
    for (std::uint32_t atom = 0; atom < model_.atoms.size(); ++atom) {
      if (atom_needed[atom]) add_fact({atom, false}, FactId());
      if (negation_needed[atom]) add_fact({atom, true}, fact({atom, false}));
    }
  }

  void add_fact(GroundLiteral literal, FactId negation_of) {
    const PredicateId predicate(std::size_t{model_.atoms.symbol(literal.atom)});
    const auto name_index = static_cast<std::uint32_t>(task_.atom_arguments.size());
    task_.atom_arguments.push_back(model_.atoms.objects(literal.atom));
    task_.is_derived.push_back(model_.derived[literal.atom]);
    facts_[literal_index(literal)] = task_.fact_names.push_back({name_index, predicate, literal.negated});
    negation_of_.push_back(negation_of);
  }

  FactId fact(GroundLiteral literal) const { return facts_[literal_index(literal)]; }

  std::vector<FactId> facts_of(std::span<const GroundLiteral> literals) const {
    std::vector<FactId> result;
    result.reserve(literals.size());
    for (const auto literal : literals) result.push_back(fact(literal));
    return result;
  }

  void add_action(const GroundAction& source, const Compression& compression) {
    const ActionId id(task_.actions.size());
    Action action;
    action.schema = source.schema;
    action.min_duration = source.min_duration;
    action.max_duration = source.max_duration;
    action.compression_safe = compression.safe;
    static const ActionWindows kAnyTime;
    const ActionWindows& windows = source.windows ? *source.windows : kAnyTime;
    const SnapKind kind = source.durative ? SnapKind::start : SnapKind::instant;
    action.start = add_snap({kind, id}, source.at_start, source.start_effects, windows.start,
                            asked_besides(source, false));
    action.end = source.durative ? add_snap({SnapKind::end, id}, source.at_end, source.end_effects,
                                            windows.end, asked_besides(source, true))
                                 : action.start;
    task_.actions.push_back(action);
    task_.action_arguments.push_back(source.arguments);
    task_.span_windows.push_back(restricting(windows.span));
    task_.duration_rules.push_back(source.duration_rules);
    const auto invariants = facts_of(source.over_all.literals);
    task_.invariants.push_back(invariants);
    task_.numeric_invariants.push_back(source.over_all.comparisons);
    task_.invariant_reads.push_back(reads(source.over_all, {}, {}));
    task_.derived_invariant_reads.push_back(derived_reads(source.over_all));
    std::vector<FactId> absent;
    for (const std::uint32_t atom : compression.absent) absent.push_back(fact({atom, false}));
    task_.absent_for_compression.push_back(absent);
  }

  static std::span<const TimeWindow> restricting(const TimeWindows& windows) {
    return is_any_time(windows) ? std::span<const TimeWindow>() : std::span<const TimeWindow>(windows);
  }

  // Returns what the action reads at that point besides what it needs and what its effects are computed from.
  std::vector<VariableId> asked_besides(const GroundAction& action, bool at_end) const {
    std::vector<VariableId> result;
    for (const auto& rule : action.duration_rules) {
      if (rule.at_end == at_end) add_terms(rule.bound, result);
    }
    for (const ReadVariable& read : model_.read_set_of(action)) {
      if (read.at_end != at_end) continue;
      result.push_back(read.is_number ? task_.variable(NumberId(std::size_t{read.index}))
                                      : task_.variable(fact({read.index, false})));
    }
    return result;
  }

  SnapId add_snap(Snap snap, const Conjunction& conditions, const GroundEffects& effects,
                  const TimeWindows& windows, std::vector<VariableId> asked_besides) {
    std::vector<FactId> adds, deletes;
    for (const bool added : {true, false}) {
      for (const std::uint32_t atom : added ? effects.adds : effects.deletes) {
        (added ? adds : deletes).push_back(fact({atom, false}));
        const FactId negation = fact({atom, true});
        if (!negation.is_none()) (added ? deletes : adds).push_back(negation);
      }
    }
    task_.conditions.push_back(facts_of(conditions.literals));
    task_.comparisons.push_back(conditions.comparisons);
    task_.adds.push_back(adds);
    task_.deletes.push_back(deletes);
    task_.numeric_effects.push_back(effects.numeric);
    task_.reads.push_back(reads(conditions, effects.numeric, std::move(asked_besides)));
    task_.writes.push_back(writes(effects, adds, deletes));
    task_.windows.push_back(restricting(windows));
    return task_.snaps.push_back(snap);
  }

  std::vector<VariableId> reads(const Conjunction& conditions, std::span<const NumericEffect> effects,
                                std::vector<VariableId> result) const {
    for (const auto literal : conditions.literals) add_reads(literal, result);
    for (const auto& comparison : conditions.comparisons) add_terms(comparison.expression, result);
    for (const auto& effect : effects) add_terms(effect.expression, result);
    return unique(std::move(result));
  }

  void add_terms(ExpressionId expression, std::vector<VariableId>& result) const {
    for (const auto& term : model_.expressions[expression].terms)
      result.push_back(task_.variable(term.variable));
  }

  // Adds what a literal hangs on: itself, or what it is derived from.
  void add_reads(GroundLiteral literal, std::vector<VariableId>& result) const {
    if (!support_.is_derived(literal.atom)) return result.push_back(task_.variable(fact(literal)));
    const Support support = support_.of(literal);
    for (const auto part : support.literals) result.push_back(task_.variable(fact(part)));
    for (const NumberId number : support.numbers) result.push_back(task_.variable(number));
  }

  std::vector<VariableId> derived_reads(const Conjunction& conditions) const {
    std::vector<VariableId> result;
    for (const auto literal : conditions.literals) {
      if (support_.is_derived(literal.atom)) add_reads(literal, result);
    }
    return unique(std::move(result));
  }

  // Comes after the actions, so that the steps of plans have the lowest ids.
  void add_rules() {
    std::vector<DerivationRule> rules;
    for (const auto& rule : model_.rules) {
      rules.push_back({fact(rule.head),
                       rule.layer,
                       facts_of(rule.body.literals),
                       {rule.body.comparisons.begin(), rule.body.comparisons.end()}});
      add_derivation(rule);
    }
    for (const auto& rule : negations_) add_derivation(rule);
    task_.derived = DerivedFacts(rules);
  }

  void add_derivation(const GroundRule& rule) {
    task_.conditions.push_back(facts_of(rule.body.literals));
    task_.comparisons.push_back({});
    task_.adds.push_back(std::array{fact(rule.head)});
    task_.deletes.push_back({});
    task_.numeric_effects.push_back({});
    task_.reads.push_back({});
    task_.writes.push_back({});
    task_.windows.push_back({});
    task_.snaps.push_back({SnapKind::derivation, ActionId()});
  }

  std::vector<VariableId> writes(const GroundEffects& effects, const std::vector<FactId>& adds,
                                 const std::vector<FactId>& deletes) const {
    std::vector<VariableId> result;
    for (const FactId added : adds) {
      if (!is_unordered(added)) result.push_back(task_.variable(added));
    }
    for (const FactId deleted : deletes) result.push_back(task_.variable(deleted));
    for (const auto& effect : effects.numeric) {
      if (!model_.only_metric_asks[effect.variable.index()])
        result.push_back(task_.variable(effect.variable));
    }
    return unique(std::move(result));
  }

  bool is_unordered(FactId fact_id) const {
    const FactName& name = task_.fact_names[fact_id];
    if (name.negated) return false;
    const auto atom = model_.atoms.find(name.predicate.value, task_.atom_arguments[std::size_t{name.atom}]);
    return unordered_[*atom];
  }

  static std::vector<VariableId> unique(std::vector<VariableId> list) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
  }

  // What a list of lists takes.
  template <typename T>
  static std::size_t bytes_of(const std::vector<std::vector<T>>& lists) {
    std::size_t bytes = lists.capacity() * sizeof(std::vector<T>);
    for (const std::vector<T>& list : lists) bytes += list.capacity() * sizeof(T) + 16;  // and the heap's own
    return bytes;
  }

  void lay_out(const std::vector<MutexGroup>& groups, SearchLimits& limits) {
    std::vector<bool> needed(task_.fact_names.size(), false);
    for (std::size_t i = 0; i < needed.size(); ++i) needed[i] = negation_of_[FactId(i)].is_none();
    std::vector<std::vector<std::uint32_t>> candidates;
    for (const auto& group : groups) {
      std::vector<std::uint32_t> members;
      for (const std::uint32_t atom : group.atoms) {
        const FactId member = fact({atom, false});
        if (!member.is_none()) members.push_back(member.value);
      }
      if (members.size() > 1) candidates.push_back(std::move(members));
    }
    std::vector<std::vector<FactId>> variables;
    const auto covering = cover(needed, candidates);
    for (const auto& members : covering) {
      auto& variable = variables.emplace_back();
      variable.reserve(members.size());
      for (const std::uint32_t member : members) variable.emplace_back(std::size_t{member});
    }
    limits.memory_on_top(task_.bytes() + bytes_of(candidates) + bytes_of(covering) + bytes_of(variables) +
                         facts_.capacity() * sizeof(FactId) + negation_of_.bytes());
    task_.layout = StateLayout(std::move(variables), negation_of_, model_.numbers.size());
    task_.initial_state.assign(task_.layout.words(), 0);
    for (const std::uint32_t atom : model_.initial_atoms) {
      const FactId initial = fact({atom, false});
      if (!initial.is_none()) task_.layout.add(task_.initial_state, initial);
    }
    for (std::size_t i = 0; i < model_.numbers.size(); ++i) {
      task_.layout.set_number(task_.initial_state, NumberId(i), model_.initial_numbers[i]);
    }
    task_.derived.complete(task_.layout, task_.expressions, task_.initial_state);
  }

  const GroundModel& model_;
  const Symbols& symbols_;
  std::vector<FactId> facts_;  // by literal index; none for literals without a fact
  std::vector<bool> unordered_;
  DerivedSupport support_;
  std::vector<GroundRule> negations_;
  IdVector<FactId, FactId> negation_of_;
  Task task_;
};

}  // namespace

Task build_task(const GroundModel& model, const Symbols& symbols, const std::vector<LiftedAction>& schemas,
                const std::vector<MutexGroup>& groups, const std::vector<Compression>& compression,
                SearchLimits& limits) {
  return Builder(model, symbols).run(schemas, groups, compression, limits);
}

}  // namespace roci::planner::temporal_pddl::grounding::encoding
