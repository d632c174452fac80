// The clock anchor of a host whose services no launcher starts: the first of them leaves it in a file for the others.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "services/clock/host_anchor.hpp"

namespace roci::services::launch {

/// Names the anchor's file in the run folder of the host.
inline constexpr char kAnchorFile[] = "clock-anchor";

/// Returns the anchor in the folder, and makes it if there is none of this start of the host; of several processes
/// that come at once one makes it. Returns nothing while the system clock stands before mission time 0
/// (`epoch_unix_us`), since it has not been set then since the host was started. Throws std::system_error.
std::optional<clock::HostAnchor> kept_anchor(const std::filesystem::path& folder, std::int64_t epoch_unix_us);

}  // namespace roci::services::launch
