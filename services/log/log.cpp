#include "services/log/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace roci::services::log {
namespace {

spdlog::logger& logger() {
  static const auto instance = spdlog::stderr_color_mt("roci");
  return *instance;
}

}  // namespace

void info(std::string_view text) { logger().info("{}", text); }
void warning(std::string_view text) { logger().warn("{}", text); }
void error(std::string_view text) { logger().error("{}", text); }

}  // namespace roci::services::log
