// A relaxed plan is made of the operators that bring about what is needed, by their supporters, and of how
// often each of them does.
//
// Where windows and deadlines count, the supporter of a fact is the operator that can come first, by the
// times of the plan so far, and not that which takes the fewest actions: so work goes to whoever is free
// soonest, before it is too late.
//
// Deletes do not count for facts. For numbers they do, as a sum over the whole plan (in the manner of the
// resource estimates of LPRPG, Coles et al. 2008): what the operators take of a number, beyond what there is
// and what others give, a producer has to be repeated for. So comparisons are settled from those that take
// the most actions down to those that hold already: when the turn of one comes, all that takes of it is
// known.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/best_supporters.hpp"
#include "planner_svc/temporal_pddl/heuristics/earliest_times.hpp"
#include "planner_svc/temporal_pddl/heuristics/numeric_relaxation.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

namespace roci::planner::temporal_pddl::heuristics {

/// Makes one relaxed plan after the other. All that it is given must outlive it.
class RelaxedPlan {
 public:
  RelaxedPlan(const task::Task& task, const RelaxedTask& relaxed, const NumericRelaxation& numbers,
              BestSupporters& supporters);

  /// Empties the plan. The state is that in which the supporters begin, and must last as long. `times` are
  /// measured in it, and facts are supported by what comes soonest then; with null, by what takes the fewest
  /// actions.
  void begin(task::StateView state, const EarliestTimes* times);
  /// Asks for the goal, all of which must be within reach of the supporters.
  void need(const task::Goal& goal);
  void need_fact(task::FactId fact) { need(relaxed_.proposition(fact)); }
  void include(task::SnapId op);
  /// Adds what is missing.
  void complete();
  /// Does as complete() with some care that the plan can be carried out: among equally cheap supporters it
  /// takes what undoes the fewest of the facts that the plan needs and that hold already.
  void complete_with_care();

  /// Returns the operators in no order.
  std::span<const task::SnapId> operators() const { return plan_; }
  /// Returns the operator that was taken for it, or none.
  task::SnapId support(PropositionId proposition) const { return supports_[proposition]; }
  std::size_t bytes() const {
    return repeats_.bytes() + passes_.bytes() + is_needed_.bytes() + given_.bytes() + supports_.bytes();
  }
  /// Returns how often the operator is applied; 0 if it is not in the plan.
  std::int64_t times(task::SnapId op) const { return repeats_[op]; }

 private:
  struct Balance {
    bool needed = false, needed_at_end = false;
    bool queued = false;
    std::uint8_t turns = 0;
    double least = 0;  // that the plan has to leave
  };

  void need(PropositionId proposition);
  void need_before(task::SnapId op, ComparisonId comparison);
  void need_at_end(ComparisonId comparison);
  task::SnapId supporter(PropositionId proposition);
  void support_facts();
  void support(PropositionId proposition, task::SnapId supporter);
  task::SnapId least_harmful(PropositionId proposition);
  std::size_t harm(task::SnapId op) const;
  void give(task::SnapId op);
  void queue(ComparisonId comparison);
  void settle(ComparisonId comparison);
  void bring_in(task::SnapId op);
  void repeat(task::SnapId op, std::int64_t times);
  // Notes more applications of an operator.
  void apply(task::SnapId op, std::int64_t times);
  // Returns the balance of a comparison that the plan needs.
  Balance& ask(ComparisonId comparison);

  const task::Task& task_;
  const RelaxedTask& relaxed_;
  const NumericRelaxation& numbers_;
  BestSupporters& supporters_;
  task::StateView state_;
  const EarliestTimes* times_ = nullptr;

  task::IdVector<task::SnapId, std::int64_t> repeats_;
  std::vector<task::SnapId> plan_;
  task::IdVector<PropositionId, bool> passes_;  // is deleted by the end of an action whose start adds it
  task::IdVector<PropositionId, bool> is_needed_, given_;
  task::IdVector<PropositionId, task::SnapId> supports_;
  std::vector<PropositionId> needed_, to_support_, to_share_, to_choose_, given_now_;
  bool careful_ = false;
  task::IdVector<ComparisonId, Balance> balances_;
  std::vector<ComparisonId> asked_;                                    // those that are needed
  task::IdVector<FormId, double> changes_;                             // by all of the plan
  std::vector<FormId> changed_;                                        // changes in use, some more than once
  std::vector<std::pair<BucketQueue::Cost, ComparisonId>> to_settle_;  // a heap, the dearest first
  std::int64_t repeats_left_ = 0;
};

}  // namespace roci::planner::temporal_pddl::heuristics
