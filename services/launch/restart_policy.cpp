#include "services/launch/restart_policy.hpp"

#include <algorithm>
#include <cmath>

namespace roci::launch {

std::optional<RestartPolicy::Duration> RestartPolicy::died(Duration ran_for) {
  if (ran_for >= kHealthyAfter) deaths_ = 0;
  if (++deaths_ >= kDeathsInARow) return std::nullopt;
  return std::min(kFirstPause * std::pow(2.0, deaths_ - 1), kLongestPause);
}

}  // namespace roci::launch
