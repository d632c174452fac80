// The truth of derived predicates is their least fixed point, layer by layer, where they rest on themselves; only
// the instances that a question reaches are computed.
#include <algorithm>
#include <utility>

#include "planner_svc/temporal_pddl/validate/evaluator.hpp"

namespace roci::planner::temporal_pddl::validate {

// What hangs on nothing that changes is settled once for all states, and is no part of what is read.
bool Evaluator::constant(const pddl::Atom& atom, const std::string& ground, const Bindings& bindings) {
  std::map<std::string, bool>& constants = model_.constants();
  const auto known = constants.find(ground);
  if (known != constants.end()) return known->second;
  Evaluator inner(model_, state_);
  inner.settles_constants_ = true;
  inner.settled_.swap(constants);
  const bool out = inner.derived(atom, ground, bindings);
  inner.settled_.swap(constants);
  return out;
}

bool Evaluator::derived(const pddl::Atom& atom, const std::string& ground, const Bindings& bindings) {
  if (!settles_constants_ && model_.is_static(atom.symbol)) return constant(atom, ground, bindings);
  if (reads_) reads_->facts.push_back(ground);  // nobody changes it directly, but it is no constant
  const int number = model_.layer(atom.symbol);
  const bool alone = !model_.is_recursive(atom.symbol) && depth_ < kMostBelow;
  if (alone || !open_ || open_->number != number) {
    const auto known = settled_.find(ground);
    if (known != settled_.end() && !reads_) return known->second;
  }
  Instance instance{&atom, {}, false};
  for (const pddl::Term& term : atom.arguments) instance.objects.push_back(bindings.object_of(term));
  if (alone) {
    Layer* const outer = std::exchange(open_, nullptr);
    ++depth_;
    const bool out = derive(instance);
    --depth_;
    open_ = outer;
    settled_[ground] = out;
    return out;
  }
  if (open_ && open_->number == number) {
    const auto [it, first] = open_->index.emplace(ground, open_->instances.size());
    if (first) open_->instances.push_back(std::move(instance));
    return open_->instances[it->second].derived;
  }
  Layer layer{number, {std::move(instance)}, {{ground, 0}}};
  Layer* const outer = open_;
  open_ = &layer;
  settle(layer);
  open_ = outer;
  for (const auto& [name, position] : layer.index) settled_[name] = layer.instances[position].derived;
  return layer.instances.front().derived;
}

// Later instances support earlier ones, so going backwards reaches the fixed point soonest.
void Evaluator::settle(Layer& layer) {
  const std::size_t facts = reads_ ? reads_->facts.size() : 0;
  for (bool changed = true; changed;) {
    changed = false;
    const std::size_t count = layer.instances.size();
    for (std::size_t i = count; i-- > 0;) {
      if (layer.instances[i].derived || !derive(layer.instances[i])) continue;
      layer.instances[i].derived = true;
      changed = true;
    }
    changed = changed || layer.instances.size() > count;
    if (reads_) {
      const auto begin = reads_->facts.begin() + static_cast<std::ptrdiff_t>(facts);
      std::sort(begin, reads_->facts.end());
      reads_->facts.erase(std::unique(begin, reads_->facts.end()), reads_->facts.end());
    }
  }
}

bool Evaluator::derive(const Instance& instance) {
  bool holds_somehow = false;
  for (const pddl::DerivedPredicate* rule : model_.rules(instance.atom->symbol)) {
    Bindings bindings;
    bool fits = true;
    for (std::size_t i = 0; i < instance.objects.size(); ++i) {
      const pddl::TypedName& parameter = rule->head.parameters[i];
      const int object = model_.objects().find(instance.objects[i]);
      fits = fits && model_.objects().has_type(static_cast<std::size_t>(object), parameter.types);
      bindings.push(parameter.name, instance.objects[i]);
    }
    if (!fits || !holds(rule->body, bindings)) continue;
    holds_somehow = true;
    if (!reads_) break;
  }
  return holds_somehow;
}

}  // namespace roci::planner::temporal_pddl::validate
