#include "planner_svc/utility_htn/cycle/early_end.hpp"

#include <algorithm>

namespace roci::planner::utility_htn::cycle {

std::optional<EarlyEnd> early_end(const model::Network& network, const model::Values& values,
                                  const temporal::timelines::Timelines& timelines,
                                  const std::vector<Block>& blocks, temporal::Time now, double reported) {
  const auto& definition = network.timelines[network.budget];
  for (const Block& one : blocks) {
    if (one.links.size() != 1 || one.links.front().stage != Stage::running) continue;
    const Link& load = one.links.front();
    const model::Task& task = network.tasks[load.task];
    const double power = model::draw(network, task, values);
    if (!task.commands.empty() || power <= 0 || load.end <= now) continue;
    const double left = timelines.value(network.budget, now) - definition.lowest;
    const double at_most = std::max(left, reported - definition.lowest);
    if (at_most < power * temporal::to_seconds(load.end - now))
      return EarlyEnd{one.number, now + temporal::seconds(left / power / 2)};
  }
  return std::nullopt;
}

}  // namespace roci::planner::utility_htn::cycle
