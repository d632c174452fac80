// These are files and folders that their owner alone may read.
#pragma once

#include <filesystem>
#include <string>

namespace roci::services::security {

/// Replaces the file as a whole, with mode 0600; the old one is there until the new one is on the disk, and its name
/// with it. Throws std::system_error.
void write_private(const std::filesystem::path& file, const std::string& text);

/// Makes the folder with mode 0700 if it is not there, and those above it. Throws std::system_error.
void make_private(const std::filesystem::path& folder);

}  // namespace roci::services::security
