#include "planner_svc/temporal_pddl/improvement/restarts.hpp"

#include <algorithm>
#include <utility>

#include "planner_svc/temporal_pddl/search/goal_serialization.hpp"
#include "planner_svc/temporal_pddl/search/portfolio.hpp"

namespace roci::planner::temporal_pddl::improvement {

using heuristics::FfHeuristic;
using search::GoalSerialization, search::Guide, search::SearchContext, search::strongest_compression;

namespace {

constexpr int kPatience = 4;

}  // namespace

Restarts::Restarts(const SearchContext& context, const Guide& guide, FfHeuristic& ff)
    : context_(context), guide_(guide), ff_(ff), options_(context.options) {}

bool Restarts::promising() const {
  return in_vain_ < kPatience && context_.task.goals.size() == 1 &&
         context_.task.goals.front().facts.size() > 1;
}

Restarts::Outcome Restarts::next(std::size_t evaluations) {
  ++options_.seed;
  const std::size_t before = context_.statistics.evaluated;
  const SearchContext reseeded{context_.task, options_, context_.limits, context_.statistics};
  GoalSerialization search(reseeded, guide_, ff_, strongest_compression(context_.task, options_));
  auto found = search.run(evaluations, 0);
  Outcome outcome{std::nullopt, std::max<std::size_t>(1, context_.statistics.evaluated - before)};
  if (found) in_vain_ = found->plan ? 0 : in_vain_ + 1;
  if (found && found->plan) outcome.plan = std::move(found->plan);
  return outcome;
}

}  // namespace roci::planner::temporal_pddl::improvement
