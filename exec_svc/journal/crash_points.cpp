#include "exec_svc/journal/crash_points.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

namespace roci::exec::journal {

CrashPoints::CrashPoints(std::string_view setting, std::uint32_t incarnation, std::function<void()> die)
    : die_(std::move(die)) {
  for (; incarnation > 1; --incarnation) {
    const std::size_t comma = setting.find(',');
    setting = comma == std::string_view::npos ? "" : setting.substr(comma + 1);
  }
  setting = setting.substr(0, setting.find(','));
  if (setting.empty()) return;
  const std::size_t colon = setting.find(':');
  point_ = setting.substr(0, colon);
  const std::string_view count = colon == std::string_view::npos ? "" : setting.substr(colon + 1);
  const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), left_);
  const bool known = std::find(kCrashPoints.begin(), kCrashPoints.end(), point_) != kCrashPoints.end();
  if (known && error == std::errc{} && end == count.data() + count.size() && left_ > 0) return;
  std::string points;
  for (const std::string_view point : kCrashPoints) points += " " + std::string(point);
  throw std::invalid_argument("ROCI_CRASH=" + std::string(setting) +
                              ": give POINT:N, N at least 1, with one of" + points);
}

void CrashPoints::pass(std::string_view point) {
  if (left_ > 0 && point == point_ && --left_ == 0) die_();
}

}  // namespace roci::exec::journal
