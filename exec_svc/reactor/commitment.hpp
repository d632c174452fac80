/// What a new version of a running plan must leave as it is, where an engine plans all the time (R66, R78,
/// R81).
#pragma once

#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/executive/messages.hpp"

namespace roci::exec::reactor {

/// Why `next` may not take the place of `running`, of which `steps` tells the state; empty: it may. An
/// activity that is committed or has begun stands in the next plan unchanged and committed until it has
/// ended; what ended without success does not stand in it; no id comes again for another activity; and by
/// what has happened every committed activity can still start in time. The next plan has passed check().
std::string commitment_violation(const temporal::FlexiblePlan& running,
                                 const std::vector<executive::StepStatus>& steps,
                                 const temporal::FlexiblePlan& next, temporal::Time now);

}  // namespace roci::exec::reactor
