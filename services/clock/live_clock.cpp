#include "services/clock/live_clock.hpp"

namespace roci::services {

Time LiveClock::now() const {
  const std::int64_t since_epoch = wall::unix_us() - epoch_unix_us_;
  if (scale_ == 1) return Time(since_epoch);
  return Time(static_cast<std::int64_t>(static_cast<double>(since_epoch) * scale_));
}

wall::Clock::duration LiveClock::wall_for(Duration mission) const {
  return wall::seconds(std::chrono::duration<double>(mission).count() / scale_);
}

}  // namespace roci::services
