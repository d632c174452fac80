// When a service that ended is started again. Pure.
#pragma once

#include <chrono>
#include <optional>

namespace roci::launch {

// 0.2 s after the first death, twice as long after each further one in a row, at most 10 s; after the fifth,
// never. A service that ran for `kHealthyAfter` starts a new row.
class RestartPolicy {
 public:
  using Duration = std::chrono::duration<double>;
  static constexpr int kDeathsInARow = 5;
  static constexpr Duration kFirstPause{0.2};
  static constexpr Duration kLongestPause{10};
  static constexpr Duration kHealthyAfter{30};
  // Between the starts of a service whose network went out after it had run: for as long as it takes.
  static constexpr Duration kNetworkPause{2};

  // The pause until the next start; nothing: give up.
  std::optional<Duration> died(Duration ran_for);

 private:
  int deaths_ = 0;
};

}  // namespace roci::launch
