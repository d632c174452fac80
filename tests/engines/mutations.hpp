// Plans with one fault each, made of a right one.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"

namespace roci::planner::proof {

struct Mutation {
  std::string name;
  std::function<void(temporal::FlexiblePlan&)> apply;
};

// Each of another kind or at another place. The plan is a sequence of at least four tasks of the lock.
const std::vector<Mutation>& mutations();

}  // namespace roci::planner::proof
