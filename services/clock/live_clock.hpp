// Mission time in a live run: microseconds since the run's epoch, times a scale.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "core/temporal/duration.hpp"
#include "services/clock/host_anchor.hpp"
#include "services/clock/wall.hpp"

namespace roci::services::clock {

/// Reads mission time from the host's anchor if there is one, so that it never jumps, else from the system clock.
class LiveClock {
 public:
  LiveClock(std::int64_t epoch_unix_us, double scale, std::optional<HostAnchor> anchor = std::nullopt)
      : epoch_unix_us_(epoch_unix_us), scale_(scale), anchor_(std::move(anchor)) {}

  temporal::Time now() const;
  WallDuration wall_for(temporal::Duration mission) const;

 private:
  std::int64_t epoch_unix_us_;
  double scale_;
  std::optional<HostAnchor> anchor_;
};

}  // namespace roci::services::clock
