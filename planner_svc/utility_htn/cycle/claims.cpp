#include "planner_svc/utility_htn/cycle/claims.hpp"

#include <algorithm>

namespace roci::planner::utility_htn::cycle {

using temporal::Time;

Time free_from(const model::Network& network, const model::Values& values, const std::vector<Block>& blocks,
               const Link& waiting) {
  Time out{0};
  for (const model::Impact& claim : network.tasks[waiting.task].impacts) {
    const auto& timeline = network.timelines[claim.timeline];
    if (!timeline.is_claim()) continue;
    double taken = model::evaluate(claim.amount, values);
    Time given_back{0};
    for (const Block& one : blocks)
      for (const Link& holder : one.links) {
        const bool holds = holder.stage == Stage::running ||
                           (holder.stage == Stage::committed && holder.planned < waiting.planned);
        if (!holds || &holder == &waiting || holder.end <= waiting.start) continue;
        for (const model::Impact& impact : network.tasks[holder.task].impacts) {
          if (impact.timeline != claim.timeline) continue;
          taken += model::evaluate(impact.amount, values);
          given_back = std::max(given_back, holder.end);
        }
      }
    if (taken > timeline.highest) out = std::max(out, given_back);
  }
  return out;
}

Time free_until(const model::Network& network, const std::vector<Block>& blocks, const Link& of) {
  Time out = temporal::no_bound;
  for (const model::Impact& claim : network.tasks[of.task].impacts) {
    if (!network.timelines[claim.timeline].is_claim()) continue;
    for (const Block& one : blocks)
      for (const Link& each : one.links) {
        const model::Task& task = network.tasks[each.task];
        const bool stands = task.fixed || each.stage == Stage::committed;
        if (stands && is_placed(each) && each.start >= of.end &&
            std::ranges::find(task.impacts, claim.timeline, &model::Impact::timeline) != task.impacts.end())
          out = std::min(out, each.start);
      }
  }
  return out;
}

}  // namespace roci::planner::utility_htn::cycle
