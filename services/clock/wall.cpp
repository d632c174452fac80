#include "services/clock/wall.hpp"

namespace roci::services::clock {

std::int64_t unix_us() {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count();
}

}  // namespace roci::services::clock
