#include "planner_svc/temporal_pddl/dead_ends/within_resources.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "planner_svc/temporal_pddl/grounding/refusal.hpp"

namespace roci::planner::temporal_pddl {

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

WithinResources::WithinResources(const Task& task, Heuristic& heuristic, std::size_t patience, Watch& watch)
    : task_(task),
      heuristic_(heuristic),
      patience_(patience),
      short_(patience == 0),
      watch_(watch),
      resources_(find_resources(task)) {
  if (resources_.size() > kMaxResources) resources_.resize(kMaxResources);
}

bool WithinResources::hopeless(StateView state, std::span<const ActionId> running, ActionSteps /*steps*/) {
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

bool WithinResources::runs_short(StateView state) const {
  return std::ranges::any_of(resources_, [&](const Resource& resource) {
    return resource.left(task_, state) < resource.left(task_, task_.initial_state) / 2;
  });
}

void WithinResources::measure() {
  if (measured_) return;
  measured_ = true;
  for (const Resource& resource : resources_) measure(resource, {});
}

// All goals at once; or half of them and the other half, if that is too much.
void WithinResources::measure(const Resource& resource, std::span<const FactId> goals) {
  std::size_t known = 0;
  for (const Measured& measured : needs_) known += measured.need.bytes();
  const std::size_t states = std::min(
      kMaxStates, (kMaxWork - std::min(work_, kMaxWork)) / std::max<std::size_t>(task_.actions.size(), 1));
  if (states == 0) return;
  const auto step = [&](std::size_t bytes) {
    work_ += task_.actions.size();
    watch_.step();
    watch_.memory_on_top(known + bytes);
  };
  auto need = ResourceNeed::measure(task_, TimelessSpace(task_, goals), resource, states, step);
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

std::size_t WithinResources::bytes() const {
  std::size_t result = heuristic_.bytes();
  for (const Measured& measured : needs_) result += measured.need.bytes();
  return result;
}

std::string WithinResources::why_too_little() {
  try {
    measure();
  } catch (const Refusal&) {
    return {};  // the verdict stands without a reason
  }
  for (const Measured& measured : needs_) {
    const Resource& resource = *measured.resource;
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

}  // namespace roci::planner::temporal_pddl
