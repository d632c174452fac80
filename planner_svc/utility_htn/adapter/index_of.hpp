// Tasks, parameters and timelines of a network are known outside by their names, and inside by their places.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

namespace roci::planner::utility_htn::adapter {

/// Returns the place of the first item whose `member` is this name; nothing if there is none.
template <class Items, class Member>
std::optional<std::uint32_t> index_of(const Items& items, const std::string& name, Member member) {
  const auto found = std::ranges::find(items, name, member);
  if (found == items.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - items.begin());
}

}  // namespace roci::planner::utility_htn::adapter
