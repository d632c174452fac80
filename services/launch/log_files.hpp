// The log files of a run are bounded: services write to them for as long as a mission lasts.
#pragma once

#include <cstdint>
#include <filesystem>

namespace roci::services::launch {

/// Bounds one service's log in bytes; with what is kept of the time before it has twice as much.
inline constexpr std::uintmax_t kLogLimit = 16 << 20;

/// Moves what stands in the log to LOG.1, whose former content is gone, and begins the log anew, once it is larger than
/// `limit` bytes. Whoever writes to it goes on writing (it must append); a line that comes at that moment may be
/// missing in both. Without room on the disk for LOG.1 it only begins anew. Returns whether it did; a log that cannot
/// be read or written is left alone.
bool bound_log(const std::filesystem::path& log, std::uintmax_t limit = kLogLimit);

}  // namespace roci::services::launch
