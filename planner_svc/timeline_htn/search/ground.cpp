#include "planner_svc/timeline_htn/search/ground.hpp"

#include <algorithm>
#include <unordered_set>

namespace roci::planner::timeline_htn::search {

using model::Bounds, model::GroundState, model::Model, model::Pattern, model::State, model::StateKind,
    model::Term, model::Test, model::Variable;

namespace {

// Gives the variables that are not bound yet, one after the other, each object that the relations permit.
class Binder {
 public:
  Binder(const Model& model, const std::vector<std::vector<Index>>& objects_of,
         const std::vector<Variable>& variables, const std::vector<Test>& where)
      : model_(model), objects_of_(objects_of), variables_(variables), where_(where) {}

  std::vector<std::vector<Index>> run(std::vector<Index> bound) {
    bound.resize(variables_.size(), kNone);
    if (consistent(bound)) extend(bound);
    return std::move(out_);
  }

 private:
  static bool is_bound(const std::vector<Term>& terms, const std::vector<Index>& bound) {
    return std::ranges::all_of(terms, [&](const Term& t) { return t.object || bound[t.index] != kNone; });
  }
  static bool is_bound(const model::Expression& expression, const std::vector<Index>& bound) {
    return std::ranges::all_of(expression, [&](const auto& node) { return is_bound(node.terms, bound); });
  }

  // Whether no test fails of which all variables are bound.
  bool consistent(const std::vector<Index>& bound) const {
    return std::ranges::all_of(where_, [&](const Test& test) {
      const bool known = test.kind == Test::Kind::numbers
                             ? is_bound(test.left, bound) && is_bound(test.right, bound)
                             : is_bound(test.terms, bound);
      return !known || model::holds(model_, test, bound);
    });
  }

  // The objects that a relation, whose other arguments are bound, leaves to the variable; else all of its type.
  std::vector<Index> candidates(Index variable, const std::vector<Index>& bound) const {
    for (const Test& test : where_) {
      if (test.kind != Test::Kind::relation || test.negated) continue;
      const auto place = std::ranges::find(test.terms, Term{variable, false});
      if (place == test.terms.end()) continue;
      const auto column = static_cast<std::size_t>(place - test.terms.begin());
      const auto& rows = model_.relations[test.relation].rows;
      const bool sorted_by = column > 0 && is_bound({test.terms[0]}, bound);
      const Index first = sorted_by ? model::object_of(test.terms[0], bound) : kNone;
      auto row = sorted_by ? std::ranges::lower_bound(rows, std::vector<Index>{first}) : rows.begin();
      std::vector<Index> out;
      for (; row != rows.end() && (!sorted_by || (*row)[0] == first); ++row) {
        bool fits = true;
        for (std::size_t i = 0; i < test.terms.size() && fits; ++i)
          fits = !is_bound({test.terms[i]}, bound) || (*row)[i] == model::object_of(test.terms[i], bound);
        if (fits) out.push_back((*row)[column]);
      }
      std::ranges::sort(out);
      const auto doubled = std::ranges::unique(out);
      out.erase(doubled.begin(), doubled.end());
      return out;
    }
    return objects_of_[variables_[variable].type];
  }
  void extend(std::vector<Index>& bound) {
    const auto open = std::ranges::find(bound, kNone);
    if (open == bound.end()) {
      out_.push_back(bound);
      return;
    }
    const auto variable = static_cast<Index>(open - bound.begin());
    for (const Index object : candidates(variable, bound)) {
      bound[variable] = object;
      if (consistent(bound)) extend(bound);
    }
    bound[variable] = kNone;
  }

  const Model& model_;
  const std::vector<std::vector<Index>>& objects_of_;
  const std::vector<Variable>& variables_;
  const std::vector<Test>& where_;
  std::vector<std::vector<Index>> out_;
};

// Gives the variables among the terms their objects; false where one has another already.
bool unify(const std::vector<Term>& terms, const std::vector<Index>& objects, std::vector<Index>& bound) {
  for (std::size_t i = 0; i < terms.size(); ++i) {
    Index expected = terms[i].object ? terms[i].index : bound[terms[i].index];
    if (expected == kNone) expected = bound[terms[i].index] = objects[i];
    if (expected != objects[i]) return false;
  }
  return true;
}

std::vector<Test> renumbered(std::vector<Test> tests, const std::vector<Term>& terms) {
  const auto renumber = [&](std::vector<Term>& list) {
    for (Term& term : list)
      if (!term.object) term = terms[term.index];
  };
  for (Test& test : tests) {
    renumber(test.terms);
    for (auto* side : {&test.left, &test.right})
      for (auto& node : *side) renumber(node.terms);
  }
  return tests;
}

// Adds to each set those of its members, until nothing changes.
void close(std::vector<ComponentSet>& sets) {
  for (bool more = true; more;) {
    more = false;
    for (ComponentSet& set : sets) {
      ComponentSet all = set;
      for (Index c = 0; c < sets.size(); ++c)
        if ((all >> c & 1U) != 0) all |= sets[c];
      more = more || all != set;
      set = all;
    }
  }
}

}  // namespace

GroundState ground_of(const Pattern& pattern, const std::vector<Index>& objects) {
  GroundState out{pattern.component, pattern.state, {}};
  for (const Term& term : pattern.terms) out.objects.push_back(model::object_of(term, objects));
  return out;
}

Ground::Ground(const Model& model)
    : model_(&model), objects_of_(model.types.size()), by_component_(model.components.size()) {
  for (Index i = 0; i < model.objects.size(); ++i) objects_of_[model.objects[i].type].push_back(i);
  measure_footprints();
}

// What a component moves: the closure over needs and behaviours; what it touches: that over conditions, too.
void Ground::measure_footprints() {
  const std::size_t count = model_->components.size();
  moved_by_.resize(count);
  for (Index c = 0; c < count; ++c) {
    moved_by_[c] |= ComponentSet{1} << c;
    for (const State& state : model_->components[c].states)
      for (const model::Need& need : state.needs) moved_by_[c] |= ComponentSet{1} << need.state.component;
  }
  for (const model::Behaviour& behaviour : model_->behaviours) {
    if (!behaviour.achieves) continue;
    ComponentSet& set = moved_by_[behaviour.achieves->component];
    for (const auto& subgoal : behaviour.subgoals) set |= ComponentSet{1} << subgoal.state.component;
  }
  close(moved_by_);
  footprints_ = moved_by_;
  for (const model::Behaviour& behaviour : model_->behaviours) {
    for (const auto& condition : behaviour.conditions) {
      looked_at_ |= ComponentSet{1} << condition.state.component;
      if (behaviour.achieves)
        footprints_[behaviour.achieves->component] |= ComponentSet{1} << condition.state.component;
    }
  }
  close(footprints_);
  for (Index c = 0; c < count; ++c)
    if (model::is_predicted(*model_, c)) predicted_ |= ComponentSet{1} << c;
  for (ComponentSet& set : footprints_) set &= ~predicted_;
  looked_at_ &= ~predicted_;
}

const State& Ground::definition(StateId state) const {
  const GroundState& ground = instances_[state].state;
  return model_->components[ground.component].states[ground.state];
}

StateId Ground::find(const GroundState& state) {
  if (const auto known = numbers_.find(state); known != numbers_.end()) return known->second;
  const State& definition = model_->components[state.component].states[state.state];
  const std::optional<Bounds> bounds = model::bounds(*model_, definition, state.objects);
  const bool exists = bounds && std::ranges::all_of(definition.where, [&](const Test& test) {
                        return model::holds(*model_, test, state.objects);
                      });
  StateId number = kNone;
  if (exists) {
    number = static_cast<StateId>(instances_.size());
    auto& same = by_component_[state.component];
    instances_.push_back({state, *bounds, definition.kind, static_cast<Index>(same.size())});
    same.push_back(number);
    next_.emplace_back();
  }
  numbers_.emplace(state, number);
  bytes_ += 200 + 8 * state.objects.size();
  return number;
}

const std::vector<StateId>& Ground::next(StateId state) {
  if (next_[state].known) return next_[state].states;
  const GroundState from = instances_[state].state;
  const model::Component& component = model_->components[from.component];
  std::vector<StateId> out;
  std::unordered_set<StateId> met;
  for (const model::Transition& transition : component.transitions) {
    const State& to = component.states[transition.to];
    if (transition.from != from.state || to.kind == StateKind::error) continue;
    std::vector<Index> bound(transition.variables.size(), kNone);
    if (!unify(transition.from_terms, from.objects, bound)) continue;
    for (const auto& objects :
         bindings(transition.variables, bound, renumbered(to.where, transition.to_terms))) {
      GroundState after{from.component, transition.to, {}};
      for (const Term& term : transition.to_terms) after.objects.push_back(model::object_of(term, objects));
      const StateId found = find(after);
      if (found != kNone && met.insert(found).second) out.push_back(found);
    }
  }
  bytes_ += out.size() * sizeof(StateId);
  next_[state] = {true, std::move(out)};
  return next_[state].states;
}

bool Ground::may_follow(StateId from, StateId to) const {
  const GroundState &before = instances_[from].state, &after = instances_[to].state;
  if (before.component != after.component || instances_[to].kind == StateKind::error) return false;
  return std::ranges::any_of(model_->components[before.component].transitions, [&](const auto& transition) {
    if (transition.from != before.state || transition.to != after.state) return false;
    std::vector<Index> bound(transition.variables.size(), kNone);
    return unify(transition.from_terms, before.objects, bound) &&
           unify(transition.to_terms, after.objects, bound);
  });
}

const std::vector<Index>& Ground::distances(StateId from) {
  if (const auto known = distances_.find(from); known != distances_.end()) return known->second;
  std::vector<StateId> queue{from};
  std::unordered_map<StateId, Index> steps{{from, 0}};
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (const StateId after : next(queue[i]))
      if (steps.emplace(after, steps[queue[i]] + 1).second) queue.push_back(after);
  std::vector<Index> out(by_component_[instances_[from].state.component].size(), kNone);
  for (const auto& [state, count] : steps) out[instances_[state].local] = count;
  bytes_ += out.size() * sizeof(Index);
  return distances_.emplace(from, std::move(out)).first->second;
}

Index Ground::distance(StateId from, StateId to) {
  if (instances_[from].state.component != instances_[to].state.component) return kNone;
  const std::vector<Index>& known = distances(from);
  const Index local = instances_[to].local;
  return local < known.size() ? known[local] : kNone;
}

Index Ground::distance_to_rest(StateId from) {
  std::vector<StateId> queue{from};
  std::unordered_map<StateId, Index> steps{{from, 0}};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    if (instances_[queue[i]].kind == StateKind::resting) return steps[queue[i]];
    for (const StateId after : next(queue[i]))
      if (steps.emplace(after, steps[queue[i]] + 1).second) queue.push_back(after);
  }
  return kNone;
}

bool Ground::fits(StateId state, const Pattern& pattern, std::span<const Index> bound) const {
  const GroundState& ground = instances_[state].state;
  if (ground.component != pattern.component || ground.state != pattern.state) return false;
  for (std::size_t i = 0; i < pattern.terms.size(); ++i) {
    const Index wanted = model::object_of(pattern.terms[i], bound);
    if (wanted != kNone && wanted != ground.objects[i]) return false;
  }
  return true;
}

std::vector<StateId> Ground::reachable(StateId from, const Pattern& pattern, std::span<const Index> bound) {
  const std::vector<Index> known = distances(from);
  const auto& same = by_component_[instances_[from].state.component];
  std::vector<StateId> out;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i] != kNone && fits(same[i], pattern, bound)) out.push_back(same[i]);
  std::ranges::stable_sort(out, {}, [&](StateId state) { return known[instances_[state].local]; });
  return out;
}

std::vector<StateId> Ground::reachable(StateId from) {
  const std::vector<Index> known = distances(from);
  const auto& same = by_component_[instances_[from].state.component];
  std::vector<StateId> out;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i] != kNone) out.push_back(same[i]);
  std::ranges::stable_sort(out, {}, [&](StateId state) { return known[instances_[state].local]; });
  return out;
}

std::vector<std::vector<Index>> Ground::bindings(const std::vector<Variable>& variables,
                                                 std::vector<Index> bound,
                                                 const std::vector<Test>& where) const {
  return Binder(*model_, objects_of_, variables, where).run(std::move(bound));
}

}  // namespace roci::planner::timeline_htn::search
