#include "planner_svc/temporal_pddl/grounding/simplification/envelopes.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace roci::planner::temporal_pddl::grounding::simplification {

using instantiation::GroundAction, instantiation::GroundEffects, instantiation::GroundLiteral,
    instantiation::GroundModel, instantiation::TimedChange;
using lifted::Symbols;
using task::ObjectId, task::PredicateId;
using temporal::Duration;

namespace {

bool contains(std::span<const std::uint32_t> sorted, std::uint32_t value) {
  return std::ranges::binary_search(sorted, value);
}

template <typename List>
void insert(List& sorted, const typename List::value_type& value) {
  sorted.insert(std::ranges::lower_bound(sorted, value), value);
}

class Envelopes {
 public:
  explicit Envelopes(const GroundModel& model)
      : model_(model), held_otherwise_(model.derived), holders_(model.atoms.size()) {
    for (const std::uint32_t atom : model.initial_atoms) held_otherwise_[atom] = true;
    for (const TimedChange& timed : model.timed) note_other(timed.effects);
    for (std::size_t i = 0; i < model.actions.size(); ++i) note(i);
  }

  // Returns the actions within one of which lies whatever needs the atom all the time; there are none if it
  // may lie elsewhere.
  std::span<const std::size_t> holders(std::uint32_t atom) const {
    return held_otherwise_[atom] ? std::span<const std::size_t>() : holders_[atom];
  }
  // Returns nothing if all holders may last long enough. Else returns the longest duration of the shortest
  // one that may, or the least duration of the action itself if none may.
  std::optional<Duration> at_least(const GroundAction& action, GroundLiteral literal) const {
    if (literal.negated || contains(action.start_effects.adds, literal.atom)) return std::nullopt;
    std::optional<Duration> shortest;
    bool all = true;
    for (const std::size_t holder : holders(literal.atom)) {
      const Duration longest = model_.actions[holder].max_duration;
      if (longest < action.min_duration) {
        all = false;
      } else if (!shortest || longest < *shortest) {
        shortest = longest;
      }
    }
    if (all) return std::nullopt;
    return shortest.value_or(action.min_duration);
  }

 private:
  void note_other(const GroundEffects& effects) {
    for (const std::uint32_t atom : effects.adds) held_otherwise_[atom] = true;
  }

  void note(std::size_t index) {
    const GroundAction& action = model_.actions[index];
    note_other(action.end_effects);
    for (const std::uint32_t atom : action.start_effects.adds) {
      if (action.durative && contains(action.end_effects.deletes, atom)) {
        holders_[atom].push_back(index);
      } else {
        held_otherwise_[atom] = true;
      }
    }
  }

  const GroundModel& model_;
  std::vector<bool> held_otherwise_;               // by atom
  std::vector<std::vector<std::size_t>> holders_;  // by atom
};

// Makes facts of the form "p holds because of something that can last at least d".
class LongEnough {
 public:
  LongEnough(GroundModel& model, Symbols& symbols) : model_(model), symbols_(symbols) {}

  std::uint32_t atom(std::uint32_t of, Duration at_least) {
    const std::uint32_t predicate = model_.atoms.symbol(of);
    const auto [place, fresh] = predicates_.try_emplace({predicate, at_least});
    if (fresh) {
      const std::string seconds = std::to_string(std::chrono::duration<double>(at_least).count());
      place->second =
          symbols_.add_predicate(symbols_.name(PredicateId(std::size_t{predicate})) + "-for-" + seconds);
    }
    const std::vector<ObjectId> objects(model_.atoms.objects(of).begin(), model_.atoms.objects(of).end());
    const std::uint32_t result = model_.atoms.intern(place->second.value, objects);
    model_.derived.resize(model_.atoms.size(), false);
    return result;
  }

 private:
  GroundModel& model_;
  Symbols& symbols_;
  std::map<std::pair<std::uint32_t, Duration>, PredicateId> predicates_;
};

}  // namespace

void split_envelopes_by_duration(GroundModel& model, Symbols& symbols) {
  const Envelopes envelopes(model);
  LongEnough long_enough(model, symbols);
  std::map<std::pair<std::uint32_t, Duration>, std::uint32_t> wanted;
  for (GroundAction& action : model.actions) {
    const auto invariants = action.over_all.literals;
    for (const GroundLiteral literal : invariants) {
      const auto at_least = envelopes.at_least(action, literal);
      if (!at_least) continue;
      const auto [place, fresh] = wanted.try_emplace({literal.atom, *at_least});
      if (fresh) place->second = long_enough.atom(literal.atom, *at_least);
      insert(action.over_all.literals, {place->second, false});
    }
  }
  for (const auto& [held, atom] : wanted) {
    for (const std::size_t holder : envelopes.holders(held.first)) {
      GroundAction& action = model.actions[holder];
      if (action.max_duration < held.second) continue;
      insert(action.start_effects.adds, atom);
      insert(action.end_effects.deletes, atom);
    }
  }
}

}  // namespace roci::planner::temporal_pddl::grounding::simplification
