// The incarnation says how often a service was started in a run, where nobody counts for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace roci::services::process {

/// Returns one more than at the last call with this folder and service; the count is kept in
/// <folder>/<service>.incarnation. Throws std::runtime_error if the folder cannot be written.
std::uint32_t next_incarnation(const std::filesystem::path& folder, const std::string& service);

}  // namespace roci::services::process
