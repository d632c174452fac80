// The downlink schedule and the mission outlook in their wire form.
#pragma once

#include "planner_svc/engine/mission_outlook.hpp"
#include "roci_idl/outlook.h"

namespace roci::planner {

/// Leaves out robot, header, version, time and names of model and plan, which the host says. A sample holds what
/// has room in kOutlookBytes; what has none is counted in `omitted`.
v1::DownlinkSchedule to_wire(const engine::DownlinkSchedule&);
v1::MissionOutlook to_wire(const engine::MissionOutlook&);

}  // namespace roci::planner
