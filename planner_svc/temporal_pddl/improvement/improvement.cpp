#include "planner_svc/temporal_pddl/improvement/improvement.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "planner_svc/temporal_pddl/call/planning_failure.hpp"
#include "planner_svc/temporal_pddl/improvement/action_elimination.hpp"
#include "planner_svc/temporal_pddl/improvement/large_neighbourhood_search.hpp"

namespace roci::planner::temporal_pddl::improvement {

using call::PlanningFailure;
using search::Guide;
using search::PlanPrefix;
using search::SearchContext;
using task::Task;
using temporal::Duration;
using temporal::Verdict;

namespace {

// So many steps are taken again in one elimination at most, which keeps it short.
constexpr std::size_t kStepsTakenAgain = 20'000;
constexpr std::size_t kFirstLimit = 25;  // evaluations of one search; twice as many in each round
constexpr std::size_t kVariations = 4;   // times as many for variations of the plan before
constexpr std::size_t kRestarts = 4;     // for other first plans, if one of the last round's was better
constexpr std::array<std::int64_t, 4> kSearchWeights = {5, 3, 2, 1};

class Improvement {
 public:
  Improvement(const SearchContext& context, PlanPrefix& plan, std::span<const Guide> guides,
              Restarts& restarts)
      : context_(context),
        task_(context.task),
        plan_(plan),
        guides_(guides),
        restarts_(restarts),
        replay_(task_, context.options.epsilon),
        neighbourhood_(context, guides) {}

  void run() {
    context_.limits.phase("improving the plan");
    drop_useless();
    tell();
    std::size_t left = context_.options.improvement_evaluations;
    std::size_t restarts = 1;
    for (std::size_t limit = kFirstLimit; left > 0; limit *= 2) {
      vary(kVariations * limit, left);
      restarts = restart(restarts * limit, left) ? kRestarts : 1;
      bool exhausted = left > 0;
      for (const std::int64_t weight : kSearchWeights) {
        for (const Guide& guide : guides_) exhausted = search(guide, weight, limit, left) && exhausted;
      }
      context_.statistics.exhausted = exhausted;
      if (exhausted) return;
    }
  }

 private:
  void tell() {
    const Duration makespan = quality_of(task_, plan_, replay_.check()).makespan;
    context_.limits.plan_found(metric_of(task_, plan_, makespan), makespan);
  }

  void drop_useless() { eliminate_useless_actions(task_, plan_, replay_, kStepsTakenAgain, context_.limits); }

  // Makes restarts. Returns whether one led to a better plan.
  bool restart(std::size_t evaluations, std::size_t& left) {
    bool better = false;
    for (std::size_t spent = 0; spent < evaluations && left > 0 && restarts_.promising();) {
      auto outcome = restarts_.next(std::min(evaluations - spent, left));
      spent += outcome.evaluations;
      left -= std::min(left, outcome.evaluations);
      if (!outcome.plan) continue;
      eliminate_useless_actions(task_, *outcome.plan, replay_, kStepsTakenAgain, context_.limits);
      const PlanQuality known = quality_of(task_, plan_, replay_.check());
      if (quality_of(task_, *outcome.plan, replay_.check()) >= known) continue;
      plan_ = std::move(*outcome.plan);
      better = true;
      tell();
    }
    return better;
  }

  // Walks through plans that are no worse from one to the next, and keeps the best.
  void vary(std::size_t evaluations, std::size_t& left) {
    PlanPrefix current = plan_;
    PlanQuality best = quality_of(task_, plan_, replay_.check());
    Duration starts = starts_of(task_, plan_, replay_.check());
    for (std::size_t spent = 0; spent < evaluations && left > 0;) {
      context_.limits.poll();
      const auto outcome = neighbourhood_.vary(current, replay_);
      spent += outcome.evaluations;
      left -= std::min(left, outcome.evaluations);
      if (!outcome.changed) continue;
      const PlanQuality quality = quality_of(task_, current, replay_.check());
      if (quality.metric == best.metric && quality.makespan == best.makespan && quality.busy > best.busy)
        continue;
      eliminate_useless_actions(task_, current, replay_, kStepsTakenAgain, context_.limits);
      const PlanQuality tidy = quality_of(task_, current, replay_.check());
      const Duration tidy_starts = starts_of(task_, current, replay_.check());
      if (tidy > best || (tidy == best && tidy_starts >= starts)) continue;
      best = tidy;
      starts = tidy_starts;
      plan_ = current;
      tell();
    }
  }

  // Searches for better plans, again from each one found. Returns whether nothing better is left to be found;
  // that is not known when the work runs out.
  bool search(const Guide& guide, std::int64_t weight, std::size_t limit, std::size_t& left) {
    while (left > 0) {
      const PlanQuality known = quality_of(task_, plan_, replay_.check());
      const SearchEffort effort{weight, std::min(limit, left)};
      auto better = find_better_plan(context_, known, guide, effort);
      left -= better.evaluations;
      if (!better.plan) return better.exhausted;
      plan_ = std::move(*better.plan);
      drop_useless();
      tell();
    }
    return false;
  }

  SearchContext context_;
  const Task& task_;
  PlanPrefix& plan_;
  std::span<const Guide> guides_;
  Restarts& restarts_;
  PlanReplay replay_;
  LargeNeighbourhoodSearch neighbourhood_;
};

}  // namespace

PlanPrefix improve(PlanPrefix first, std::span<const Guide> guides, Restarts& restarts,
                   const SearchContext& context) {
  PlanPrefix plan = std::move(first);
  try {
    Improvement(context, plan, guides, restarts).run();
  } catch (const PlanningFailure& failure) {
    if (failure.verdict() == Verdict::cancelled) throw;
  } catch (const std::bad_alloc&) {  // what was found stands
  }
  return plan;
}

}  // namespace roci::planner::temporal_pddl::improvement
