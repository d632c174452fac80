#include "services/clock/live_clock.hpp"

namespace roci::services::clock {

temporal::Time LiveClock::now() const {
  const std::int64_t since_epoch = (anchor_ ? unix_us(*anchor_) : unix_us()) - epoch_unix_us_;
  if (scale_ == 1) return temporal::Time(since_epoch);
  return temporal::Time(static_cast<std::int64_t>(static_cast<double>(since_epoch) * scale_));
}

WallDuration LiveClock::wall_for(temporal::Duration mission) const {
  return wall_seconds(std::chrono::duration<double>(mission).count() / scale_);
}

}  // namespace roci::services::clock
