#include "planner_svc/temporal_pddl/improvement/improvement.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "planner_svc/temporal_pddl/grounding/refusal.hpp"
#include "planner_svc/temporal_pddl/improvement/elimination.hpp"
#include "planner_svc/temporal_pddl/improvement/neighbourhood.hpp"

namespace roci::planner::temporal_pddl {

namespace {

// Taken again in one elimination: keeps it to about a tenth of a second.
constexpr std::size_t kStepsTakenAgain = 20'000;
constexpr std::size_t kFirstLimit = 25;  // evaluations of one search; twice as many in each round
constexpr std::size_t kVariations = 4;   // times as many for variations of the plan before
constexpr std::size_t kFreshStarts = 4;  // for other first plans, if one of the last round's was better
constexpr std::array<std::int64_t, 4> kWeights = {5, 3, 2, 1};

class Improvement {
 public:
  Improvement(const Task& task, PlanPrefix& plan, std::span<const Guide> guides, FreshStarts& fresh_starts,
              const Options& options, Watch& watch, Statistics& statistics)
      : task_(task),
        plan_(plan),
        guides_(guides),
        fresh_starts_(fresh_starts),
        options_(options),
        watch_(watch),
        statistics_(statistics),
        replay_(task, options.epsilon),
        neighbourhood_(task, guides, options, watch, statistics) {}

  void run() {
    drop_useless();
    std::size_t left = options_.improvement_evaluations;
    std::size_t fresh_starts = 1;
    for (std::size_t limit = kFirstLimit; left > 0; limit *= 2) {
      vary(kVariations * limit, left);
      fresh_starts = start_afresh(fresh_starts * limit, left) ? kFreshStarts : 1;
      bool exhausted = left > 0;
      for (const std::int64_t weight : kWeights) {
        for (const Guide& guide : guides_) exhausted = search(guide, weight, limit, left) && exhausted;
      }
      if (exhausted) return;
    }
  }

 private:
  void drop_useless() { drop_useless_actions(task_, plan_, replay_, kStepsTakenAgain, watch_); }

  // True: to a better plan.
  bool start_afresh(std::size_t evaluations, std::size_t& left) {
    bool better = false;
    for (std::size_t spent = 0; spent < evaluations && left > 0 && fresh_starts_.promising();) {
      auto outcome = fresh_starts_.next(std::min(evaluations - spent, left));
      spent += outcome.evaluations;
      left -= std::min(left, outcome.evaluations);
      if (!outcome.plan) continue;
      drop_useless_actions(task_, *outcome.plan, replay_, kStepsTakenAgain, watch_);
      const Quality known = quality_of(task_, plan_, replay_.check());
      if (quality_of(task_, *outcome.plan, replay_.check()) >= known) continue;
      plan_ = std::move(*outcome.plan);
      better = true;
    }
    return better;
  }

  // Walks through plans that are no worse from one to the next, and keeps the best.
  void vary(std::size_t evaluations, std::size_t& left) {
    PlanPrefix current = plan_;
    Quality best = quality_of(task_, plan_, replay_.check());
    Ticks starts = starts_of(task_, plan_, replay_.check());
    for (std::size_t spent = 0; spent < evaluations && left > 0;) {
      watch_.poll();
      const auto outcome = neighbourhood_.vary(current, replay_);
      spent += outcome.evaluations;
      left -= std::min(left, outcome.evaluations);
      if (!outcome.changed) continue;
      const Quality quality = quality_of(task_, current, replay_.check());
      if (quality.metric == best.metric && quality.makespan == best.makespan && quality.busy > best.busy)
        continue;
      drop_useless_actions(task_, current, replay_, kStepsTakenAgain, watch_);
      const Quality tidy = quality_of(task_, current, replay_.check());
      const Ticks tidy_starts = starts_of(task_, current, replay_.check());
      if (tidy > best || (tidy == best && tidy_starts >= starts)) continue;
      best = tidy;
      starts = tidy_starts;
      plan_ = current;
    }
  }

  // True: nothing better is left to be found. No work is left: that is not known.
  bool search(const Guide& guide, std::int64_t weight, std::size_t limit, std::size_t& left) {
    while (left > 0) {
      const Quality known = quality_of(task_, plan_, replay_.check());
      const WeightedSearchLimits limits{weight, std::min(limit, left)};
      auto better = find_better(task_, known, guide, options_, limits, watch_, statistics_);
      left -= better.evaluations;
      if (!better.plan) return better.exhausted;
      plan_ = std::move(*better.plan);
      drop_useless();
    }
    return false;
  }

  const Task& task_;
  PlanPrefix& plan_;
  std::span<const Guide> guides_;
  FreshStarts& fresh_starts_;
  const Options& options_;
  Watch& watch_;
  Statistics& statistics_;
  Replay replay_;
  Neighbourhood neighbourhood_;
};

}  // namespace

PlanPrefix improve(const Task& task, PlanPrefix first, std::span<const Guide> guides,
                   FreshStarts& fresh_starts, const Options& options, Watch& watch, Statistics& statistics) {
  PlanPrefix plan = std::move(first);
  try {
    Improvement(task, plan, guides, fresh_starts, options, watch, statistics).run();
  } catch (const Refusal& refusal) {
    if (refusal.verdict() == Verdict::cancelled) throw;
  } catch (const std::bad_alloc&) {  // what was found stands
  }
  return plan;
}

}  // namespace roci::planner::temporal_pddl
