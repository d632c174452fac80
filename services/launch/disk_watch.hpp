// A service that waits for a full disk cannot say so in its log, which stands on that disk, nor before it has joined
// the others; so the launcher looks itself. It is pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "roci_idl/health.h"

namespace roci::services::launch {

/// Tells once when the run folder's disk is full, and once when it has room again.
class DiskWatch {
 public:
  static constexpr std::uintmax_t kFull = 65'536;   ///< with fewer bytes left a disk is full
  static constexpr std::uintmax_t kRoom = 262'144;  ///< with as many it has room again

  struct Change {
    v1::Severity severity;
    std::string code;  ///< reads disk.full or disk.room
    std::string text;
  };
  /// Takes how many bytes this user may still write in `folder`.
  std::optional<Change> judge(std::uintmax_t left, const std::string& folder);

 private:
  bool full_ = false;
};

}  // namespace roci::services::launch
