#include "services/launch/log_files.hpp"

#include <system_error>

namespace roci::services::launch {

namespace fs = std::filesystem;

bool bound_log(const fs::path& log, std::uintmax_t limit) {
  std::error_code error;
  // Others may write into the folder that holds it (/tmp): neither file is followed to elsewhere.
  if (!fs::is_regular_file(fs::symlink_status(log, error))) return false;
  const std::uintmax_t size = fs::file_size(log, error);
  if (error || size <= limit) return false;
  const fs::path before = fs::path(log).concat(".1");
  fs::remove(before, error);
  if (!fs::copy_file(log, before, fs::copy_options::none, error)) fs::remove(before, error);
  fs::resize_file(log, 0, error);
  return !error;
}

}  // namespace roci::services::launch
