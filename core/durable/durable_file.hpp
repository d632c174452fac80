// Files that are replaced as a whole: whoever reads one finds the old text or the new one, whenever the process dies or
// the power goes. Nothing else in the tree renames a file (tests/architecture).
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string_view>

namespace roci::durable {

/// Says what a file outlasts once it has been replaced.
enum class Durability {
  process,  ///< The death of the process; nothing waits for the disk.
  power,    ///< A loss of power, too: file and name are on the disk.
};

/// Puts a file with this text, and these permissions less the process's umask, in the place of another one or of none.
/// Until it returns the old one is there. A symbolic link of that name is replaced, not followed.
/// Throws std::system_error.
void replace_file(const std::filesystem::path& file, std::string_view text, Durability = Durability::power,
                  mode_t mode = 0644);

/// Gives `unfinished` the name `file`, in whose place it stands from then on. The bytes of `unfinished` must be on the
/// disk already where they are to outlast a loss of power. Throws std::filesystem::filesystem_error if the file cannot
/// be renamed (nothing has changed then), another std::system_error if the new name cannot be written to the disk.
void put_in_place(const std::filesystem::path& unfinished, const std::filesystem::path& file,
                  Durability = Durability::power);

/// Waits until the names in a folder are on the disk. Throws std::system_error.
void sync_folder(const std::filesystem::path& folder);

}  // namespace roci::durable
