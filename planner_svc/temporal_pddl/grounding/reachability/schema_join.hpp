// A schema join finds the bindings of one action's parameters under which its positive conditions are
// reachable. It joins the reachable atoms, smallest candidate list first, and does not enumerate the product
// of the parameters' types.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/static_model.hpp"
#include "planner_svc/temporal_pddl/grounding/reachability/atom_index.hpp"

namespace roci::planner::temporal_pddl::grounding::reachability {

/// Joins for one action. The action must outlive it.
class SchemaJoin {
 public:
  SchemaJoin(const lifted::LiftedAction& action, const lifted::StaticModel& static_model);

  /// Returns the atoms that must be reachable before the action can start: fluents first.
  const std::vector<lifted::LiftedAtom>& fluents() const { return fluents_; }
  /// Returns positive fluent conditions that may hold only after the start: `at end` ones, and `over all`
  /// ones that the own start of the action might bring about.
  const std::vector<lifted::LiftedAtom>& deferred() const { return deferred_; }

  using Found = std::function<void(lifted::Binding&)>;

  /// Finds all bindings in which fluents()[trigger] is the newest atom `atom`, which is in the index
  /// already.
  void join(std::size_t trigger, std::uint32_t atom, const lifted::TupleTable& atoms, const AtomIndex& index,
            call::SearchLimits& limits, const Found& found) const;
  /// Finds all bindings of an action without fluents().
  void join_static(const lifted::TupleTable& atoms, const AtomIndex& index, call::SearchLimits& limits,
                   const Found& found) const;

 private:
  struct Search;

  const lifted::LiftedAction& action_;
  std::vector<lifted::LiftedAtom> fluents_, statics_, deferred_;
  std::vector<std::pair<lifted::Argument, lifted::Argument>> different_;  // (not (= a b))
  std::vector<std::vector<bool>> allowed_;                                // by parameter and object
};

}  // namespace roci::planner::temporal_pddl::grounding::reachability
