#include "sim_svc/windows.hpp"

namespace roci::sim {

bool Window::is_open(Time t) const {
  for (const auto& [opens, closes] : open) {
    if (t >= opens && t < closes) return true;
  }
  return false;
}

std::optional<Time> Window::next_change(Time t) const {
  for (const auto& [opens, closes] : open) {
    if (t < opens) return opens;
    if (t < closes) return closes;
  }
  return std::nullopt;
}

}  // namespace roci::sim
