#include "planner_svc/temporal_pddl/grounding/reachability/reachability.hpp"

#include <algorithm>
#include <utility>

#include "planner_svc/temporal_pddl/grounding/reachability/atom_index.hpp"
#include "planner_svc/temporal_pddl/grounding/reachability/schema_join.hpp"

namespace roci::planner::temporal_pddl::grounding::reachability {

using call::SearchLimits;
using lifted::Binding, lifted::LiftedAction, lifted::LiftedDuration, lifted::LiftedEffect,
    lifted::StaticModel, lifted::TupleTable, lifted::for_each_value, lifted::objects_of;
using task::IdVector, task::ObjectId, task::PredicateId, task::SchemaId;

namespace {

class Exploration {
 public:
  Exploration(const std::vector<LiftedAction>& actions, const StaticModel& static_model, SearchLimits& limits)
      : actions_(actions),
        static_model_(static_model),
        limits_(limits),
        index_(static_model.symbols().predicates(), static_model.symbols().objects()) {
    result_.instances.resize(actions.size());
    for (const auto& action : actions) joins_.emplace_back(action, static_model);
    triggers_.resize(static_model.symbols().predicates());
    for (std::size_t schema = 0; schema < joins_.size(); ++schema) {
      const auto& fluents = joins_[schema].fluents();
      for (std::size_t i = 0; i < fluents.size(); ++i) triggers_[fluents[i].predicate].push_back({schema, i});
    }
  }

  Reachability run() {
    const TupleTable& initial = static_model_.initial_atoms();
    for (const bool fixed :
         {true, false}) {  // the static atoms first: they are there when the first fluent comes
      for (std::uint32_t i = 0; i < initial.size(); ++i) {
        if (static_model_.is_static(PredicateId(initial.symbol(i))) == fixed)
          reach(PredicateId(initial.symbol(i)), initial.objects(i));
      }
      if (fixed) take_static();
    }
    for (const auto& timed : static_model_.timed_atoms()) {
      if (!timed.negated) reach(timed.predicate, timed.objects);
    }
    for (std::size_t schema = 0; schema < joins_.size(); ++schema) {
      if (!joins_[schema].fluents().empty()) continue;
      joins_[schema].join_static(result_.atoms, index_, limits_,
                                 [&](Binding& binding) { found(schema, binding); });
    }
    for (; next_ < queue_.size(); ++next_) take(queue_[next_]);
    result_.reached.resize(result_.atoms.size(), false);
    return std::move(result_);
  }

 private:
  struct Trigger {
    std::size_t schema;
    std::size_t fluent;
  };
  struct Waiting {
    std::size_t schema;
    std::size_t instance;
    std::size_t missing;  // deferred conditions that are not reached
  };

  void reach(PredicateId predicate, std::span<const ObjectId> objects) {
    const std::uint32_t atom = result_.atoms.intern(predicate.value, objects);
    if (atom >= result_.reached.size()) result_.reached.resize(result_.atoms.size() + 64, false);
    if (result_.reached[atom]) return;
    result_.reached[atom] = true;
    queue_.push_back(atom);
  }

  void take_static() {
    for (; next_ < queue_.size(); ++next_) enter_index(queue_[next_]);
  }

  void enter_index(std::uint32_t atom) {
    index_.add(atom, PredicateId(result_.atoms.symbol(atom)), result_.atoms.objects(atom));
  }

  void take(std::uint32_t atom) {
    enter_index(atom);
    for (const Trigger& trigger : triggers_[PredicateId(result_.atoms.symbol(atom))]) {
      joins_[trigger.schema].join(trigger.fluent, atom, result_.atoms, index_, limits_,
                                  [&](Binding& binding) { found(trigger.schema, binding); });
    }
    if (atom >= waiting_for_.size()) return;
    for (const std::size_t waiting : std::exchange(waiting_for_[atom], {})) {
      if (--waiting_[waiting].missing == 0) reach_end(waiting_[waiting].schema, waiting_[waiting].instance);
    }
  }

  void found(std::size_t schema, Binding& binding) {
    if (!possible(actions_[schema], binding)) return;
    auto& instances = result_.instances[SchemaId(schema)];
    instances.push_back(std::span<const ObjectId>(binding).first(actions_[schema].parameters.size()));
    limits_.memory(instances.bytes() + result_.atoms.bytes());
    for (const auto& effect : actions_[schema].start_effects) reach_effect(effect, binding);
    defer_end(schema, instances.size() - 1, binding);
  }

  bool possible(const LiftedAction& action, Binding& binding) const {
    if (!static_model_.possible(action.at_start, binding) ||
        !static_model_.possible(action.over_all, binding) ||
        !static_model_.possible(action.at_end, binding)) {
      return false;
    }
    return std::ranges::all_of(action.duration, [&](const LiftedDuration& rule) {
      return static_model_.defined(rule.bound, binding);
    });
  }

  // Ends wait until their deferred conditions are reached, each distinct one counted once.
  void defer_end(std::size_t schema, std::size_t instance, const Binding& binding) {
    std::vector<std::uint32_t> missing;
    for (const auto& atom : joins_[schema].deferred()) {
      const auto objects = objects_of(atom.arguments, binding);
      missing.push_back(result_.atoms.intern(atom.predicate.value, objects));
    }
    std::ranges::sort(missing);
    missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
    std::erase_if(missing, [&](std::uint32_t atom) { return index_.contains(atom); });
    if (missing.empty()) return reach_end(schema, instance);
    for (const std::uint32_t atom : missing) {
      if (atom >= waiting_for_.size()) waiting_for_.resize(result_.atoms.size() + 64);
      waiting_for_[atom].push_back(waiting_.size());
    }
    waiting_.push_back({schema, instance, missing.size()});
  }

  void reach_end(std::size_t schema, std::size_t instance) {
    const auto objects = result_.instances[SchemaId(schema)][instance];
    Binding binding(actions_[schema].slots);
    std::ranges::copy(objects, binding.begin());
    for (const auto& effect : actions_[schema].end_effects) reach_effect(effect, binding);
  }

  void reach_effect(const LiftedEffect& effect, Binding& binding) {
    if (effect.kind != LiftedEffect::Kind::add) return;
    for_each_value(effect.quantified, binding, [&] {
      if (!static_model_.possible(effect.start_condition, binding) ||
          !static_model_.possible(effect.end_condition, binding))
        return;
      reach(effect.atom.predicate, objects_of(effect.atom.arguments, binding));
    });
  }

  const std::vector<LiftedAction>& actions_;
  const StaticModel& static_model_;
  SearchLimits& limits_;
  Reachability result_;
  AtomIndex index_;
  std::vector<SchemaJoin> joins_;
  IdVector<PredicateId, std::vector<Trigger>> triggers_;
  std::vector<std::uint32_t> queue_;  // reached atoms; those before next_ are in the index
  std::size_t next_ = 0;
  std::vector<Waiting> waiting_;
  std::vector<std::vector<std::size_t>> waiting_for_;  // by atom
};

}  // namespace

Reachability explore(const std::vector<LiftedAction>& actions, const StaticModel& static_model,
                     SearchLimits& limits) {
  return Exploration(actions, static_model, limits).run();
}

}  // namespace roci::planner::temporal_pddl::grounding::reachability
