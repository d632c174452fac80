#include "services/vendors/inproc/partitions.hpp"

#include <fnmatch.h>

#include <algorithm>

namespace roci::services::vendors::inproc {
namespace {

bool is_pattern(const std::string& partition) { return partition.find_first_of("*?[") != std::string::npos; }

bool match(const std::string& one, const std::string& other) {
  if (is_pattern(one) && is_pattern(other)) return false;
  return one == other || fnmatch(one.c_str(), other.c_str(), 0) == 0 ||
         fnmatch(other.c_str(), one.c_str(), 0) == 0;
}

}  // namespace

bool partitions_match(const std::vector<std::string>& one, const std::vector<std::string>& other) {
  static const std::vector<std::string> none{""};
  return std::ranges::any_of(one.empty() ? none : one, [&](const std::string& here) {
    return std::ranges::any_of(other.empty() ? none : other,
                               [&](const std::string& there) { return match(here, there); });
  });
}

}  // namespace roci::services::vendors::inproc
