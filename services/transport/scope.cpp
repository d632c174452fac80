#include "services/transport/scope.hpp"

#include <algorithm>
#include <stdexcept>

namespace roci::services::transport {
namespace {

constexpr char kTeam[] = "roci.team";
constexpr char kInner[] = "roci.inner";

bool is_name(const std::string& robot) {
  return std::ranges::all_of(robot, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  });
}

}  // namespace

std::vector<std::string> partitions_of(Scope scope, const std::string& robot) {
  if (!is_name(robot)) {
    throw std::invalid_argument("robot \"" + robot +
                                "\": a robot's name consists of letters, digits, '_', '-' and '.'");
  }
  switch (scope) {
    case Scope::everyone:
      return {};
    case Scope::team:
      return {kTeam};
    case Scope::robot:
      break;
  }
  const std::string inner(kInner);
  if (robot.empty()) return {inner, inner + ".*"};
  return {inner + "." + robot};
}

}  // namespace roci::services::transport
