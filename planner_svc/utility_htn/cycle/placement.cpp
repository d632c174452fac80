#include "planner_svc/utility_htn/cycle/placement.hpp"

#include <algorithm>

namespace roci::planner::utility_htn::cycle {

bool Block::begun() const {
  return std::ranges::any_of(links, [](const Link& link) { return link.stage != Stage::planned; });
}

bool Block::over() const {
  return std::ranges::all_of(links, [](const Link& link) { return is_over(link.stage); });
}

bool Block::failed() const {
  return std::ranges::any_of(links, [](const Link& link) { return link.stage == Stage::failed; });
}

}  // namespace roci::planner::utility_htn::cycle
