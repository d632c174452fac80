// The clock anchor of a host whose services no launcher starts: the first of them leaves it in a file for the others.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "services/clock/host_anchor.hpp"

namespace roci::services::launch {

/// It lies in the run folder of the host.
inline constexpr char kAnchorFile[] = "clock-anchor";

/// Returns the anchor in the folder; makes it if there is none of this start of the host. Of several processes that
/// come at once one makes it. Empty while the system clock stands before mission time 0 (`epoch_unix_us`): it has not
/// been set since the host was started, and nothing is anchored to it. Throws std::system_error.
std::optional<clock::HostAnchor> kept_anchor(const std::filesystem::path& folder, std::int64_t epoch_unix_us);

}  // namespace roci::services::launch
