#include "planner_svc/utility_htn/downlink/packing.hpp"

#include <algorithm>

namespace roci::planner::utility_htn::downlink {
namespace {

// Energy is a sum of products of doubles: a limit that is met to the last digit counts as kept.
constexpr double kLastDigits = 1 + 1e-12;

}  // namespace

double size_of(const Item& item) { return std::max<double>(1, static_cast<double>(item.bytes)); }

bool denser(const Packing& packing, std::size_t one, std::size_t other) {
  const Item& a = packing.items[one];
  const Item& b = packing.items[other];
  for (std::size_t rank = 0; rank < packing.ranks; ++rank) {
    const double here = static_cast<double>(a.values[rank]) / size_of(a);
    const double there = static_cast<double>(b.values[rank]) / size_of(b);
    if (here != there) return here > there;
  }
  return a.bytes < b.bytes;
}

std::vector<double> joules_left(const Packing& packing) {
  std::vector<double> out = packing.sol_joules;
  for (const Bin& bin : packing.bins)
    if (bin.sol) out[*bin.sol] -= bin.joules_per_byte * static_cast<double>(bin.used);
  return out;
}

Worth worth(const Packing& packing, const Placement& placement) {
  Worth out{.sums = std::vector<std::int64_t>(packing.ranks, 0)};
  for (std::size_t i = 0; i < placement.size(); ++i) {
    if (!placement[i]) continue;
    for (std::size_t rank = 0; rank < packing.ranks; ++rank) out.sums[rank] += packing.items[i].values[rank];
    ++out.sent;
    out.earliness -= *placement[i];
  }
  return out;
}

Room::Room(const std::vector<Bin>& bins, const std::vector<double>& sol_joules)
    : bins_(bins), sol_joules_(sol_joules), by_sol_(sol_joules.size()) {
  for (std::size_t bin = 0; bin < bins.size(); ++bin) {
    used_.push_back(bins[bin].used);
    if (bins[bin].sol) by_sol_[*bins[bin].sol].push_back(bin);
  }
}

bool Room::fits(std::uint64_t bytes, std::size_t bin) const {
  if (used_[bin] > bins_[bin].capacity || bytes > bins_[bin].capacity - used_[bin]) return false;
  if (!bins_[bin].sol) return true;
  double joules = 0;
  for (const std::size_t other : by_sol_[*bins_[bin].sol]) {
    joules += bins_[other].joules_per_byte * static_cast<double>(used_[other] + (other == bin ? bytes : 0));
  }
  return joules <= sol_joules_[*bins_[bin].sol] * kLastDigits;
}

std::vector<std::vector<std::uint32_t>> choices(const Packing& packing) {
  const Room empty(packing);
  std::vector<std::vector<std::uint32_t>> out(packing.items.size());
  for (std::size_t i = 0; i < packing.items.size(); ++i) {
    for (std::uint32_t bin = packing.items[i].first; bin < packing.bins.size(); ++bin) {
      if (empty.fits(packing.items[i].bytes, bin)) out[i].push_back(bin);
    }
  }
  return out;
}

bool holds(const Packing& packing, const Placement& placement) {
  Room room(packing);
  for (std::size_t i = 0; i < placement.size(); ++i) {
    if (!placement[i]) continue;
    const Item& item = packing.items[i];
    if (*placement[i] < item.first || !room.fits(item.bytes, *placement[i])) return false;
    room.take(item.bytes, *placement[i]);
  }
  return true;
}

}  // namespace roci::planner::utility_htn::downlink
