// This file decides whether a plan that was stopped can go on (R149).
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/executive/messages.hpp"

namespace roci::exec::reactor {

/// Returns what of a plan is left out with what the ground has dropped: what was skipped, all parts of what was
/// dropped, and each activity of a level above (R130) of which no part is left, since nothing would bring it about.
/// `steps` are those of the plan.
std::set<std::string> left_out(const temporal::FlexiblePlan& plan,
                               const std::vector<executive::StepStatus>& steps,
                               const std::set<std::string>& dropped);

/// Returns in plain words why that cannot be left out: an activity of a level above has begun, and would count as done
/// without its last part. The text is empty if it can.
std::string drop_fault(const temporal::FlexiblePlan& plan, const std::vector<executive::StepStatus>& steps,
                       const std::set<std::string>& dropped);

/// Returns in plain words why the rest of the plan cannot be executed from `now` on, or an empty text if it
/// can. `steps` tell how far the plan has come, `without` names what is left out. Its times stay as they
/// were, so a start whose latest time has passed makes it impossible.
std::string relaunch_fault(const temporal::FlexiblePlan& plan,
                           const std::vector<executive::StepStatus>& steps,
                           const std::set<std::string>& without, temporal::Time now);

}  // namespace roci::exec::reactor
