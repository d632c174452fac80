// The index finds the atoms known to be reachable by predicate and by the object at a position.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/lifted/tuple_table.hpp"
#include "planner_svc/temporal_pddl/task/ids.hpp"

namespace roci::planner::temporal_pddl::grounding::reachability {

/// Holds the numbers of the reachable atoms, each list in ascending order.
class AtomIndex {
 public:
  AtomIndex(std::size_t predicates, std::size_t objects) : objects_(objects), predicates_(predicates) {}

  /// Adds an atom; each comes once, in ascending order of its number in the order of reach.
  void add(std::uint32_t atom, task::PredicateId predicate, std::span<const task::ObjectId> objects);

  /// Returns the atoms in the order of their addition.
  std::span<const std::uint32_t> of(task::PredicateId predicate) const { return predicates_[predicate].all; }
  std::span<const std::uint32_t> of(task::PredicateId predicate, std::size_t position,
                                    task::ObjectId object) const;
  bool contains(std::uint32_t atom) const { return atom < present_.size() && present_[atom]; }

 private:
  struct Lists {
    std::vector<std::uint32_t> all;
    // Has the list of an object at a position at index position · objects + object; it is empty until the
    // first atom.
    std::vector<std::vector<std::uint32_t>> by_place;
  };

  std::size_t objects_;
  task::IdVector<task::PredicateId, Lists> predicates_;
  std::vector<bool> present_;
};

}  // namespace roci::planner::temporal_pddl::grounding::reachability
