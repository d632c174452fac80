#include "planner_svc/temporal_pddl/grounding/reachability/atom_index.hpp"

namespace roci::planner::temporal_pddl::grounding::reachability {

using task::ObjectId;
using task::PredicateId;

void AtomIndex::add(std::uint32_t atom, PredicateId predicate, std::span<const ObjectId> objects) {
  if (atom >= present_.size()) present_.resize(atom + 1, false);
  present_[atom] = true;
  Lists& lists = predicates_[predicate];
  lists.all.push_back(atom);
  lists.by_place.resize(objects.size() * objects_);
  for (std::size_t position = 0; position < objects.size(); ++position) {
    lists.by_place[position * objects_ + objects[position].index()].push_back(atom);
  }
}

std::span<const std::uint32_t> AtomIndex::of(PredicateId predicate, std::size_t position,
                                             ObjectId object) const {
  const Lists& lists = predicates_[predicate];
  if (lists.by_place.empty()) return {};
  return lists.by_place[position * objects_ + object.index()];
}

}  // namespace roci::planner::temporal_pddl::grounding::reachability
