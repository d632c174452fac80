#include "services/security/private_file.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <system_error>

#include "core/durable/durable_file.hpp"

namespace roci::services::security {

namespace fs = std::filesystem;

void write_private(const fs::path& file, const std::string& text) {
  durable::replace_file(file, text, durable::Durability::power, 0600);
}

void make_private(const fs::path& folder) {
  if (!folder.parent_path().empty()) fs::create_directories(folder.parent_path());
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    throw std::system_error(errno, std::generic_category(), "cannot make " + folder.string());
}

}  // namespace roci::services::security
