#include "planner_svc/temporal_pddl/search/temporal_check.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl {

void TemporalCheck::fill(const PlanPrefix& prefix, Stn& network) {
  network.reset(prefix.steps.size());
  for (const StepConstraint& constraint : prefix.constraints) {
    network.require(constraint.from, constraint.to, constraint.lower.count());
    if (constraint.upper != kUnbounded)
      network.require(constraint.to, constraint.from, -constraint.upper.count());
  }
}

Stn TemporalCheck::network(const PlanPrefix& prefix) {
  Stn result;
  fill(prefix, result);
  return result;
}

Ticks TemporalCheck::upper_bound(const PlanPrefix& prefix, std::size_t step) const {
  const bool running = std::ranges::any_of(prefix.running, [&](const Running& r) { return r.step == step; });
  const Ticks own = running ? bounds_.latest_running(prefix.steps[step], prefix.timed_done)
                            : bounds_.latest(prefix.steps[step], prefix.timed_done);
  return std::min(own, prefix.deadline);
}

const std::vector<Ticks>* TemporalCheck::earliest(const PlanPrefix& prefix) {
  fill(prefix, network_);
  times_.resize(prefix.steps.size());
  for (std::size_t i = 0; i < times_.size(); ++i) times_[i] = bounds_.earliest(prefix.steps[i]);
  if (!network_.raise(times_)) return nullptr;
  for (std::size_t i = 0; i < times_.size(); ++i) {
    if (times_[i] > upper_bound(prefix, i)) return nullptr;
  }
  return &times_;
}

// The latest times are the negated least solution of the mirrored network.
std::vector<Ticks> TemporalCheck::latest(const PlanPrefix& prefix) const {
  Stn mirrored(prefix.steps.size());
  for (auto constraint = prefix.constraints.rbegin(); constraint != prefix.constraints.rend(); ++constraint) {
    mirrored.require(constraint->to, constraint->from, constraint->lower.count());
    if (constraint->upper != kUnbounded)
      mirrored.require(constraint->from, constraint->to, -constraint->upper.count());
  }
  std::vector<Ticks> times(prefix.steps.size(), kNoPath);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Ticks bound = upper_bound(prefix, i);
    if (bound != kNever) times[i] = -bound;
  }
  mirrored.raise(times);
  for (Ticks& time : times) time = time == kNoPath ? kNever : -time;
  return times;
}

}  // namespace roci::planner::temporal_pddl
