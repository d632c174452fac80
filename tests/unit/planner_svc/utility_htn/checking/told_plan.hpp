// A plan version as the executive is told it, made by hand.
#pragma once

#include <string>

#include "core/temporal/flexible_plan.hpp"

namespace roci::planner::utility_htn::checking {

/// Adds a link of a block that starts then.
inline void add(temporal::FlexiblePlan& plan, const std::string& task, int block, int link,
                temporal::Time start, temporal::Time length, temporal::CommitState commit) {
  temporal::PlanActivity one;
  one.id = task + "#" + std::to_string(block) + "." + std::to_string(link);
  one.name = task;
  one.start_point = plan.point_count;
  one.end_point = plan.point_count + 1;
  one.duration_lower = length;
  one.commit = commit;
  plan.point_count += 2;
  plan.constraints.push_back(
      {temporal::origin_point, one.start_point, temporal::ConstraintKind::window, start, temporal::no_bound});
  plan.activities.push_back(one);
}

}  // namespace roci::planner::utility_htn::checking
