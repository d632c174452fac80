#include "planner_svc/temporal_pddl/search/novelty.hpp"

namespace roci::planner::temporal_pddl::search {

using task::ActionId;
using task::StateView;

std::int64_t Novelty::see(StateView state, std::span<const ActionId> running, std::int64_t estimate) {
  std::int64_t news = 0;
  const auto note = [&](std::int64_t& lowest) {
    if (lowest <= estimate) return;
    lowest = estimate;
    ++news;
  };
  const auto variables = task_.layout.variables();
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const std::uint32_t value = task_.layout.value(state, i);
    if (value > 0) note(lowest_[variables[i].facts[value - 1]]);
  }
  for (const ActionId action : running) note(lowest_running_[action]);
  return news;
}

}  // namespace roci::planner::temporal_pddl::search
