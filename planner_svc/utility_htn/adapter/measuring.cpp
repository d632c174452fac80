// What executed tasks tell of themselves (R116).
#include <utility>

#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "planner_svc/utility_htn/assessor/learning.hpp"

namespace roci::planner::utility_htn::adapter {

// What ended before this process took the plan up was measured then, and stands in the plan.
void UtilityEngine::measure(cycle::TaskId id, const temporal::ActivityProgress& progress) {
  if (progress.state != temporal::ActivityState::succeeded || !progress.started || !progress.ended) return;
  if (*progress.ended <= taken_up_) return;
  const auto task = primitive_of(id);
  if (!task || network_.tasks[*task].learns.empty()) return;
  assessor::Measured measured;
  measured.duration_s = temporal::to_seconds(*progress.ended - *progress.started);
  model::Values values = cycle_->past().values;
  assessor::Learned learned = assessor::learn(network_, *task, measured, values);
  for (const model::ParameterIndex one : learned.replaced) cycle_->set_value(one, values[one]);
  for (std::string& refusal : learned.refused) doubted_.push_back(std::move(refusal));
}

std::optional<model::TaskIndex> UtilityEngine::primitive_of(cycle::TaskId id) const {
  for (const cycle::Block& block : cycle_->blocks())
    if (block.number == cycle::block_of(id) && cycle::link_of(id) < block.links.size())
      return block.links[cycle::link_of(id)].task;
  return std::nullopt;
}

}  // namespace roci::planner::utility_htn::adapter
