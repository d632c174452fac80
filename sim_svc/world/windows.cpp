#include "sim_svc/world/windows.hpp"

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

}  // namespace roci::sim::world
