// Prunes a state if an equal one is stored whose plan leaves at least as much freedom in time.
//
// Goes beyond R26 (Stellar keeps all duplicates) without losing a solution. What a plan's network means for
// the steps to come is only: how early each variable may be read, changed, or deleted under an invariant; and
// how the starts of running actions lie to these points, to each other, and to their latest times, since a
// future end is tied to its start from both sides. If in the stored plan all longest paths from the origin
// and from each running start to these points are at most those of the new plan, and the latest times of the
// running starts at least those of the new plan, then every schedule of a continuation of the new plan is one
// of the same continuation of the stored plan. "Equal" means: the same packed state and numbers, the same
// running actions, as many timed literals.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"

namespace roci::planner::temporal_pddl {

class Dominance {
 public:
  Dominance(const Task& task, const StateStore& store, const BoundTable& bounds, TemporalCheck& check,
            Duration epsilon);

  // state, prefix: of a state that is not stored yet.
  bool dominated(StateView state, const PlanPrefix& prefix);
  void insert(NodeId node, StateView state, const PlanPrefix& prefix);

  std::size_t bytes() const { return slots_.capacity() * sizeof(Slot); }

 private:
  struct Slot {
    NodeId node;
    std::uint32_t hash = 0;
  };
  // How soon after a source each variable is free, longest paths in microseconds.
  struct Freedom {
    Ticks read = kNoPath;    // for conditions: after the last change
    Ticks change = kNoPath;  // for adding: also after the last readers
    Ticks erase = kNoPath;   // for other changes: also after the ends of invariants
  };
  struct Profile {
    std::vector<VariableId> touched;  // ascending
    std::vector<std::vector<Freedom>>
        freedoms;  // by source (origin, running starts by action), by touched variable
    std::vector<std::vector<Ticks>> starts;  // by source: longest paths to the running starts
    std::vector<Ticks> latest;               // of the running starts
  };
  static constexpr std::size_t kMaxComparisons = 16;

  static std::uint32_t hash(StateView state, const PlanPrefix& prefix);
  Profile profile(const PlanPrefix& prefix);
  std::vector<Freedom> freedoms(const PlanPrefix& prefix, const std::vector<Ticks>& distances,
                                const std::vector<VariableId>& touched);
  static bool no_worse(const Profile& stored, const Profile& fresh);
  void place(Slot slot);

  const Task& task_;
  const StateStore& store_;
  const BoundTable& bounds_;
  TemporalCheck& check_;
  Duration epsilon_;
  std::vector<Slot> slots_;  // open addressing, a power of two; none: free
  std::size_t size_ = 0;
  IdVector<VariableId, Freedom> scratch_;
  PlanPrefix other_;
};

}  // namespace roci::planner::temporal_pddl
