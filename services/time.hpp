// Mission time as every service counts it: microseconds since the mission's epoch.
#pragma once

#include <chrono>
#include <cstdint>

namespace roci::services {

using Duration = std::chrono::duration<std::int64_t, std::micro>;
using Time = Duration;  // since the mission epoch

}  // namespace roci::services
