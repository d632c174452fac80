// The atoms known to be reachable, found by predicate and by the object at a position.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/tuple_table.hpp"
#include "planner_svc/temporal_pddl/task/ids.hpp"

namespace roci::planner::temporal_pddl {

class AtomIndex {
 public:
  AtomIndex(std::size_t predicates, std::size_t objects) : objects_(objects), predicates_(predicates) {}

  // Atoms are added in ascending order of their numbers in `atoms`' order of reach; each once.
  void add(std::uint32_t atom, PredicateId predicate, std::span<const ObjectId> objects);

  // Each list in the order of addition.
  std::span<const std::uint32_t> of(PredicateId predicate) const { return predicates_[predicate].all; }
  std::span<const std::uint32_t> of(PredicateId predicate, std::size_t position, ObjectId object) const;
  bool contains(std::uint32_t atom) const { return atom < present_.size() && present_[atom]; }

 private:
  struct Lists {
    std::vector<std::uint32_t> all;
    std::vector<std::vector<std::uint32_t>>
        by_place;  // position · objects + object; empty until the first atom
  };

  std::size_t objects_;
  IdVector<PredicateId, Lists> predicates_;
  std::vector<bool> present_;
};

}  // namespace roci::planner::temporal_pddl
