// A downlink schedule and an outlook of a lander with three sites, half way through, as its planner tells them.
#pragma once

#include "roci_idl/outlook.h"

namespace roci::console::testing {

// Three downlinks: the first is full, the last is empty; one product is left out, one late.
v1::DownlinkSchedule schedule_of_a_lander();
// Site 1 has given a positive and a negative sample, the first of site 2 is planned; site 0 is untouched.
v1::MissionOutlook outlook_of_a_lander();

}  // namespace roci::console::testing
