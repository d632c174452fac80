// This file reads how the hosts of a live mission compare their clocks.
#pragma once

#include <filesystem>

#include "core/mission/entry.hpp"
#include "services/time_watch.hpp"

namespace roci::services::process {

/// Reads `clock:` of mission.yaml (docs/dds.md, "Time over hosts"). Where it names no reference, that is the
/// service with `clock: master`, else the first of the list; without a list nothing is compared. Throws
/// mission::FileError with place and remedy.
TimeWatchSettings read_time_settings(const mission::Entry& mission);

}  // namespace roci::services::process
