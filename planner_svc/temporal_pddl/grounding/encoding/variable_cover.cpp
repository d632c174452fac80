#include "planner_svc/temporal_pddl/grounding/encoding/variable_cover.hpp"

#include <algorithm>
#include <queue>
#include <utility>

namespace roci::planner::temporal_pddl::grounding::encoding {

std::vector<std::vector<std::uint32_t>> cover(const std::vector<bool>& needed,
                                              const std::vector<std::vector<std::uint32_t>>& groups) {
  std::vector<bool> open = needed;
  const auto open_members = [&](const std::vector<std::uint32_t>& group) {
    std::vector<std::uint32_t> members;
    std::ranges::copy_if(group, std::back_inserter(members),
                         [&](std::uint32_t member) { return open[member]; });
    return members;
  };
  // Sizes only shrink, so an entry that is still up to date when it comes out is the largest. Of equal ones
  // the one with the lowest index comes first.
  std::priority_queue<std::pair<std::size_t, std::size_t>> queue;  // open members, last index − index
  for (std::size_t i = 0; i < groups.size(); ++i)
    queue.emplace(open_members(groups[i]).size(), groups.size() - i);
  std::vector<std::vector<std::uint32_t>> result;
  while (!queue.empty()) {
    const auto [size, rank] = queue.top();
    queue.pop();
    auto members = open_members(groups[groups.size() - rank]);
    if (members.size() < 2) continue;
    if (members.size() < size) {
      queue.emplace(members.size(), rank);
      continue;
    }
    for (const std::uint32_t member : members) open[member] = false;
    result.push_back(std::move(members));
  }
  for (std::uint32_t member = 0; member < open.size(); ++member) {
    if (open[member]) result.push_back({member});
  }
  return result;
}

}  // namespace roci::planner::temporal_pddl::grounding::encoding
