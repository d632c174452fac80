// Large neighbourhood search (Shaw 1998; destroy and repair, Ropke and Pisinger 2006) varies plans: a part is
// taken out at random, the rest is completed again, and what comes out stays if it is no worse.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/improvement/plan_completion.hpp"
#include "planner_svc/temporal_pddl/improvement/plan_replay.hpp"

namespace roci::planner::temporal_pddl::improvement {

/// Varies plans of one task; it never makes one worse in metric and makespan.
class LargeNeighbourhoodSearch {
 public:
  LargeNeighbourhoodSearch(const search::SearchContext& context, std::span<const search::Guide> guides);

  struct Outcome {
    bool changed = false;
    std::size_t evaluations = 0;  ///< the evaluations that it took
  };
  /// Makes one try: the plan becomes another one of at most its metric and makespan, or stays.
  Outcome vary(search::PlanPrefix& plan, PlanReplay& replay);

 private:
  struct Unit {              // an action of the plan
    std::uint32_t step = 0;  // of its start
    temporal::Duration start{0};
    temporal::Duration end{0};
    task::ActionId action;
  };

  // Is a way to complete what is left, with what it has given so far.
  struct RepairRule {
    CompletionRule rule;
    std::size_t gains = 0;  // better plans
    std::size_t spent = 0;  // evaluations
  };

  RepairRule& choose_repair_rule();
  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(random_() % bound); }
  void find_units(const search::PlanPrefix& plan, PlanReplay& replay);
  std::size_t choose_size();
  void choose_stretch();
  void choose_object();
  void choose_late();

  const task::Task& task_;
  std::span<const search::Guide> guides_;
  PlanCompletion completion_;
  std::mt19937_64 random_;
  std::vector<RepairRule> repair_rules_;
  std::vector<Unit> units_;  // by start
  std::vector<std::uint32_t> dropped_;
};

}  // namespace roci::planner::temporal_pddl::improvement
