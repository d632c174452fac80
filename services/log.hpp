// A service's own log on standard error, for developers. Operators get events (topics::event).
#pragma once

#include <string_view>

namespace roci::services {

void log_info(std::string_view);
void log_warning(std::string_view);
void log_error(std::string_view);

}  // namespace roci::services
