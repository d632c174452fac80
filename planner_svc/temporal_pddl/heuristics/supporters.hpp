// How propositions of the relaxed task come to hold: by h_add, which operator makes each true with the fewest
// actions before it (Bonet and Geffner 2001), by their prices. Explored in order of cost, and only as far as
// is asked.
//
// Comparisons count as propositions; they follow those of the relaxed task.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/bucket_queue.hpp"
#include "planner_svc/temporal_pddl/heuristics/earliest_times.hpp"
#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/heuristics/prices.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_numbers.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

namespace roci::planner::temporal_pddl {

class Supporters {
 public:
  Supporters(const Task& task, const RelaxedTask& relaxed, const RelaxedNumbers& numbers);

  // Begins with what holds in the situation. times: of operators that can no longer happen; null: any can.
  // Both must last until the next call.
  void begin(const Situation& situation, const EarliestTimes* times);

  // Can it ever hold, or happen? What they say of it below is known then.
  bool reaches(PropositionId proposition);
  bool reaches(SnapId op);

  // Of what is reached. Prices of actions, those counted several times that are needed several times.
  BucketQueue::Cost cost(PropositionId proposition) const { return reached_[proposition].cost; }
  BucketQueue::Cost cost(SnapId op) const;
  const Prices& prices() const { return prices_; }
  // None: holds from the beginning.
  SnapId supporter(PropositionId proposition) const { return reached_[proposition].supporter; }
  // Of what may happen, as far as is known. Known are all that cost as much once reach_all() was called.
  bool happens(SnapId op) const { return open_[op] == 0 && !too_late(op); }
  // Explores all that costs no more.
  void reach_all(BucketQueue::Cost cost) {
    while (frontier_ <= cost && advance()) {
    }
  }
  // Is there another supporter that is as cheap?
  bool tied(PropositionId proposition) const { return reached_[proposition].tied; }
  // How often the supporter has to be applied.
  std::int64_t repeats(ComparisonId comparison) const { return repeats_[comparison]; }
  // What raises a comparison even if it holds already, one of the cheapest. None: nothing within reach does.
  SnapId producer(ComparisonId comparison);

  std::size_t propositions() const { return reached_.size(); }
  std::size_t bytes() const { return reached_.bytes() + at_first_.bytes() + open_.bytes() + prices_.bytes(); }
  PropositionId proposition(ComparisonId comparison) const {
    return PropositionId(relaxed_.propositions() + comparison.index());
  }

 private:
  using Cost = BucketQueue::Cost;
  using Count = std::uint16_t;
  static constexpr Cost kUnreached = BucketQueue::kMostCost + 1;

  struct Reached {
    Cost cost = kUnreached;
    SnapId supporter;
    bool tied = false;
  };

  // Goes on with the cheapest proposition. False: there is none left.
  bool advance();
  // True: so it is cheaper.
  bool reach(PropositionId proposition, Cost cost, SnapId supporter);
  void fire(SnapId op);
  void raise_numbers(SnapId op, Cost cost);
  bool too_late(SnapId op) const { return times_ && times_->of(op) == kNever; }
  std::span<const SnapId> needed_by(PropositionId proposition) const;

  const Task& task_;
  const RelaxedTask& relaxed_;
  const RelaxedNumbers& numbers_;
  Prices prices_;
  bool has_numbers_;
  StateView state_;
  const EarliestTimes* times_ = nullptr;

  IdVector<PropositionId, Reached> reached_;
  IdVector<SnapId, Count> at_first_, open_;  // needs that are not reached
  IdVector<ComparisonId, std::int64_t> repeats_;
  IdVector<ComparisonId, SnapId> producers_;
  BucketQueue queue_;
  Cost frontier_ = 0;  // what costs no more is known
};

}  // namespace roci::planner::temporal_pddl
