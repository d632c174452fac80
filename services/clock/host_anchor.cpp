#include "services/clock/host_anchor.hpp"

#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include "services/clock/wall.hpp"

namespace roci::services::clock {
namespace {

std::int64_t boottime_us() {
  timespec time{};
  clock_gettime(CLOCK_BOOTTIME, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000 + time.tv_nsec / 1000;
}

std::string boot_id() {
  std::string out;
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), out);
  return out;
}

std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t out = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return out;
}

std::string step_text(std::int64_t us) {
  std::array<char, 40> out{};
  std::snprintf(out.data(), out.size(), "%.3f s", static_cast<double>(us) * 1e-6);
  return out.data();
}

}  // namespace

HostAnchor anchor_host() { return {boot_id(), boottime_us(), unix_us()}; }

std::int64_t unix_us(const HostAnchor& anchor) {
  return anchor.unix_us + (boottime_us() - anchor.boottime_us);
}

std::string to_text(const HostAnchor& anchor) {
  return anchor.boot + ":" + std::to_string(anchor.boottime_us) + ":" + std::to_string(anchor.unix_us);
}

std::optional<HostAnchor> anchor_of(std::string_view text) {
  const auto second = text.rfind(':');
  if (second == std::string_view::npos || second == 0) return std::nullopt;
  const auto first = text.rfind(':', second - 1);
  if (first == std::string_view::npos) return std::nullopt;
  const auto boottime = whole_number(text.substr(first + 1, second - first - 1));
  const auto since_1970 = whole_number(text.substr(second + 1));
  if (!boottime || !since_1970 || text.substr(0, first) != boot_id()) return std::nullopt;
  return HostAnchor{std::string(text.substr(0, first)), *boottime, *since_1970};
}

const std::optional<HostAnchor>& handed_anchor() {
  static const std::optional<HostAnchor> anchor = [] {
    const char* handed = std::getenv(kHostAnchorVariable);
    return handed == nullptr ? std::nullopt : anchor_of(handed);
  }();
  return anchor;
}

std::optional<std::string> SystemClockWatch::judge(std::int64_t anchored_us, std::int64_t system_us) {
  const std::int64_t ahead = system_us - anchored_us;
  const std::int64_t moved = ahead - told_us_;
  if (moved <= kBoundUs && moved >= -kBoundUs) return std::nullopt;
  told_us_ = ahead;
  const bool agrees = ahead <= kBoundUs && ahead >= -kBoundUs;
  const std::string how = moved > 0 ? "forward by " + step_text(moved) : "back by " + step_text(-moved);
  if (agrees)
    return "the system clock of this host was set " + how + " and agrees with the mission clock again";
  return "the system clock of this host was set " + how + "; the mission clock goes on as before, " +
         (ahead > 0 ? step_text(ahead) + " behind it" : step_text(-ahead) + " ahead of it");
}

}  // namespace roci::services::clock
