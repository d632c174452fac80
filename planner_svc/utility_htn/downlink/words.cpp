#include "planner_svc/utility_htn/downlink/words.hpp"

#include <algorithm>

namespace roci::planner::utility_htn::downlink {
namespace {

std::string bytes(std::uint64_t count) { return std::to_string(count) + " bytes"; }

std::string name(const Product& product) {
  return words(product.tier) + " product '" + product.id + "' (" + bytes(product.bytes) + ")";
}

}  // namespace

std::string words(Bound bound) {
  switch (bound) {
    case Bound::earth_in_view:
      return "Earth is in view no longer";
    case Bound::downlink_energy:
      return "the energy limit of one downlink";
    case Bound::heat:
      return "the radio's temperature limit";
    case Bound::sol_energy:
      return "the sol's energy limit for downlinks";
  }
  return "";
}

std::string words(model::Tier tier) {
  switch (tier) {
    case model::Tier::critical:
      return "Critical";
    case model::Tier::decisional:
      return "Decisional";
    case model::Tier::mandatory:
      return "Mandatory";
    case model::Tier::residual:
      return "Residual";
  }
  return "";
}

LeftOut left_out(std::span<const Product> products, std::size_t index, std::span<const Window> windows,
                 const Limits& limits, std::size_t first, std::span<const Load> loads) {
  const Product& product = products[index];
  LeftOut out{.product = index};
  if (first == windows.size()) {
    out.reason = Reason::no_window;
    out.why = name(product) + " stays on board: no downlink window starts after its creation at " +
              temporal::to_text(product.created);
    return out;
  }
  std::size_t widest = first;
  std::size_t freest = first;
  const auto carries = [&](std::size_t w) { return capacity(windows[w], limits).bytes; };
  const auto free = [&](std::size_t w) { return carries(w) - std::min(carries(w), loads[w].bytes); };
  for (std::size_t w = first; w < windows.size(); ++w) {
    if (carries(w) > carries(widest)) widest = w;
    if (free(w) > free(freest)) freest = w;
  }
  if (carries(widest) < product.bytes) {
    out.reason = Reason::larger_than_windows;
    out.why = name(product) +
              " stays on board: it is larger than every window after its creation; the largest, '" +
              windows[widest].id + "', carries " + bytes(carries(widest)) +
              " (bounded by: " + words(capacity(windows[widest], limits).bound) + ")";
    return out;
  }
  const bool residual = product.tier == model::Tier::residual;
  out.reason = residual ? Reason::nothing_left_over : Reason::no_room;
  out.why = name(product) + " stays on board: " +
            (residual ? "what the other tiers and better Residual products leave over is too small"
                      : "products of higher tiers or utility fill the windows after its creation") +
            (free(freest) >= product.bytes ? "; the energy of its sol is spent where there would be time"
                                           : "; the most that one has left is " + bytes(free(freest)) +
                                                 ", in '" + windows[freest].id + "'");
  return out;
}

std::string why_late(const Product& product, const Window& due, const Capacity& capacity,
                     std::uint64_t taken) {
  return name(product) + " does not fit into its window '" + due.id + "', which carries " +
         bytes(capacity.bytes) + " (bounded by: " + words(capacity.bound) + ")" +
         (taken > 0 ? " and has " + bytes(taken) + " of more urgent or better products" : "");
}

}  // namespace roci::planner::utility_htn::downlink
