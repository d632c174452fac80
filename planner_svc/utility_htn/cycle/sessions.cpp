#include "planner_svc/utility_htn/cycle/sessions.hpp"

#include <algorithm>
#include <set>

namespace roci::planner::utility_htn::cycle {

using temporal::Duration, temporal::Time;

search::PlannedData data_of(const std::vector<Block>& blocks, const model::Network& network,
                            const flattening::Chains& chains, const model::Values& values) {
  std::vector<const Block*> by_start;
  for (const Block& one : blocks) by_start.push_back(&one);
  std::ranges::stable_sort(by_start, {}, [](const Block* one) { return one->links.front().start; });
  search::PlannedData out;
  for (const Block* one : by_start) {
    for (std::size_t i = 0; i < one->links.size(); ++i) {
      const Link& each = one->links[i];
      if (each.stage == Stage::doomed || each.stage == Stage::failed) continue;
      const model::Task& task = network.tasks[each.task];
      if (task.downlinks && !is_over(each.stage))
        out.downlinks.push_back({each.task, each.start, each.end, task_id(one->number, i)});
      for (std::size_t p = 0; p < task.products.size(); ++p)
        if (p >= 64 || (each.generated >> p & 1U) == 0)
          out.products.push_back(search::predicted(network.tasks[chains.chains[one->chain].task], task,
                                                   task.products[p], each.end, values));
    }
  }
  out.committed_products = out.products.size();
  out.committed_downlinks = out.downlinks.size();
  return out;
}

void Sessions::look(const std::vector<Block>& blocks, const delivery::Delivery& delivery) {
  next_ = 0;
  if (delivery.requests_with_data().empty()) return;
  Time start = temporal::no_bound;
  for (const Block& one : blocks)
    for (std::size_t i = 0; i < one.links.size(); ++i) {
      const Link& each = one.links[i];
      if (!one.begun() || one.failed() || each.stage != Stage::planned || each.start >= start) continue;
      if (!network_.tasks[each.task].downlinks) continue;
      next_ = task_id(one.number, i);
      start = each.start;
    }
}

Duration Sessions::wanted(const std::vector<Block>& blocks, const Block& of, std::size_t link,
                          const delivery::Delivery& delivery, const model::Values& values,
                          Duration permitted) const {
  const Link& at = of.links[link];
  if (at.told > Duration{0}) return at.told;
  const Duration least = temporal::seconds(model::duration_s(network_.tasks[at.task], values));
  if (!of.begun()) return least;
  std::set<model::TaskIndex> requests{chains_.chains[of.chain].task};
  if (task_id(of.number, link) == next_) {
    requests.merge(delivery.requests_with_data());
    for (const Block& other : blocks)
      if (other.number != of.number) requests.erase(chains_.chains[other.chain].task);
  }
  return std::max(least, delivery.transmission(requests, values, permitted));
}

Duration Sessions::length(const std::vector<Block>& blocks, const Block& of, std::size_t link,
                          const delivery::Delivery& delivery, const model::Values& values,
                          Duration room) const {
  const Link& at = of.links[link];
  const Duration takes = wanted(blocks, of, link, delivery, values, temporal::no_bound);
  const Duration least = temporal::seconds(model::duration_s(network_.tasks[at.task], values));
  if (at.told > Duration{0} || takes <= least) return takes;
  const Duration permitted = std::min(room, longest(blocks, of, link, at.start, delivery, values));
  return takes <= permitted ? takes : wanted(blocks, of, link, delivery, values, permitted);
}

Duration Sessions::longest(const std::vector<Block>& blocks, const Block& of, std::size_t link, Time start,
                           const delivery::Delivery& delivery, const model::Values& values) const {
  std::vector<search::PlannedDownlink> others = data_of(blocks, network_, chains_, values).downlinks;
  const TaskId id = task_id(of.number, link);
  std::erase_if(others, [id](const search::PlannedDownlink& one) { return one.id == id; });
  return delivery.longest(of.links[link].task, start, others, values);
}

}  // namespace roci::planner::utility_htn::cycle
