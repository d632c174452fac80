#include "planner_svc/utility_htn/downlink/capacity.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

namespace roci::planner::utility_htn::downlink {
namespace {

// Above this, integers are no longer exact in the solver, which counts in doubles.
constexpr double kMostBytes = 9e15;

std::uint64_t whole_bytes(double bytes) {
  return static_cast<std::uint64_t>(std::min(kMostBytes, std::max(0.0, std::floor(bytes * (1 + 1e-12)))));
}

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument("downlink: " + what); }

// Infinity means "no limit"; not a number and negative ones mean nothing.
bool is_limit(double value) { return value >= 0; }

}  // namespace

Capacity capacity(const Window& window, const Limits& limits) {
  Capacity out{
      .bytes = whole_bytes(window.bytes_per_s * temporal::to_seconds(window.latest_end - window.start)),
      .bound = Bound::earth_in_view};
  const auto tighten = [&](double seconds, Bound bound) {
    if (!(seconds < kMostBytes)) return;
    const std::uint64_t bytes = whole_bytes(window.bytes_per_s * seconds);
    if (bytes < out.bytes) out = {bytes, bound};
  };
  tighten(window.heat_limit_s, Bound::heat);
  if (window.power_w > 0) {
    tighten(window.energy_limit_j / window.power_w, Bound::downlink_energy);
    const auto sol = limits.sol_energy_j.find(window.sol);
    if (sol != limits.sol_energy_j.end()) tighten(sol->second / window.power_w, Bound::sol_energy);
  }
  return out;
}

Bins bins_of(std::span<const Window> windows, const Limits& limits) {
  Bins out;
  std::map<std::uint32_t, std::size_t> index;
  for (const auto& [sol, joules] : limits.sol_energy_j) {
    if (!std::isfinite(joules)) continue;
    index[sol] = out.sol_joules.size();
    out.sol_joules.push_back(joules);
  }
  for (const Window& window : windows) {
    Bin bin{.capacity = capacity(window, limits).bytes};
    if (window.bytes_per_s > 0) bin.joules_per_byte = window.power_w / window.bytes_per_s;
    const auto sol = index.find(window.sol);
    if (sol != index.end() && bin.joules_per_byte > 0) bin.sol = sol->second;
    out.bins.push_back(bin);
  }
  return out;
}

Load load(const Window& window, std::uint64_t bytes) {
  if (bytes == 0) return {};
  const double seconds = static_cast<double>(bytes) / window.bytes_per_s;
  return {.bytes = bytes,
          .duration = temporal::Duration{static_cast<std::int64_t>(std::ceil(seconds * 1e6 * (1 - 1e-12)))},
          .energy_j = seconds * window.power_w};
}

void refuse_impossible(std::span<const Product> products, std::span<const Window> windows,
                       const Limits& limits) {
  std::set<std::string> ids;
  for (const Product& product : products) {
    if (!ids.insert(product.id).second) refuse("two products have the id '" + product.id + "'");
    for (const double score : product.utility.scores()) {
      if (!(score >= 0 && score <= 1e6)) {
        refuse("product '" + product.id + "' has the score " + std::to_string(score) +
               "; scores go from 0 to 1000000");
      }
    }
    if (static_cast<double>(product.bytes) > kMostBytes)
      refuse("product '" + product.id + "' has an impossible size");
  }
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const Window& window = windows[w];
    if (!(window.bytes_per_s >= 0 && std::isfinite(window.bytes_per_s)))
      refuse("window '" + window.id + "' has an impossible rate");
    if (!(window.power_w >= 0 && std::isfinite(window.power_w)))
      refuse("window '" + window.id + "' has an impossible power");
    if (!is_limit(window.energy_limit_j) || !is_limit(window.heat_limit_s))
      refuse("window '" + window.id + "' has an impossible limit");
    if (window.latest_end < window.start) refuse("window '" + window.id + "' ends before it starts");
    if (w > 0 && window.start < windows[w - 1].start) {
      refuse("window '" + window.id +
             "' stands after one that starts later; windows go in order of their starts");
    }
  }
  for (const auto& [sol, joules] : limits.sol_energy_j) {
    if (!is_limit(joules)) refuse("sol " + std::to_string(sol) + " has an impossible energy limit");
  }
}

}  // namespace roci::planner::utility_htn::downlink
