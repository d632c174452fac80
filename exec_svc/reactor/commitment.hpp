// A new version of a running plan must leave what is committed as it is, where an engine plans all the time
// (R66, R78, R81).
#pragma once

#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/executive/messages.hpp"

namespace roci::exec::reactor {

/// Returns why `next` may not replace `running`, whose state `steps` tells, or an empty text if it may. An
/// activity that is committed or has begun must stay in the next plan, unchanged and committed, until it has
/// ended; one that ended without success must not; no id may be used again for another activity; and every
/// committed activity must still be able to start in time after what has happened. The next plan has passed
/// check().
std::string commitment_violation(const temporal::FlexiblePlan& running,
                                 const std::vector<executive::StepStatus>& steps,
                                 const temporal::FlexiblePlan& next, temporal::Time now);

}  // namespace roci::exec::reactor
