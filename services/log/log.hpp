// A service logs on standard error, for developers. Operators get events (topics::event).
#pragma once

#include <string_view>

namespace roci::services::log {

/// Write one line each.
void info(std::string_view);
void warning(std::string_view);
void error(std::string_view);

}  // namespace roci::services::log
