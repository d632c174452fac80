// What executed tasks tell of themselves replaces what was foreseen of their site (R101, R116).
#include <utility>

#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "planner_svc/utility_htn/assessor/learning.hpp"

namespace roci::planner::utility_htn::adapter {

void UtilityEngine::measure() {
  for (const Measurements::Measurement& one : measurements_.take(network_)) {
    model::Values values = cycle_->past().values;
    assessor::Learned learned = assessor::learn(network_, one.task, one.measured, values);
    for (const model::ParameterIndex parameter : learned.replaced) {
      if (cycle_->past().values[parameter] == values[parameter]) continue;
      cycle_->set_value(parameter, values[parameter]);
      to_tell_ = true;  // a plan that tells it outlives this process
    }
    for (std::string& refusal : learned.refused) doubted_.push_back(std::move(refusal));
  }
}

// What has left the plan is never heard of again.
void UtilityEngine::forget_measurements() {
  std::set<std::uint32_t> numbers;
  for (const cycle::Block& block : cycle_->blocks()) numbers.insert(block.number);
  measurements_.keep_only([&](const std::string& activity) {
    const auto id = task_of(activity);
    return id && numbers.contains(cycle::block_of(*id));
  });
}

}  // namespace roci::planner::utility_htn::adapter
