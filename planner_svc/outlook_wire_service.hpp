// This file translates the downlink schedule and the mission outlook to their wire form.
#pragma once

#include "planner_svc/engine/mission_outlook.hpp"
#include "roci_idl/outlook.h"

namespace roci::planner {

/// Translate all but robot, header, version, time and names of model and plan, which the host fills in. A sample
/// holds what has room in kOutlookBytes; the rest is counted in `omitted`.
v1::DownlinkSchedule to_wire(const engine::DownlinkSchedule&);
v1::MissionOutlook to_wire(const engine::MissionOutlook&);

}  // namespace roci::planner
