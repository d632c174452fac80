#include "services/launch/disk_watch.hpp"

namespace roci::services::launch {

std::optional<DiskWatch::Change> DiskWatch::judge(std::uintmax_t left, const std::string& folder) {
  if (!full_ && left < kFull) {
    full_ = true;
    return Change{v1::SEVERITY_ERROR, "disk.full",
                  "the disk of " + folder + " has " + std::to_string(left) +
                      " bytes left; who has to write there waits, and logs may lack lines; make room on it"};
  }
  if (full_ && left >= kRoom) {
    full_ = false;
    return Change{v1::SEVERITY_INFO, "disk.room", "the disk of " + folder + " has room again"};
  }
  return std::nullopt;
}

}  // namespace roci::services::launch
