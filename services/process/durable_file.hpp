// Durable files are small files that are whole or absent, whenever the power goes.
#pragma once

#include <filesystem>
#include <string_view>

namespace roci::services::process {

/// Writes a file with this text, replacing an old one. When it returns, file and name are on the disk; until then the
/// old one is. A symbolic link of that name is replaced, not followed. Throws std::system_error.
void replace_file(const std::filesystem::path& file, std::string_view text);

/// Waits until the names in a folder are on the disk, e.g. after a rename. Throws std::system_error.
void sync_folder(const std::filesystem::path& folder);

}  // namespace roci::services::process
