// The anchor ties the mission clock of a host to a clock that nobody sets: CLOCK_BOOTTIME, which runs on while the
// host sleeps and begins at its start (clock_gettime(2)). Whoever starts the services of a host anchors once and hands
// the anchor to each of them, so that mission time neither jumps nor stands still when the system clock is set, and a
// service that is started again comes back to the same mission time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace roci::services::clock {

/// Says that the system clock showed `unix_us` when CLOCK_BOOTTIME showed `boottime_us`, in microseconds.
struct HostAnchor {
  std::string boot;  ///< Identifies the start of the host that CLOCK_BOOTTIME counts from.
  std::int64_t boottime_us = 0;
  std::int64_t unix_us = 0;
  bool operator==(const HostAnchor&) const = default;
};

/// Names the environment variable that holds the anchor of a process's host, as to_text() writes it.
inline constexpr char kHostAnchorVariable[] = "ROCI_CLOCK_ANCHOR";

/// Anchors now.
HostAnchor anchor_host();
/// Returns microseconds since 1970 by the anchor, whatever has become of the system clock since.
std::int64_t unix_us(const HostAnchor&);

/// Writes "BOOT:BOOTTIME_US:UNIX_US".
std::string to_text(const HostAnchor&);
/// Reads what to_text() wrote; empty if it is anything else, or of another start of the host.
std::optional<HostAnchor> anchor_of(std::string_view text);
/// Returns the anchor that this process was handed; empty if it was handed none that is of use. The environment is read
/// once.
const std::optional<HostAnchor>& handed_anchor();

/// Tells when the system clock leaves the anchored one, and when it comes back to it. It is pure.
class SystemClockWatch {
 public:
  /// Bounds how far the two may be apart, in microseconds, before it is reported: as far as the clocks of two
  /// hosts (ClockBounds::offset).
  static constexpr std::int64_t kBoundUs = 250'000;

  /// Takes both clocks. Returns a sentence when the system clock has moved by more than the bound since the last
  /// report (a clock that creeps is reported once for each bound).
  std::optional<std::string> judge(std::int64_t anchored_us, std::int64_t system_us);

 private:
  std::int64_t told_us_ = 0;  // how far the system clock was ahead at the last report
};

}  // namespace roci::services::clock
