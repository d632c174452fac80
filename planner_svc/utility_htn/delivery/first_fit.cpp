#include "planner_svc/utility_htn/delivery/first_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace roci::planner::utility_htn::delivery {

using model::DataProduct, model::Tier;

bool first_fit(std::span<const DataProduct> standing, std::span<const DataProduct> candidates,
               std::span<const downlink::Window> windows) {
  std::vector<std::uint64_t> left;
  left.reserve(windows.size());
  for (const downlink::Window& window : windows) {
    const double bytes = temporal::to_seconds(window.latest_end - window.start) * window.bytes_per_s;
    left.push_back(static_cast<std::uint64_t>(std::clamp(std::floor(bytes), 0.0, 1e18)));
  }
  std::vector<const DataProduct*> mandatory;
  for (const auto& products : {standing, candidates}) {
    for (const DataProduct& product : products) {
      if (product.tier == Tier::residual) continue;
      if (product.tier == Tier::mandatory) {
        mandatory.push_back(&product);
        continue;
      }
      const auto due = std::ranges::lower_bound(windows, product.created, {}, &downlink::Window::start);
      if (due == windows.end()) return false;
      std::uint64_t& room = left[static_cast<std::size_t>(due - windows.begin())];
      if (product.bytes > room) return false;
      room -= product.bytes;
    }
  }
  // Those that are created last have least choice.
  std::ranges::stable_sort(mandatory, std::greater{}, [](const auto* product) { return product->created; });
  for (const DataProduct* product : mandatory) {
    auto window = static_cast<std::size_t>(
        std::ranges::lower_bound(windows, product->created, {}, &downlink::Window::start) - windows.begin());
    while (window < windows.size() && left[window] < product->bytes) ++window;
    if (window == windows.size()) return false;
    left[window] -= product->bytes;
  }
  return true;
}

}  // namespace roci::planner::utility_htn::delivery
