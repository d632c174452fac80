// The best supporters of relaxed propositions by h_add are the operators that make each true with the fewest
// actions before it (Bonet and Geffner 2001; Keyder and Geffner 2008), weighed by the operator costs.
//
// They are explored in order of cost, and only as far as is asked. Comparisons count as propositions; they
// follow those of the relaxed task.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/bucket_queue.hpp"
#include "planner_svc/temporal_pddl/heuristics/earliest_times.hpp"
#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/heuristics/numeric_relaxation.hpp"
#include "planner_svc/temporal_pddl/heuristics/operator_costs.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

namespace roci::planner::temporal_pddl::heuristics {

/// Finds best supporters in one state after the other. All that it is given must outlive it.
class BestSupporters {
 public:
  BestSupporters(const task::Task& task, const RelaxedTask& relaxed, const NumericRelaxation& numbers);

  /// Begins with what holds in the context. `times` names operators that can no longer happen; with null any
  /// can. Both must last until the next call.
  void begin(const EvaluationContext& context, const EarliestTimes* times);

  /// Returns whether it can ever hold, or happen. What the functions below say of it is known then.
  bool reaches(PropositionId proposition);
  bool reaches(task::SnapId op);

  /// Returns the cost of what is reached: the sum over the operators, those counted several times that are
  /// needed several times.
  BucketQueue::Cost cost(PropositionId proposition) const { return reached_[proposition].cost; }
  BucketQueue::Cost cost(task::SnapId op) const;
  const OperatorCosts& operator_costs() const { return operator_costs_; }
  /// Returns the best supporter, or none for what holds from the beginning.
  task::SnapId supporter(PropositionId proposition) const { return reached_[proposition].supporter; }
  /// Returns whether it happens, as far as is known: all that cost as much are known once reach_all() was
  /// called.
  bool happens(task::SnapId op) const { return open_[op] == 0 && !too_late(op); }
  /// Explores all that costs no more.
  void reach_all(BucketQueue::Cost cost) {
    while (frontier_ <= cost && advance()) {
    }
  }
  /// Returns whether there is another supporter that is as cheap.
  bool tied(PropositionId proposition) const { return reached_[proposition].tied; }
  /// Returns how often the supporter has to be applied.
  std::int64_t repeats(ComparisonId comparison) const { return repeats_[comparison]; }
  /// Returns one of the cheapest operators that raise a comparison even if it holds already, or none if
  /// nothing within reach does.
  task::SnapId producer(ComparisonId comparison);

  std::size_t propositions() const { return reached_.size(); }
  std::size_t bytes() const {
    return reached_.bytes() + at_first_.bytes() + open_.bytes() + operator_costs_.bytes();
  }
  PropositionId proposition(ComparisonId comparison) const {
    return PropositionId(relaxed_.propositions() + comparison.index());
  }

 private:
  using Cost = BucketQueue::Cost;
  using Count = std::uint16_t;
  static constexpr Cost kUnreached = BucketQueue::kMostCost + 1;

  struct Reached {
    Cost cost = kUnreached;
    task::SnapId supporter;
    bool tied = false;
  };

  // Goes on with the cheapest proposition. Returns false if there is none left.
  bool advance();
  // Returns whether the proposition becomes cheaper so.
  bool reach(PropositionId proposition, Cost cost, task::SnapId supporter);
  void fire(task::SnapId op);
  void raise_numbers(task::SnapId op, Cost cost);
  bool too_late(task::SnapId op) const { return times_ && times_->of(op) == temporal::no_bound; }
  std::span<const task::SnapId> needed_by(PropositionId proposition) const;

  const task::Task& task_;
  const RelaxedTask& relaxed_;
  const NumericRelaxation& numbers_;
  OperatorCosts operator_costs_;
  bool has_numbers_;
  task::StateView state_;
  const EarliestTimes* times_ = nullptr;

  task::IdVector<PropositionId, Reached> reached_;
  task::IdVector<task::SnapId, Count> at_first_, open_;  // needs that are not reached
  task::IdVector<ComparisonId, std::int64_t> repeats_;
  task::IdVector<ComparisonId, task::SnapId> producers_;
  BucketQueue queue_;
  Cost frontier_ = 0;  // what costs no more is known
};

}  // namespace roci::planner::temporal_pddl::heuristics
