#include "planner_svc/engine/plan_history.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace roci::planner::engine {

std::string PlanHistory::apply(const temporal::PlanDelta& delta, temporal::FlexiblePlan& next) const {
  if (delta.added.version <= newest_)
    return "version " + std::to_string(delta.added.version) + " does not follow version " +
           std::to_string(newest_);
  const temporal::FlexiblePlan* from = version(delta.from_version);
  if (from != nullptr) {
    next = *from;
  } else if (delta.from_version != 0) {
    return "it changes version " + std::to_string(delta.from_version) + ", which is not known";
  }
  return temporal::apply(delta, next);
}

const temporal::FlexiblePlan* PlanHistory::version(std::uint32_t number) const {
  const auto found = versions_.find(number);
  return found == versions_.end() ? nullptr : &found->second;
}

void PlanHistory::keep(temporal::FlexiblePlan plan) {
  const std::uint32_t number = plan.version;
  newest_ = std::max(newest_, number);
  versions_.insert_or_assign(number, std::move(plan));
  while (versions_.size() > kVersions) versions_.erase(std::next(versions_.begin()));
}

void PlanHistory::forget_before(std::uint32_t version) {
  versions_.erase(versions_.begin(), versions_.lower_bound(version));
}

}  // namespace roci::planner::engine
