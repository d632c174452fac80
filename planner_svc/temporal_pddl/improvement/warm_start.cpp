#include "planner_svc/temporal_pddl/improvement/warm_start.hpp"

#include <algorithm>
#include <limits>

#include "planner_svc/temporal_pddl/improvement/plan_completion.hpp"
#include "planner_svc/temporal_pddl/improvement/plan_replay.hpp"

namespace roci::planner::temporal_pddl::improvement {

using search::Guide;
using search::PlanPrefix;
using search::SearchContext;
using task::SnapId;
using temporal::Duration;
using temporal::no_bound;

namespace {

constexpr CompletionRule kRule{true, false, true, 5, 100};
constexpr PlanQuality kAnyQuality{std::numeric_limits<std::int64_t>::max(), no_bound, Duration{0}, 0};

}  // namespace

std::optional<PlanPrefix> warm_start(const SearchContext& context, std::span<const SnapId> remaining,
                                     const Guide& guide) {
  if (remaining.empty()) return std::nullopt;
  const auto possible = PlanReplay(context.task, context.options.epsilon).rest(remaining, {});
  if (!possible) return std::nullopt;
  return PlanCompletion(context).find(possible->steps, kAnyQuality, guide, kRule);
}

}  // namespace roci::planner::temporal_pddl::improvement
