#include "services/bounds/tally.hpp"

namespace roci::services::bounds {
namespace {

constexpr std::string_view kOthers = "others";

bool is_power_of_ten(std::uint64_t count) {
  while (count >= 10 && count % 10 == 0) count /= 10;
  return count == 1;
}

}  // namespace

std::uint64_t Tally::note(std::string_view what) {
  auto found = counts_.find(what);
  if (found == counts_.end())
    found = counts_.try_emplace(std::string(counts_.size() < kNames ? what : kOthers), 0).first;
  const std::uint64_t count = ++found->second;
  return is_power_of_ten(count) ? count : 0;
}

std::uint64_t Tally::count(std::string_view what) const {
  const auto found = counts_.find(what);
  return found == counts_.end() ? 0 : found->second;
}

}  // namespace roci::services::bounds
