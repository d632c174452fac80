#include "services/launch/restart_policy.hpp"

#include <algorithm>

namespace roci::services::launch {

std::optional<clock::WallDuration> RestartPolicy::died(clock::WallDuration ran_for) {
  if (ran_for >= kHealthyAfter) deaths_ = 0;
  if (++deaths_ >= kDeathsInARow) return std::nullopt;
  return std::min(kFirstPause * (1 << (deaths_ - 1)), kLongestPause);
}

}  // namespace roci::services::launch
