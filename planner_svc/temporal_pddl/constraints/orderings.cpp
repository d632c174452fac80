#include "planner_svc/temporal_pddl/constraints/orderings.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::constraints {

using task::ActionId, task::FactId, task::Snap, task::SnapId, task::SnapKind, task::Task, task::VariableId;
using temporal::Duration, temporal::no_bound;

Orderings::Orderings(const Task& task, Duration epsilon)
    : task_(task), epsilon_(epsilon), interests_(task.variables(), 0) {}

void Orderings::mark(VariableId variable, std::uint8_t interest) {
  if (interests_[variable] == 0) marked_.push_back(variable);
  interests_[variable] |= interest;
}

void Orderings::mark_new_step(SnapId next, std::span<const ActionId> running) {
  for (const VariableId variable : task_.reads[next]) mark(variable, reads);
  for (const VariableId variable : task_.writes[next]) mark(variable, changes);
  for (const FactId added : task_.adds[next]) {
    std::uint8_t& interest = interests_[task_.variable(added)];
    if (interest & changes) interest = static_cast<std::uint8_t>((interest & ~changes) | adds);
  }
  const Snap& snap = task_.snaps[next];
  if (snap.kind == SnapKind::start) {
    for (const VariableId variable : task_.invariant_reads[snap.action]) mark(variable, guards);
  }
  for (const ActionId action : running) {
    if (snap.kind == SnapKind::end && snap.action == action) continue;  // its invariants end before
    const auto derived = task_.derived_invariant_reads[action];
    if (std::ranges::any_of(derived,
                            [&](VariableId variable) { return (interests_[variable] & changes) != 0; })) {
      for (const VariableId variable : derived) mark(variable, reads);
    }
    for (const auto& invariant : task_.numeric_invariants[action]) {
      const auto& terms = task_.expressions[invariant.expression].terms;
      const auto changed = [&](const auto& term) {
        return (interests_[task_.variable(term.variable)] & changes) != 0;
      };
      if (terms.size() < 2 || std::ranges::none_of(terms, changed)) continue;
      for (const auto& term : terms) mark(task_.variable(term.variable), reads);
    }
  }
}

bool Orderings::only_adds(SnapId step, VariableId variable) const {
  return std::ranges::any_of(task_.adds[step],
                             [&](FactId added) { return task_.variable(added) == variable; });
}

bool Orderings::writes(SnapId step, VariableId variable) const {
  return std::ranges::find(task_.writes[step], variable) != task_.writes[step].end();
}

void Orderings::add(std::span<const SnapId> steps, SnapId next, std::span<const ActionId> running,
                    std::vector<StepConstraint>& constraints) {
  marked_.clear();
  mark_new_step(next, running);
  std::size_t open = marked_.size();
  for (std::size_t i = steps.size(); i-- > 0 && open > 0;) {
    const SnapId step = steps[i];
    bool separated = false;
    bool after = false;
    for (const VariableId variable : task_.reads[step]) {
      separated = separated || (interests_[variable] & (adds | changes)) != 0;
    }
    if (task_.snaps[step].kind == SnapKind::end) {
      for (const VariableId variable : task_.invariant_reads[task_.snaps[step].action]) {
        // A step that writes the variable too is ordered before the adding step, and so before the new one.
        const bool open_end = interests_[variable] == ends && !writes(step, variable);
        after = after || open_end || (interests_[variable] & changes) != 0;
      }
    }
    for (const VariableId variable : task_.writes[step]) {
      std::uint8_t& interest = interests_[variable];
      if (interest == 0) continue;
      if (interest != ends) (interest == guards ? after : separated) = true;
      // What lies before this step is ordered through it, except that an adding step is before no invariant's
      // end.
      const bool ends_open = (interest & (changes | ends)) != 0 && only_adds(step, variable);
      interest = ends_open ? ends : 0;
      if (!ends_open) --open;
    }
    if (!separated && !after) continue;
    constraints.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(steps.size()),
                           separated ? epsilon_ : Duration{0}, no_bound});
  }
  for (const VariableId variable : marked_) interests_[variable] = 0;
}

}  // namespace roci::planner::temporal_pddl::constraints
