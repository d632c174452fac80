// Dominance prunes a state if an equal one is stored whose plan leaves at least as much freedom in time.
//
// It goes beyond R26 (Stellar keeps all duplicates) without losing a solution. What a plan's network means
// for the steps to come is only: how early each variable may be read, changed, or deleted under an invariant;
// and how the starts of running actions lie to these points, to each other, and to their latest times, since
// a future end is tied to its start from both sides. If in the stored plan all longest paths from the origin
// and from each running start to these points are at most those of the new plan, and the latest times of the
// running starts at least those of the new plan, then every schedule of a continuation of the new plan is one
// of the same continuation of the stored plan. States are equal if they have the same packed state and
// numbers, the same running actions and as many timed literals.
//
// Where it does not matter when a plan happens as a whole, the origin is no source; and if nothing runs
// either, no time matters and equal states are enough.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/successor_builder.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"
#include "planner_svc/temporal_pddl/task/numeric_dominance.hpp"

namespace roci::planner::temporal_pddl::search {

/// Remembers plans and says of a new one whether it is dominated. All that it is given must outlive it.
class Dominance {
 public:
  /// Prepares an empty set of plans. With `end_counts` the time of the last step matters, because plans have
  /// deadlines or shorter ones are wanted; with `metric_counts` so do the numbers of the metric.
  Dominance(const task::Task& task, const StateStore& store, const constraints::BoundTable& bounds,
            TemporalCheck& check, temporal::Duration epsilon, bool end_counts, bool metric_counts = false);

  /// Returns whether a stored plan dominates that of a state which is not stored yet and whose prefix names
  /// its parent. The same plan as a stored one is dominated.
  bool dominated(const Successor& successor);
  void insert(NodeId node, task::StateView state, const PlanPrefix& prefix);

  /// Forgets all plans.
  void clear() {
    std::ranges::fill(slots_, Slot{});
    size_ = 0;
  }

  std::size_t bytes() const { return slots_.capacity() * sizeof(Slot); }

 private:
  struct Slot {
    NodeId node;
    std::uint32_t hash = 0;
  };
  // Tells how soon after a source a variable is free, as longest paths in microseconds.
  struct Release {
    temporal::Duration read = constraints::kNoPath;    // for conditions: after the last change
    temporal::Duration change = constraints::kNoPath;  // for adding: also after the last readers
    temporal::Duration erase = constraints::kNoPath;   // for other changes: also after the ends of invariants
  };
  // Sources are the origin, if it is one, and then the running starts, by action.
  struct Profile {
    std::vector<task::VariableId> touched;
    std::vector<std::vector<Release>> releases;  // by source, by position in touched
    // Holds by source the longest paths to the running starts (and the last step).
    std::vector<std::vector<temporal::Duration>> starts;
    std::vector<temporal::Duration> latest;  // of the running starts
  };
  static constexpr std::size_t kMaxComparisons = 16;
  static constexpr std::uint32_t kAbsent = 0xffffffff;

  std::uint32_t hash(task::StateView state, const PlanPrefix& prefix) const;
  bool as_good(task::StateView stored, task::StateView fresh) const;
  // A stored plan is taken with the windows in which its least schedule lies, a new one with all the time
  // between its windows: so the comparison errs on the safe side.
  Profile profile(const PlanPrefix& prefix, bool stored);
  void find_touched(const PlanPrefix& prefix, std::vector<task::VariableId>& touched);
  std::vector<Release> releases(const PlanPrefix& prefix, const std::vector<temporal::Duration>& distances,
                                std::size_t touched) const;
  bool no_worse(const Profile& stored, const Profile& fresh);
  void place(Slot slot);

  const task::Task& task_;
  const StateStore& store_;
  const constraints::BoundTable& bounds_;
  TemporalCheck& check_;
  temporal::Duration epsilon_;
  bool end_counts_;
  bool absolute_;  // the origin is a source
  task::IdVector<task::NumberId, task::NumericDominance> preferences_;
  std::vector<Slot> slots_;  // open addressing, a power of two; none: free
  std::size_t size_ = 0;
  // Holds the position in `touched` of the profile at hand, else kAbsent.
  task::IdVector<task::VariableId, std::uint32_t> position_;
  PlanPrefix other_;
};

}  // namespace roci::planner::temporal_pddl::search
