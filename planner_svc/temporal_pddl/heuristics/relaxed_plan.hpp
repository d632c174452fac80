// A relaxed plan: the operators that bring about what is needed, by their supporters, and how often each.
//
// Where windows and deadlines count, a fact's supporter is the operator that can come first, by the times of
// the plan so far, and not that which takes the fewest actions: so work goes to whoever is free soonest,
// before it is too late.
//
// Deletes do not count for facts. For numbers they do, as a sum over the whole plan (in the manner of the
// resource estimates of LPRPG, Coles et al. 2008): what the operators take of a number, beyond what there is
// and what others give, a producer has to be repeated for. So comparisons are settled from those that take
// the most actions down to those that hold already: when one's turn comes, all that takes of it is known.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/earliest_times.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_numbers.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"
#include "planner_svc/temporal_pddl/heuristics/supporters.hpp"

namespace roci::planner::temporal_pddl {

class RelaxedPlan {
 public:
  RelaxedPlan(const Task& task, const RelaxedTask& relaxed, const RelaxedNumbers& numbers,
              Supporters& supporters);

  // Empties it. The state is that in which the supporters begin, and must last as long. times: measured in
  // it; facts are supported by what comes soonest then. Null: by what takes the fewest actions.
  void begin(StateView state, const EarliestTimes* times);
  // All of it must be within reach of the supporters.
  void need(const Goal& goal);
  void need_fact(FactId fact) { need(relaxed_.proposition(fact)); }
  void include(SnapId op);
  // Adds what is missing.
  void complete();
  // As complete(), with some care that the plan can be carried out: among equally cheap supporters it takes
  // what undoes the fewest of the facts that the plan needs and that hold already.
  void complete_with_care();

  // In no order.
  std::span<const SnapId> operators() const { return plan_; }
  // What was taken for it; none: nothing.
  SnapId support(PropositionId proposition) const { return supports_[proposition]; }
  std::size_t bytes() const {
    return repeats_.bytes() + passes_.bytes() + is_needed_.bytes() + given_.bytes() + supports_.bytes();
  }
  // How often it is applied. 0: it is not in the plan.
  std::int64_t times(SnapId op) const { return repeats_[op]; }

 private:
  struct Balance {
    bool touched = false;
    bool needed = false, needed_at_end = false;
    bool queued = false;
    std::uint8_t turns = 0;
    double least = 0;   // that the plan has to leave
    double change = 0;  // by all of the plan
  };

  void need(PropositionId proposition);
  void need_before(SnapId op, ComparisonId comparison);
  void need_at_end(ComparisonId comparison);
  SnapId supporter(PropositionId proposition);
  void support_facts();
  void support(PropositionId proposition, SnapId supporter);
  SnapId least_harmful(PropositionId proposition);
  std::size_t harm(SnapId op) const;
  void give(SnapId op);
  // Queues the comparison if it is needed.
  void queue(ComparisonId comparison);
  void settle(ComparisonId comparison);
  void bring_in(SnapId op);
  void repeat(SnapId op, std::int64_t times);
  // Notes more applications of an operator.
  void apply(SnapId op, std::int64_t times);
  Balance& touch(ComparisonId comparison);

  const Task& task_;
  const RelaxedTask& relaxed_;
  const RelaxedNumbers& numbers_;
  Supporters& supporters_;
  StateView state_;
  const EarliestTimes* times_ = nullptr;

  IdVector<SnapId, std::int64_t> repeats_;
  std::vector<SnapId> plan_;
  IdVector<PropositionId, bool> passes_;  // is deleted by the end of an action whose start adds it
  IdVector<PropositionId, bool> is_needed_, given_;
  IdVector<PropositionId, SnapId> supports_;
  std::vector<PropositionId> needed_, to_support_, to_share_, to_choose_, given_now_;
  bool careful_ = false;
  IdVector<ComparisonId, Balance> balances_;
  std::vector<ComparisonId> touched_;                                  // balances in use
  std::vector<std::pair<BucketQueue::Cost, ComparisonId>> to_settle_;  // a heap, the dearest first
  std::int64_t repeats_left_ = 0;
};

}  // namespace roci::planner::temporal_pddl
