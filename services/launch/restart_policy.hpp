// The restart policy says when a service that ended is started again. It is pure.
#pragma once

#include <chrono>
#include <optional>

#include "services/clock/wall.hpp"

namespace roci::services::launch {

/// The pause is 0.2 s after the first death, twice as long after each further one in a row, at most 10 s;
/// after the fifth there is no new start (exponential back-off), but for a helper, which is then started every
/// `kHelperPause`. A service that ran for `kHealthyAfter` starts a new row.
class RestartPolicy {
 public:
  static constexpr int kDeathsInARow = 5;
  static constexpr clock::WallDuration kFirstPause = std::chrono::milliseconds(200);
  static constexpr clock::WallDuration kLongestPause = std::chrono::seconds(10);
  static constexpr clock::WallDuration kHealthyAfter = std::chrono::seconds(30);
  /// This pause passes between the starts of a service whose network went out after it had run, for as long
  /// as it takes.
  static constexpr clock::WallDuration kNetworkPause = std::chrono::seconds(2);

  /// This pause passes between the starts of a service that keeps dying and that the mission can go on without.
  static constexpr clock::WallDuration kHelperPause = std::chrono::seconds(30);

  /// Returns the pause until the next start; without one the service is given up.
  std::optional<clock::WallDuration> died(clock::WallDuration ran_for);

 private:
  int deaths_ = 0;
};

}  // namespace roci::services::launch
