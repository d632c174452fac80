// Whether what is there now suffices for the rest of a plan: energy that was lost is missed long before the
// activity that lacks it is due.
#pragma once

#include <string>
#include <vector>

#include "core/temporal/condition.hpp"
#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/executive/messages.hpp"

namespace roci::exec {

// The first waiting activity, in plan order, whose pre conditions fail on the numbers of now less what the
// waiting ones before it take (their impacts of kind delta), in words; empty if there is none. What running
// activities will still take counts as nothing, so that no alarm is false. `steps` in plan order.
std::string shortfall(const temporal::FlexiblePlan& plan, const std::vector<StepStatus>& steps,
                      const temporal::Lookup& now);

}  // namespace roci::exec
