#include "planner_svc/temporal_pddl/dead_ends/resource_dead_ends.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "planner_svc/temporal_pddl/call/planning_failure.hpp"

namespace roci::planner::temporal_pddl::dead_ends {

using call::PlanningFailure, call::SearchLimits;
using task::ActionCompression, task::ActionId, task::ConsumableResource, task::FactId, task::StateView,
    task::Task;

namespace {

constexpr std::size_t kMaxStates = 100'000;   // of one measuring: 6 MB
constexpr std::size_t kMaxWork = 20'000'000;  // actions tried in states, of all measuring: about 0.5 s
constexpr std::size_t kMaxResources = 3;

// Sums of amounts round differently in a different order.
bool suffices(double left, double need) { return need <= left + 1e-6 * (1 + std::abs(left)); }

std::string text(double amount) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.10g", amount);
  return buffer;
}

}  // namespace

ResourceDeadEnds::ResourceDeadEnds(const Task& task, std::size_t patience, SearchLimits& limits)
    : task_(task),
      patience_(patience),
      short_(patience == 0),
      limits_(limits),
      resources_(find_consumable_resources(task)) {
  if (resources_.size() > kMaxResources) resources_.resize(kMaxResources);
}

bool ResourceDeadEnds::proves_dead_end(StateView state, std::span<const ActionId> running,
                                       ActionCompression /*compression*/) {
  if (resources_.empty()) return false;
  short_ = short_ || runs_short(state);
  if (patience_ > 0) {
    --patience_;
    return false;
  }
  if (!short_) return false;
  measure();
  return std::ranges::any_of(needs_, [&](Measured& measured) {
    const double need = measured.need.of(state, running);
    return need > 0 && !suffices(measured.resource->left(task_, state), need);
  });
}

bool ResourceDeadEnds::runs_short(StateView state) const {
  return std::ranges::any_of(resources_, [&](const ConsumableResource& resource) {
    return resource.left(task_, state) < resource.left(task_, task_.initial_state) / 2;
  });
}

void ResourceDeadEnds::measure() {
  if (measured_) return;
  measured_ = true;
  for (const ConsumableResource& resource : resources_) measure(resource, {});
}

// Measures for all goals at once, or for half of them and the other half, if that is too much.
void ResourceDeadEnds::measure(const ConsumableResource& resource, std::span<const FactId> goals) {
  std::size_t known = 0;
  for (const Measured& measured : needs_) known += measured.need.bytes();
  const std::size_t states = std::min(
      kMaxStates, (kMaxWork - std::min(work_, kMaxWork)) / std::max<std::size_t>(task_.actions.size(), 1));
  if (states == 0) return;
  const auto step = [&](std::size_t bytes) {
    work_ += task_.actions.size();
    limits_.step();
    limits_.memory_on_top(known + bytes);
  };
  auto need = ConsumptionBound::measure(task_, AtemporalAbstraction(task_, goals), resource, states, step);
  if (need) {
    needs_.push_back({&resource, std::move(*need)});
    return;
  }
  if (task_.goals.size() != 1) return;
  const std::span<const FactId> all = goals.empty() ? std::span(task_.goals.front().facts) : goals;
  if (all.size() < 2) return;
  measure(resource, all.first(all.size() / 2));
  measure(resource, all.subspan(all.size() / 2));
}

std::size_t ResourceDeadEnds::bytes() const {
  std::size_t result = 0;
  for (const Measured& measured : needs_) result += measured.need.bytes();
  return result;
}

std::string ResourceDeadEnds::shortage_reason() {
  try {
    measure();
  } catch (const PlanningFailure&) {
    return {};  // the verdict stands without a reason
  }
  for (const Measured& measured : needs_) {
    const ConsumableResource& resource = *measured.resource;
    const double need = measured.need.at_first();
    const double left = resource.left(task_, task_.initial_state);
    if (!std::isfinite(need) || need == 0 || suffices(left, need)) continue;
    const bool falls = resource.sign > 0;
    return "the goals take at least " + text(need) + " of " + task_.number_names[resource.number.index()] +
           ", but only " + text(std::max(0.0, left)) + " may be used: it begins at " +
           text(task_.layout.numbers(task_.initial_state)[resource.number]) + ", and actions must not " +
           (falls ? "take it below " : "raise it above ") + text(resource.sign * resource.floor);
  }
  return {};
}

}  // namespace roci::planner::temporal_pddl::dead_ends
