#include "planner_svc/utility_htn/adapter/products.hpp"

#include <algorithm>

#include "planner_svc/utility_htn/adapter/plan_of.hpp"

namespace roci::planner::utility_htn::adapter {

model::TaskIndex task_of_activity(const model::Network& network, const std::string& activity) {
  const auto found =
      std::ranges::find(network.tasks, activity.substr(0, activity.rfind('#')), &model::Task::id);
  return static_cast<model::TaskIndex>(found - network.tasks.begin());
}

delivery::Existing existing(const model::Network& network, const flattening::Chains& chains,
                            const cycle::Cycle& cycle, const engine::DataProduct& product) {
  const auto none = static_cast<model::TaskIndex>(network.tasks.size());
  delivery::Existing out;
  out.data = {product.id, static_cast<model::Tier>(product.tier), product.bytes, product.created,
              product.utility};
  out.fate = static_cast<delivery::Fate>(product.fate);
  out.task = task_of_activity(network, product.source);
  out.request = none;
  if (const auto id = task_of(product.source)) {
    const auto block = std::ranges::find(cycle.blocks(), cycle::block_of(*id), &cycle::Block::number);
    if (block != cycle.blocks().end()) out.request = chains.chains[block->chain].task;
  }
  if (out.task != none) {
    const auto& products = network.tasks[out.task].products;
    const auto named = std::ranges::find(products, product.kind, &model::Product::name);
    if (named != products.end()) out.predicted = named->utility;
  }
  if (product.utility.scores().empty() && !out.predicted.scores().empty()) {
    out.data.utility = out.predicted;
  } else if (product.utility.scores().empty() && out.task != none &&
             !network.tasks[out.task].products.empty()) {
    const model::Task& task = network.tasks[out.task];
    out.data.utility =
        model::utility(task, cycle.past().values) * (1.0 / static_cast<double>(task.products.size()));
  }
  return out;
}

}  // namespace roci::planner::utility_htn::adapter
