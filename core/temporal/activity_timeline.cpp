#include "core/temporal/activity_timeline.hpp"

#include <string_view>

namespace roci::temporal {

namespace {
constexpr std::string_view kPrefix = "activity.";
}

std::string activity_timeline(const std::string& id) { return std::string(kPrefix) + id; }

std::string activity_of(const std::string& timeline) {
  return timeline.starts_with(kPrefix) ? timeline.substr(kPrefix.size()) : std::string();
}

const char* to_string(ActivityState state) {
  constexpr const char* kNames[] = {"waiting", "dispatched", "running",  "succeeded",
                                    "failed",  "skipped",    "cancelled"};
  return kNames[static_cast<std::size_t>(state)];
}

}  // namespace roci::temporal
