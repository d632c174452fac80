// Conditions of a plan may ask how its other activities went (MEXEC, section II.C: preconditions may be based on the
// execution state of dependency tasks).
#pragma once

#include <string>

#include "core/temporal/flexible_plan.hpp"

namespace roci::temporal {

/// Returns the name of the timeline that has the state of an activity of the same plan as conditions see it: waiting,
/// dispatched, running, succeeded, failed, skipped or cancelled,
/// and `absent` where the plan has no activity of that id.
std::string activity_timeline(const std::string& id);

/// Returns the id of the activity whose state the timeline has, or an empty text if it is none of these.
std::string activity_of(const std::string& timeline);

/// Returns the name of the state, as above.
const char* to_string(ActivityState state);

}  // namespace roci::temporal
