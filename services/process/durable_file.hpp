// Small files that are whole or not there, whenever the power goes.
#pragma once

#include <filesystem>
#include <string_view>

namespace roci::services::process {

/// Puts a file with this text in the place of another one, or of none. When it returns, file and name are on the disk;
/// until then the old one is. A symbolic link of that name is replaced, not followed. Throws std::system_error.
void replace_file(const std::filesystem::path& file, std::string_view text);

/// Waits until the names in a folder are on the disk, e.g. after a rename. Throws std::system_error.
void sync_folder(const std::filesystem::path& folder);

}  // namespace roci::services::process
