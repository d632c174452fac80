#include "planner_svc/utility_htn/downlink/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace roci::planner::utility_htn::downlink {
namespace {

using Order = std::vector<std::size_t>;
using Choices = std::vector<std::vector<std::uint32_t>>;

// Sums of doubles err in the last digits; a bound is never to be too small.
double raised(double bound) { return bound * (1 + 1e-9) + 1e-6; }

Placement first_fit(const Packing& packing, const Choices& allowed, const Order& order) {
  Placement out(packing.items.size());
  Room room(packing);
  for (const std::size_t i : order) {
    for (const std::uint32_t bin : allowed[i]) {
      if (!room.fits(packing.items[i].bytes, bin)) continue;
      room.take(packing.items[i].bytes, bin);
      out[i] = bin;
      break;
    }
  }
  return out;
}

template <typename Less>
Order ordered(std::size_t count, const Less& less) {
  Order out(count);
  std::iota(out.begin(), out.end(), std::size_t{0});
  std::ranges::stable_sort(out, less);
  return out;
}

// Within each sol the bins that send most for its energy come first.
Choices cheapest_first(const Packing& packing, Choices allowed) {
  for (std::vector<std::uint32_t>& bins : allowed) {
    for (auto begin = bins.begin(); begin != bins.end();) {
      const auto sol = packing.bins[*begin].sol;
      const auto end = std::find_if(begin, bins.end(),
                                    [&](std::uint32_t bin) { return !sol || packing.bins[bin].sol != sol; });
      const auto next = end == begin ? begin + 1 : end;
      std::stable_sort(begin, next, [&](std::uint32_t a, std::uint32_t b) {
        return packing.bins[a].joules_per_byte < packing.bins[b].joules_per_byte;
      });
      begin = next;
    }
  }
  return allowed;
}

std::vector<Placement> greedy_placements(const Packing& packing, const Choices& allowed) {
  const auto bytes = [&](std::size_t i) { return packing.items[i].bytes; };
  const auto first = [&](std::size_t i) { return packing.items[i].first; };
  const std::size_t count = packing.items.size();
  const std::vector<Order> orders = {
      ordered(count, [&](auto a, auto b) { return denser(packing, a, b); }),
      ordered(count, [&](auto a, auto b) { return bytes(a) < bytes(b); }),
      ordered(count, [&](auto a, auto b) { return bytes(a) > bytes(b); }),
      ordered(
          count,
          [&](auto a, auto b) { return first(a) != first(b) ? first(a) > first(b) : bytes(a) > bytes(b); }),
      ordered(count, [&](auto a, auto b) { return packing.items[a].values > packing.items[b].values; }),
  };
  std::vector<Placement> out;
  for (const Order& order : orders) out.push_back(first_fit(packing, allowed, order));
  if (packing.sol_joules.empty()) return out;
  const Choices cheapest = cheapest_first(packing, allowed);
  for (const Order& order : orders) out.push_back(first_fit(packing, cheapest, order));
  return out;
}

// Within the sol the cheapest bins are filled first, which is the most that its energy can carry.
double most_bytes(const Packing& packing, std::size_t from, std::size_t to) {
  double total = 0;
  std::vector<std::vector<std::size_t>> by_sol(packing.sol_joules.size());
  std::vector<double> joules = joules_left(packing);
  for (std::size_t bin = 0; bin < packing.bins.size(); ++bin) {
    const Bin& here = packing.bins[bin];
    if (bin < from || bin > to || here.used >= here.capacity) continue;
    if (here.sol) {
      by_sol[*here.sol].push_back(bin);
    } else {
      total += static_cast<double>(here.capacity - here.used);
    }
  }
  for (std::size_t sol = 0; sol < by_sol.size(); ++sol) {
    std::ranges::stable_sort(by_sol[sol], {},
                             [&](std::size_t bin) { return packing.bins[bin].joules_per_byte; });
    double left = std::max(0.0, joules[sol]);
    for (const std::size_t bin : by_sol[sol]) {
      const Bin& here = packing.bins[bin];
      double bytes = static_cast<double>(here.capacity - here.used);
      if (here.joules_per_byte > 0) bytes = std::min(bytes, left / here.joules_per_byte);
      left -= bytes * here.joules_per_byte;
      total += bytes;
    }
  }
  return raised(total);
}

// The bound of one rank: `forced` items are in whatever they take, for a rank above has proven that they are.
double fractional_bound(const Packing& packing, const Choices& allowed, const std::vector<double>& from,
                        std::size_t rank, const std::vector<bool>& forced) {
  const auto value = [&](std::size_t i) { return static_cast<double>(value_of(packing, i, rank)); };
  const Order order = ordered(packing.items.size(), [&](std::size_t a, std::size_t b) {
    if (forced[a] != forced[b]) return static_cast<bool>(forced[a]);
    return value(a) / size_of(packing.items[a]) > value(b) / size_of(packing.items[b]);
  });
  std::vector<double> left = from;
  double total = 0;
  for (const std::size_t i : order) {
    if (allowed[i].empty()) continue;
    const double bytes = static_cast<double>(packing.items[i].bytes);
    const auto upto = left.begin() + allowed[i].front() + 1;
    const double taken = std::min(bytes, std::max(0.0, *std::min_element(left.begin(), upto)));
    for (auto slack = left.begin(); slack != upto; ++slack) *slack -= taken;
    total += forced[i] || bytes == 0 ? value(i) : value(i) * taken / bytes;
  }
  return raised(total);
}

}  // namespace

std::vector<double> bytes_from(const Packing& packing) {
  std::vector<double> out;
  for (std::size_t bin = 0; bin < packing.bins.size(); ++bin) {
    out.push_back(most_bytes(packing, bin, packing.bins.size()));
  }
  return out;
}

std::vector<double> bytes_until(const Packing& packing) {
  std::vector<double> out;
  for (std::size_t bin = 0; bin < packing.bins.size(); ++bin) out.push_back(most_bytes(packing, 0, bin));
  return out;
}

std::int64_t least_lateness(const Packing& packing, std::int64_t sent) {
  const std::vector<double> until = bytes_until(packing);
  const Choices allowed = choices(packing);
  const Order smallest = ordered(
      packing.items.size(), [&](auto a, auto b) { return packing.items[a].bytes < packing.items[b].bytes; });
  std::int64_t out = 0;
  for (std::size_t bin = 0; bin < packing.bins.size(); ++bin) {
    double left = until[bin];
    std::int64_t most = 0;
    for (const std::size_t i : smallest) {
      if (allowed[i].empty() || allowed[i].front() > bin) continue;
      left -= static_cast<double>(packing.items[i].bytes);
      if (left < 0) break;
      ++most;
    }
    out += std::max<std::int64_t>(0, sent - most);
  }
  return out;
}

Certified certify(const Packing& packing) {
  const Choices allowed = choices(packing);
  Certified out;
  Worth best;
  for (Placement& placement : greedy_placements(packing, allowed)) {
    Worth here = worth(packing, placement);
    if (!out.placement.empty() && here <= best) continue;
    out.placement = std::move(placement);
    best = std::move(here);
  }
  const std::vector<double> from = bytes_from(packing);
  std::vector<bool> forced(packing.items.size(), false);
  for (std::uint32_t rank = 0; rank <= packing.ranks; ++rank) {  // the last one counts what is sent
    const auto counts = [&](std::size_t i) { return value_of(packing, i, rank) > 0 && !allowed[i].empty(); };
    bool all = true;
    for (std::size_t i = 0; i < packing.items.size(); ++i) all &= !counts(i) || out.placement[i].has_value();
    if (all) {
      for (std::size_t i = 0; i < packing.items.size(); ++i) forced[i] = forced[i] || counts(i);
      continue;
    }
    const double bound = std::floor(fractional_bound(packing, allowed, from, rank, forced));
    const double value = static_cast<double>(rank < packing.ranks ? best.sums[rank] : best.sent);
    if (value < bound) {
      out.rank = rank;
      out.gap = (bound - value) / bound;
      return out;
    }
  }
  out.best = true;
  out.earliest = -best.earliness <= least_lateness(packing, best.sent);
  return out;
}

AllFit all_fit(const Packing& packing) {
  const Choices allowed = choices(packing);
  if (std::ranges::any_of(allowed, [](const auto& bins) { return bins.empty(); })) return AllFit::no;
  const auto whole = [](const Placement& placement) {
    return std::ranges::all_of(placement, [](const auto& bin) { return bin.has_value(); });
  };
  if (std::ranges::any_of(greedy_placements(packing, allowed), whole)) return AllFit::yes;
  const std::vector<double> from = bytes_from(packing);
  std::vector<double> asked(packing.bins.size(), 0);
  for (std::size_t i = 0; i < packing.items.size(); ++i) {
    for (std::uint32_t bin = 0; bin <= allowed[i].front(); ++bin) {
      asked[bin] += static_cast<double>(packing.items[i].bytes);
    }
  }
  for (std::size_t bin = 0; bin < asked.size(); ++bin) {
    if (asked[bin] > from[bin]) return AllFit::no;
  }
  return AllFit::unknown;
}

}  // namespace roci::planner::utility_htn::downlink
