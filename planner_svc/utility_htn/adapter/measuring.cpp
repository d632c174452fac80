// What executed tasks tell of themselves replaces what was foreseen of their site (R101, R116).
#include <utility>

#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "planner_svc/utility_htn/assessor/learning.hpp"

namespace roci::planner::utility_htn::adapter {

void UtilityEngine::measure() {
  for (const Measurements::Measurement& one : measurements_.take(planned_.network())) {
    model::Values values = planned_.cycle().past().values;
    assessor::Learned learned = assessor::learn(planned_.network(), one.task, one.measured, values);
    for (const model::ParameterIndex parameter : learned.replaced) {
      if (planned_.cycle().past().values[parameter] == values[parameter]) continue;
      planned_.cycle().set_value(parameter, values[parameter]);
      published_.renew();  // a plan that tells it outlives this process
    }
    for (std::string& refusal : learned.refused) doubted_.push_back(std::move(refusal));
  }
}

// What has left the plan is never heard of again.
void UtilityEngine::forget_measurements() {
  std::set<std::uint32_t> numbers;
  for (const cycle::Block& block : planned_.cycle().blocks()) numbers.insert(block.number);
  measurements_.keep_only([&](const std::string& activity) {
    const auto id = task_of(activity);
    return id && numbers.contains(cycle::block_of(*id));
  });
}

}  // namespace roci::planner::utility_htn::adapter
