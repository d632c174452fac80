// Private folders are folders that another user of this host cannot turn against this one, also where
// everybody may write (/tmp).
#pragma once

#include <filesystem>

namespace roci::services::process {

/// Makes the folder, for this user alone (mode 0700), if it is not there. One that is there must be a folder itself (no
/// symbolic link), belong to this user, and be writable for nobody else but its group. Throws std::runtime_error with
/// the remedy otherwise, and when the folder cannot be made.
void make_own_folder(const std::filesystem::path& folder);

/// Does the same, and takes from everybody else what rights they have in a folder that is there.
void make_private_folder(const std::filesystem::path& folder);

}  // namespace roci::services::process
