// Finds the bindings of one action's parameters under which its positive conditions are reachable, without
// enumerating the product of the parameters' types: a join over the reachable atoms, smallest candidate list
// first.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/atom_index.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/world.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

class SchemaJoin {
 public:
  SchemaJoin(const LiftedAction& action, const World& world);

  // The atoms that must be reachable before the action can start: fluents first.
  const std::vector<LiftedAtom>& fluents() const { return fluents_; }
  // Positive fluent conditions that may hold only after the start: `at end` ones, and `over all` ones that
  // the action's own start might bring about.
  const std::vector<LiftedAtom>& deferred() const { return deferred_; }

  using Found = std::function<void(Binding&)>;

  // All bindings in which fluents()[trigger] is the newest atom `atom`, which is in the index already.
  void join(std::size_t trigger, std::uint32_t atom, const TupleTable& atoms, const AtomIndex& index,
            Watch& watch, const Found& found) const;
  // All bindings of an action without fluents().
  void join_static(const TupleTable& atoms, const AtomIndex& index, Watch& watch, const Found& found) const;

 private:
  struct Search;

  const LiftedAction& action_;
  std::vector<LiftedAtom> fluents_, statics_, deferred_;
  std::vector<std::pair<Argument, Argument>> different_;  // (not (= a b))
  std::vector<std::vector<bool>> allowed_;                // by parameter and object
};

}  // namespace roci::planner::temporal_pddl
