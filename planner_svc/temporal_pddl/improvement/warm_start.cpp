#include "planner_svc/temporal_pddl/improvement/warm_start.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/pddl/printer.hpp"
#include "planner_svc/temporal_pddl/improvement/completion.hpp"
#include "planner_svc/temporal_pddl/improvement/replay.hpp"

namespace roci::planner::temporal_pddl {

namespace {

constexpr CompletionRule kRule{true, false, true, 5, 100};
constexpr Quality kAnyQuality{std::numeric_limits<std::int64_t>::max(), kNever, 0, 0};

// The snap actions of the steps that the task knows, by time, ends before starts.
std::vector<SnapId> snaps_of(const Task& task, std::span<const pddl::PlanStep> remaining) {
  std::unordered_map<std::string, ActionId> known;
  for (std::size_t i = 0; i < task.actions.size(); ++i) known.emplace(name(task, ActionId(i)), ActionId(i));
  struct Event {
    std::chrono::microseconds time;
    bool starts;
    SnapId snap;
  };
  std::vector<Event> events;
  for (const pddl::PlanStep& step : remaining) {
    const auto found = known.find(pddl::print(step.action));
    if (found == known.end()) continue;
    const Action& action = task.actions[found->second];
    events.push_back({step.start, true, action.start});
    if (!action.instantaneous())
      events.push_back(
          {step.start + step.duration.value_or(std::chrono::microseconds{0}), false, action.end});
  }
  std::ranges::stable_sort(events, [](const Event& a, const Event& b) {
    return a.time != b.time ? a.time < b.time : a.starts < b.starts;
  });
  std::vector<SnapId> snaps;
  for (const Event& event : events) snaps.push_back(event.snap);
  return snaps;
}

}  // namespace

std::optional<PlanPrefix> warm_start(const Task& task, std::span<const pddl::PlanStep> remaining,
                                     const Guide& guide, const Options& options, Watch& watch,
                                     Statistics& statistics) {
  const std::vector<SnapId> steps = snaps_of(task, remaining);
  if (steps.empty()) return std::nullopt;
  const auto possible = Replay(task, options.epsilon).rest(steps, {});
  if (!possible) return std::nullopt;
  return Completion(task, options, watch, statistics).find(possible->steps, kAnyQuality, guide, kRule);
}

}  // namespace roci::planner::temporal_pddl
