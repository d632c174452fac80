// These are the codes of the events that the services of this repository report: what a scenario may expect.
#pragma once

#include <string>
#include <vector>

namespace roci::rehearsal::check {

/// Each once, in alphabetical order. unit_rehearsal_check compares them with the sources.
const std::vector<std::string>& event_codes();

}  // namespace roci::rehearsal::check
