#include "sim_svc/world/windows.hpp"

#include <algorithm>

namespace roci::sim::world {

bool Window::is_open(temporal::Time t) const {
  for (const auto& [opens, closes] : open) {
    if (t >= opens && t < closes) return true;
  }
  return false;
}

std::optional<temporal::Time> Window::next_change(temporal::Time t) const {
  for (const auto& [opens, closes] : open) {
    if (t < opens) return opens;
    if (t < closes) return closes;
  }
  return std::nullopt;
}

void Window::shut(temporal::Time from, temporal::Time until) {
  std::vector<std::pair<temporal::Time, temporal::Time>> left;
  for (const auto& [opens, closes] : open) {
    if (opens < from) left.emplace_back(opens, std::min(closes, from));
    if (closes > until) left.emplace_back(std::max(opens, until), closes);
  }
  open = std::move(left);
}

}  // namespace roci::sim::world
