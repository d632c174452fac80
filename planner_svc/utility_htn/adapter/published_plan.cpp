#include "planner_svc/utility_htn/adapter/published_plan.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace roci::planner::utility_htn::adapter {

using temporal::FlexiblePlan, temporal::Time;

namespace {

/// What is refused again and again is sent at last after 2 to the power of this intervals.
constexpr std::uint32_t kLongestPause = 5;

}  // namespace

bool PublishedPlan::hear(const engine::Receipt& receipt, Time now, temporal::Duration interval) {
  const bool ended = versions_.hear(receipt);
  const std::uint32_t refused = versions_.refused_in_turn();
  if (refused > refused_in_turn_) again_at_ = now + interval * (1 << std::min(refused, kLongestPause));
  refused_in_turn_ = refused;
  return ended;
}

void PublishedPlan::hear(const engine::StepStatus& step) {
  if (initial_ && step.activity == initial_->id && temporal::is_over(step.progress.state)) initial_.reset();
}

void PublishedPlan::resume(const FlexiblePlan& executed, Points points) {
  origin_ = executed.origin;
  points_ = std::move(points);
  initial_.reset();
  for (const temporal::PlanActivity& activity : executed.activities)
    if (is_initial(activity)) {
      initial_ = activity;
      points_.set(Points::kInitial, activity.start_point, activity.end_point);
    }
  versions_.resume(executed);
}

bool PublishedPlan::is_due(Time now) const {
  const bool again = refused_in_turn_ != 0 && now >= again_at_;
  return to_send_ || again || versions_.base().version == 0;
}

// What is committed ends by itself; what is not would wait for ever in a plan that nothing else is left of.
bool PublishedPlan::is_over(const cycle::Cycle& cycle) const {
  const auto waits = [](const temporal::PlanActivity& one) {
    return one.commit == temporal::CommitState::planned;
  };
  return cycle.blocks().empty() && std::ranges::none_of(versions_.base().activities, waits);
}

temporal::PlanDelta PublishedPlan::next(const PlannedNetwork& planned, const OpenGoals& goals, Frame frame,
                                        Time now) {
  const FlexiblePlan& told = versions_.base();
  const bool whole = told.version == 0;
  if (whole) {
    origin_ = now;
    points_ = {};
  }
  frame.origin = origin_;
  points_.keep_only(planned.cycle().blocks(), initial_.has_value());
  FlexiblePlan plan = plan_of(planned.network(), planned.chains(), planned.cycle(), frame, told, points_);
  goals.serve_requests(plan, planned);
  announce(planned, frame, whole);
  if (initial_) plan.activities.insert(plan.activities.begin(), *initial_);
  plan.point_count = points_.count();
  temporal::PlanDelta out = temporal::difference(told, plan);
  versions_.send(std::move(plan));
  to_send_ = false;
  return out;
}

// A plan that comes whole begins with the values of internal timelines, any other one with those that are new.
void PublishedPlan::announce(const PlannedNetwork& planned, const Frame& frame, bool whole) {
  if (whole || (!initial_ && !unannounced_.empty())) {
    initial_ = initial_activity(planned.network(), planned.cycle().past(), frame);
    std::tie(initial_->start_point, initial_->end_point) = points_.of(Points::kInitial);
    if (!whole)
      std::erase_if(initial_->impacts,
                    [&](const auto& impact) { return !unannounced_.contains(impact.timeline); });
    if (whole && initial_->impacts.empty()) initial_.reset();
  }
  if (initial_) unannounced_.clear();
}

}  // namespace roci::planner::utility_htn::adapter
