#include "planner_svc/temporal_pddl/refining.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "planner_svc/temporal_pddl/values/value_table.hpp"

namespace roci::planner::temporal_pddl {

using call::Statistics;
using engine::FunctionCall, engine::FunctionsMode;
using extraction::Activity, extraction::Plan;
using temporal::Verdict;
using values::ActionInstance, values::ActionTuples, values::ValueTable;

namespace {

// After so many rounds nothing is left cheap, so that a call does not go on for long.
constexpr std::size_t kMostRounds = 50;
// Likewise in lazy mode, where a round finds out about one place at a time: a search that looks everywhere has touched
// nearly all values in the end, and made as many searches as there are places (docs/adr/0019).
constexpr std::size_t kMostLazyRounds = 10;
// Evaluations for better plans in the first round that has no smaller budget for them; twice as many in each
// round after one whose values were right.
constexpr std::size_t kFirstImprovement = 2000;
constexpr std::size_t kEvaluationsForTiming = 1000;

std::vector<pddl::PlanStep> steps_of(const Plan& plan) {
  std::vector<pddl::PlanStep> steps;
  for (const Activity& activity : plan.activities) {
    pddl::PlanStep step;
    step.start = activity.start;
    if (activity.durative) step.duration = activity.end - activity.start;
    step.action.symbol = activity.name;
    for (const std::string& argument : activity.arguments) step.action.arguments.push_back({argument, {}});
    steps.push_back(std::move(step));
  }
  return steps;
}

class Refining {
 public:
  Refining(const RefinedCall& call, const MakeAttempt& attempt)
      : call_(call),
        attempt_(attempt),
        tuples_(call.domain, call.problem),
        values_(call.functions, call.options.functions, tuples_.read_by_all(),
                [this] { return cancelled(); }),
        improvement_(std::min(call.options.improvement_evaluations, kFirstImprovement)) {}

  Result run() {
    Result result = settled();
    Statistics& statistics = result.statistics;
    statistics = last_;
    statistics.evaluated = total_.evaluated;
    statistics.expanded = total_.expanded;
    statistics.generated = total_.generated;
    statistics.temporally_inconsistent = total_.temporally_inconsistent;
    statistics.dominated = total_.dominated;
    statistics.dead_ends = total_.dead_ends;
    statistics.peak_bytes = total_.peak_bytes;
    statistics.from_remaining = from_remaining_;
    statistics.rounds = rounds_;
    result.functions = values_.take_uses();
    for (const std::string& warning : values_.warnings()) result.warnings.push_back("warning: " + warning);
    return result;
  }

 private:
  Result settled() {
    while (true) {
      Result result = search();
      if (rounds_ == 1) from_remaining_ = result.statistics.from_remaining;
      if (!result.plan) {
        if (best_) return std::move(*best_);
        if (result.verdict != Verdict::unsolvable || values_.is_exact()) return result;
        values_.refine_all();
      } else if (const Candidate candidate = refine(*result.plan); candidate == Candidate::stands) {
        const bool whole = result.statistics.exhausted ||
                           improvement_ >= call_.options.improvement_evaluations || out_of_time();
        keep(std::move(result));
        if (whole) return std::move(*best_);
        improvement_ *= 2;
      } else if (candidate == Candidate::given_up ? end_rounds() : take_over(*result.plan)) {
        return std::move(*best_);
      }
      if (cancelled()) return cancelled_result();
    }
  }

  Result search() {
    ++rounds_;
    touched_.clear();
    Attempt attempt{values_, call_.budget, call_.options, call_.remaining};
    // What made cheap plans better is not what the first plan on exact values may take; beside one, all counts.
    const std::size_t spent = best_ ? total_.evaluated : total_.for_first_plan;
    attempt.budget.evaluations -= std::min(attempt.budget.evaluations, spent);
    attempt.options.improvement_evaluations = std::min(improvement_, call_.options.improvement_evaluations);
    std::vector<pddl::PlanStep> known;
    if (best_ && !is_lazy()) {
      known = steps_of(*best_->plan);
      attempt.remaining = known;
    }
    if (is_lazy()) attempt.touched = &touched_;
    Result result = counted(attempt);
    last_ = result.statistics;
    return result;
  }

  // What became of a plan whose values were asked for exactly: they were what they were taken for; some were
  // not; or the first ones have made it no better than the best plan, so that the others were not asked for.
  enum class Candidate { stands, differs, given_up };

  // Asks exactly for what the plan stands on, and what the search touched. Beside a better plan that is known
  // it asks by parts, as long as the plan promises more than that: function by function, durations first, and
  // each in two halves along the plan. As no bound is too high, what is left can only make the plan dearer.
  Candidate refine(const Plan& plan) {
    std::vector<FunctionCall> calls;
    for (const Activity& activity : plan.activities)
      tuples_.collect(activity.name, activity.arguments, calls);
    for (const ActionInstance& instance : touched_) tuples_.collect(instance, calls);
    if (!best_ || is_lazy()) return values_.refine(calls).changed ? Candidate::differs : Candidate::stands;
    bool differs = false;
    for (const std::span<const FunctionCall> part : parts_of(calls)) {
      if (!values_.refine(part).changed) continue;
      differs = true;
      if (!out_of_time() && !is_promising(timed(plan, false))) return Candidate::given_up;
    }
    return differs ? Candidate::differs : Candidate::stands;
  }

  // Sorts the calls by function, in the order in which functions appear, and returns two halves of each.
  static std::vector<std::span<const FunctionCall>> parts_of(std::vector<FunctionCall>& calls) {
    std::vector<std::span<const FunctionCall>> parts;
    for (auto begin = calls.begin(); begin != calls.end();) {
      const auto end = std::stable_partition(
          begin, calls.end(),
          [name = begin->function](const FunctionCall& call) { return call.function == name; });
      const auto middle = begin + (end - begin) / 2;
      if (middle != begin) parts.emplace_back(begin, middle);
      parts.emplace_back(middle, end);
      begin = end;
    }
    return parts;
  }

  bool is_promising(const Result& result) const {
    return result.plan && is_better(*result.plan, *best_->plan);
  }

  // Times the plan with exact values. Returns whether the call ends with the best plan.
  bool take_over(const Plan& plan) {
    if (!is_lazy() || out_of_time()) keep(timed(plan, true));
    return end_rounds();
  }

  // Returns whether the call ends with the best plan. Makes the next round the last one if there were many.
  bool end_rounds() {
    const bool last = rounds_ >= (is_lazy() ? kMostLazyRounds : kMostRounds);
    const bool accepts = !is_lazy() && (call_.options.improvement_evaluations == 0 || last);
    if (best_ && (accepts || out_of_time())) return true;
    if (last) values_.refine_all();
    return false;
  }

  // What this plan, or another one on the values that are known, or known exactly, comes to; without a clock,
  // as it is little work.
  Result timed(const Plan& plan, bool exact_alone) {
    const std::vector<pddl::PlanStep> steps = steps_of(plan);
    Attempt attempt{values_, call_.budget, call_.options, steps};
    attempt.budget.out_of_time = nullptr;
    attempt.budget.evaluations = kEvaluationsForTiming;
    attempt.options.improvement_evaluations = 0;
    values_.give_exact_alone(exact_alone);
    Result result = counted(attempt);
    values_.give_exact_alone(false);
    return result;
  }

  Result counted(Attempt attempt) {
    attempt.keeps_functions = false;  // the table has them
    Result result = attempt_(attempt);
    const Statistics& one = result.statistics;
    total_.evaluated += one.evaluated;
    total_.for_first_plan += one.for_first_plan;
    total_.expanded += one.expanded;
    total_.generated += one.generated;
    total_.temporally_inconsistent += one.temporally_inconsistent;
    total_.dominated += one.dominated;
    total_.dead_ends += one.dead_ends;
    total_.peak_bytes = std::max(total_.peak_bytes, one.peak_bytes);
    return result;
  }

  void keep(Result result) {
    if (result.plan && (!best_ || is_better(*result.plan, *best_->plan))) best_ = std::move(result);
  }

  bool is_better(const Plan& plan, const Plan& than) const {
    const auto& metric = call_.problem.metric;
    const bool maximized = metric && metric->sense == pddl::Metric::Sense::maximize;
    if (plan.metric != than.metric) return (plan.metric < than.metric) != maximized;
    return plan.makespan < than.makespan;
  }

  bool is_lazy() const { return call_.options.functions == FunctionsMode::lazy; }
  bool out_of_time() const { return call_.budget.out_of_time && call_.budget.out_of_time(); }
  bool cancelled() const { return call_.monitor.cancelled && call_.monitor.cancelled(); }

  static Result cancelled_result() {
    Result result;
    result.verdict = Verdict::cancelled;
    result.reason = "cancelled while waiting for external functions";
    return result;
  }

  const RefinedCall& call_;
  const MakeAttempt& attempt_;
  ActionTuples tuples_;
  ValueTable values_;
  std::size_t improvement_;  // evaluations for better plans in the next round
  std::vector<ActionInstance> touched_;
  std::optional<Result> best_;  // stands on exact values alone
  Statistics last_;             // of the newest round
  Statistics total_;            // of all rounds
  std::size_t rounds_ = 0;
  bool from_remaining_ = false;
};

}  // namespace

Result plan_refining(const RefinedCall& call, const MakeAttempt& attempt) {
  return Refining(call, attempt).run();
}

}  // namespace roci::planner::temporal_pddl
