#include "planner_svc/temporal_pddl/grounding/reachability/schema_join.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::grounding::reachability {

using call::SearchLimits;
using lifted::Argument, lifted::Binding, lifted::LiftedAction, lifted::LiftedAtom, lifted::LiftedEffect,
    lifted::LiftedFormula, lifted::StaticModel, lifted::TupleTable, lifted::resolve;
using task::ObjectId, task::PredicateId;

namespace {

using Kind = LiftedFormula::Kind;

// Visits the parts of a conjunction, nested ones too.
template <typename Visit>
void for_each_part(const LiftedFormula& formula, const Visit& visit) {
  if (formula.kind != Kind::conjunction) return visit(formula);
  for (const auto& part : formula.parts) for_each_part(part, visit);
}

bool may_be_added_at_start(const LiftedAction& action, PredicateId predicate) {
  return std::ranges::any_of(action.start_effects, [&](const LiftedEffect& effect) {
    return effect.kind == LiftedEffect::Kind::add && effect.atom.predicate == predicate;
  });
}

}  // namespace

SchemaJoin::SchemaJoin(const LiftedAction& action, const StaticModel& static_model) : action_(action) {
  const auto collect = [&](const LiftedFormula& formula, const auto& is_deferred) {
    for_each_part(formula, [&](const LiftedFormula& part) {
      if (part.kind == Kind::not_equal)
        different_.emplace_back(part.atom.arguments[0], part.atom.arguments[1]);
      if (part.kind != Kind::atom) return;
      if (static_model.is_static(part.atom.predicate)) {
        statics_.push_back(part.atom);
      } else {
        (is_deferred(part.atom) ? deferred_ : fluents_).push_back(part.atom);
      }
    });
  };
  collect(action.at_start, [](const LiftedAtom&) { return false; });
  collect(action.over_all, [&](const LiftedAtom& atom) {
    return static_model.is_derived(atom.predicate) || may_be_added_at_start(action, atom.predicate);
  });
  collect(action.at_end, [](const LiftedAtom&) { return true; });
  for (const auto& domain : action.parameters) {
    std::vector<bool> allowed(static_model.symbols().objects(), false);
    for (const ObjectId object : domain) allowed[object.index()] = true;
    allowed_.push_back(std::move(allowed));
  }
}

// Is one backtracking search over the conditions that are still open.
struct SchemaJoin::Search {
  const SchemaJoin& schema;
  const TupleTable& atoms;
  const AtomIndex& index;
  SearchLimits& limits;
  const Found& found;
  // Only fluents from `trigger` on may match this atom, so that no binding is found twice.
  std::uint32_t newest = 0;
  std::size_t trigger = 0;
  Binding binding;
  std::vector<const LiftedAtom*> open;
  std::vector<std::size_t> open_fluent;  // position among fluents_, or a large number for statics
  struct Ticked {
    std::size_t place;  // in `open` when it was taken out
    const LiftedAtom* atom;
    std::size_t position;
  };
  std::vector<Ticked> ticked = {};

  void add_open(const LiftedAtom& atom, std::size_t position) {
    open.push_back(&atom);
    open_fluent.push_back(position);
  }

  std::span<const std::uint32_t> candidates(const LiftedAtom& atom) const {
    std::span<const std::uint32_t> best = index.of(atom.predicate);
    for (std::size_t i = 0; i < atom.arguments.size(); ++i) {
      const ObjectId object = resolve(atom.arguments[i], binding);
      if (object.is_none()) continue;
      const auto list = index.of(atom.predicate, i, object);
      if (list.size() < best.size()) best = list;
    }
    return best;
  }

  // Binds the open arguments of `atom` to the objects. Returns false if they do not fit; `bound` gets the new
  // slots.
  bool unify(const LiftedAtom& atom, std::span<const ObjectId> objects, std::vector<std::uint32_t>& bound) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const Argument argument = atom.arguments[i];
      const ObjectId object = resolve(argument, binding);
      if (object == objects[i]) continue;
      if (!object.is_none() || !bind(argument.index, objects[i])) return false;
      bound.push_back(argument.index);
    }
    return true;
  }

  bool bind(std::uint32_t slot, ObjectId object) {
    if (!schema.allowed_[slot][object.index()]) return false;
    binding[slot] = object;
    for (const auto& [left, right] : schema.different_) {
      const ObjectId a = resolve(left, binding);
      if (!a.is_none() && a == resolve(right, binding)) {
        binding[slot] = ObjectId();
        return false;
      }
    }
    return true;
  }

  void release(const std::vector<std::uint32_t>& bound) {
    for (const std::uint32_t slot : bound) binding[slot] = ObjectId();
  }

  bool is_bound(const LiftedAtom& atom) const {
    return std::ranges::none_of(atom.arguments,
                                [&](Argument argument) { return resolve(argument, binding).is_none(); });
  }

  bool matches(const LiftedAtom& atom, std::size_t position, std::span<const std::uint32_t> list) const {
    return std::ranges::any_of(list, [&](std::uint32_t candidate) {
      if (candidate == newest && position < trigger) return false;
      const auto objects = atoms.objects(candidate);
      for (std::size_t i = 0; i < objects.size(); ++i)
        if (resolve(atom.arguments[i], binding) != objects[i]) return false;
      return true;
    });
  }

  // Conditions without an open slot are ticked off in a loop, so that the depth of the recursion is the
  // number of slots, however many conditions there are.
  void extend() {
    const std::size_t ticked_before = ticked.size();
    while (true) {
      limits.step();
      if (open.empty()) {
        bind_rest(0);
        break;
      }
      std::size_t best = 0;
      auto best_list = candidates(*open[0]);
      for (std::size_t i = 1; i < open.size() && !best_list.empty(); ++i) {
        const auto list = candidates(*open[i]);
        if (list.size() < best_list.size()) {
          best = i;
          best_list = list;
        }
      }
      const LiftedAtom* atom = open[best];
      const std::size_t position = open_fluent[best];
      const bool bound_already = is_bound(*atom);
      if (bound_already && !matches(*atom, position, best_list)) break;
      open.erase(open.begin() + static_cast<std::ptrdiff_t>(best));
      open_fluent.erase(open_fluent.begin() + static_cast<std::ptrdiff_t>(best));
      ticked.push_back({best, atom, position});
      if (bound_already) continue;
      branch(*atom, position, best_list);
      break;
    }
    while (ticked.size() > ticked_before) {
      const auto [place, atom, position] = ticked.back();
      ticked.pop_back();
      open.insert(open.begin() + static_cast<std::ptrdiff_t>(place), atom);
      open_fluent.insert(open_fluent.begin() + static_cast<std::ptrdiff_t>(place), position);
    }
  }

  void branch(const LiftedAtom& atom, std::size_t position, std::span<const std::uint32_t> list) {
    std::vector<std::uint32_t> bound;
    for (const std::uint32_t candidate : list) {
      if (candidate == newest && position < trigger) continue;
      bound.clear();
      if (unify(atom, atoms.objects(candidate), bound)) extend();
      release(bound);
    }
  }

  void bind_rest(std::size_t first) {
    const auto& parameters = schema.action_.parameters;
    while (first < parameters.size() && !binding[first].is_none()) ++first;
    if (first == parameters.size()) return found(binding);
    for (const ObjectId object : parameters[first]) {
      limits.step();
      if (bind(static_cast<std::uint32_t>(first), object)) bind_rest(first + 1);
      binding[first] = ObjectId();
    }
  }
};

void SchemaJoin::join(std::size_t trigger, std::uint32_t atom, const TupleTable& atoms,
                      const AtomIndex& index, SearchLimits& limits, const Found& found) const {
  Search search{*this, atoms, index, limits, found, atom, trigger, Binding(action_.slots), {}, {}};
  std::vector<std::uint32_t> bound;
  if (!search.unify(fluents_[trigger], atoms.objects(atom), bound)) return;
  for (std::size_t i = 0; i < fluents_.size(); ++i) {
    if (i != trigger) search.add_open(fluents_[i], i);
  }
  for (const auto& fixed : statics_) search.add_open(fixed, fluents_.size());
  search.extend();
}

void SchemaJoin::join_static(const TupleTable& atoms, const AtomIndex& index, SearchLimits& limits,
                             const Found& found) const {
  Search search{*this, atoms, index, limits, found, 0xffffffff, 0, Binding(action_.slots), {}, {}};
  for (const auto& fixed : statics_) search.add_open(fixed, 0);
  search.extend();
}

}  // namespace roci::planner::temporal_pddl::grounding::reachability
