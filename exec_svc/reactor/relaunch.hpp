/// Whether a plan that was stopped can go on (R149).
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/executive/messages.hpp"

namespace roci::exec::reactor {

/// What of a plan is left out with what the ground has dropped: what was skipped, all parts of what was dropped, and
/// each activity of a level above (R130) of which no part is left, since nothing would bring it about.
/// `steps` are those of the plan.
std::set<std::string> left_out(const temporal::FlexiblePlan& plan,
                               const std::vector<executive::StepStatus>& steps,
                               const std::set<std::string>& dropped);

/// Why that cannot be left out, in plain words: an activity of a level above has begun, and would count as done without
/// its last part. Empty: it can.
std::string drop_fault(const temporal::FlexiblePlan& plan, const std::vector<executive::StepStatus>& steps,
                       const std::set<std::string>& dropped);

/// Why what is left of the plan cannot be executed from `now` on, in plain words; empty: it can. Of the plan
/// `steps` tell how far it has come, `without` names what is left out. Its times stay as they were: a start
/// whose latest time has passed cannot be mended by waiting.
std::string relaunch_fault(const temporal::FlexiblePlan& plan,
                           const std::vector<executive::StepStatus>& steps,
                           const std::set<std::string>& without, temporal::Time now);

}  // namespace roci::exec::reactor
