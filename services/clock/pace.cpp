#include "services/clock/pace.hpp"

#include <algorithm>

namespace roci::services::clock {
namespace {

// A run that fell behind by more than this does not catch up: it would rush through what follows.
constexpr double kForgivenLagS = 0.1;

double to_seconds(temporal::Duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

WallTime Pace::earliest(temporal::Time time) const {
  if (rate_ <= 0) return reached_at_;
  return reached_at_ + wall_seconds(to_seconds(time - time_) / rate_);
}

temporal::Time Pace::time_at(WallTime now) const {
  if (rate_ <= 0) return time_;
  const double passed = std::max(0.0, std::chrono::duration<double>(now - reached_at_).count());
  return time_ +
         std::chrono::duration_cast<temporal::Duration>(std::chrono::duration<double>(passed * rate_));
}

void Pace::reached(temporal::Time time, WallTime now) {
  const WallTime planned = earliest(time);
  reached_at_ = now - planned > wall_seconds(kForgivenLagS) ? now : planned;
  time_ = time;
}

}  // namespace roci::services::clock
