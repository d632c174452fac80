#include "planner_svc/utility_htn/downlink/filling.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

namespace roci::planner::utility_htn::downlink {
namespace {

using Items = std::vector<std::size_t>;

// A bin is closed with some of these: the last that it took, and the first that it did not.
constexpr std::size_t kTakenBack = 8, kNext = 12;

// At most so many items give way to one.
constexpr std::size_t kMostOut = 24;

// So many orders are tried: the largest first, the densest first, and shuffled ones, each always the same.
constexpr std::uint32_t kAttempts = 4;

// Knuth's multiplicative hash.
std::uint32_t shuffled(std::size_t item, std::uint32_t attempt) {
  return (static_cast<std::uint32_t>(item) + attempt) * 2654435769U ^ attempt * 40503U;
}

/// Is a sum of some items' bytes; bits name them.
struct Sum {
  std::uint64_t bytes = 0;
  std::uint32_t items = 0;
};

std::vector<Sum> sums(const std::vector<std::uint64_t>& bytes, std::size_t from, std::size_t to) {
  std::vector<Sum> out{{}};
  for (std::size_t i = from; i < to; ++i)
    for (std::size_t k = 0, count = out.size(); k < count; ++k)
      out.push_back({out[k].bytes + bytes[i], out[k].items | 1U << i});
  std::ranges::stable_sort(out, {}, &Sum::bytes);
  return out;
}

// Returns which of these together leave least of that many bytes: each sum of one half meets its best of the other
// (Horowitz and Sahni 1974).
std::uint32_t closest(std::uint64_t most, const std::vector<std::uint64_t>& bytes) {
  const std::size_t half = bytes.size() / 2;
  const std::vector<Sum> some = sums(bytes, 0, half), others = sums(bytes, half, bytes.size());
  Sum best;
  auto other = others.rbegin();
  for (const Sum& one : some) {
    if (one.bytes > most) break;
    while (other->bytes > most - one.bytes) ++other;  // the empty sum stays
    if (one.bytes + other->bytes > best.bytes) best = {one.bytes + other->bytes, one.items | other->items};
  }
  return best.items;
}

class Filling {
 public:
  Filling(const Packing& packing, const Chosen& chosen, std::uint32_t attempt)
      : packing_(packing),
        chosen_(chosen),
        room_(packing),
        spare_joules_(joules_left(packing)),
        placement_(packing.items.size()) {
    for (std::size_t i = 0; i < packing.items.size(); ++i)
      if (chosen.items[i]) waiting_.push_back(i);
    for (std::size_t bin = 0; bin < packing.bins.size(); ++bin)
      if (const Bin& here = packing.bins[bin]; here.sol)
        spare_joules_[*here.sol] -= here.joules_per_byte * chosen.bytes[bin];
    std::ranges::stable_sort(waiting_, [&](std::size_t a, std::size_t b) {
      return attempt == 0   ? bytes(a) > bytes(b)
             : attempt == 1 ? denser(packing, a, b)
                            : shuffled(a, attempt) < shuffled(b, attempt);
    });
  }

  Placement run() && {
    for (std::uint32_t bin = 0; bin < packing_.bins.size(); ++bin) fill_bin(bin);
    Items order(packing_.items.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return denser(packing_, a, b); });
    for (const std::size_t i : order)
      if (!placement_[i] && !put_anywhere(i) && !make_room(i) && chosen_.items[i]) exchange(i);
    return std::move(placement_);
  }

 private:
  std::uint64_t bytes(std::size_t item) const { return packing_.items[item].bytes; }

  void put(std::size_t item, std::uint32_t bin) {
    room_.take(bytes(item), bin);
    placement_[item] = bin;
  }

  // Returns the first bin with room for it, but for one.
  std::optional<std::uint32_t> free_bin(std::size_t item, std::optional<std::uint32_t> but = {}) const {
    for (std::uint32_t bin = packing_.items[item].first; bin < packing_.bins.size(); ++bin)
      if (bin != but && room_.fits(bytes(item), bin)) return bin;
    return std::nullopt;
  }

  bool put_anywhere(std::size_t item) {
    const auto bin = free_bin(item);
    if (bin) put(item, *bin);
    return bin.has_value();
  }

  // What it is to take, and what nobody else is to take of its sol's energy.
  std::uint64_t most_bytes(std::uint32_t bin) const {
    const Bin& here = packing_.bins[bin];
    const double left = here.used < here.capacity ? static_cast<double>(here.capacity - here.used) : 0;
    if (!here.sol || here.joules_per_byte <= 0) return static_cast<std::uint64_t>(left);
    const double spare = std::max(0.0, spare_joules_[*here.sol]) / here.joules_per_byte;
    return static_cast<std::uint64_t>(std::clamp(chosen_.bytes[bin] + spare, 0.0, left));
  }

  // Whatever is there by now is there for all bins to come, so any of it will do: what comes first in the order; and
  // with the last of that and the next the bin is closed.
  void fill_bin(std::uint32_t bin) {
    const std::uint64_t most = most_bytes(bin);
    Items here;
    for (const std::size_t i : waiting_)
      if (packing_.items[i].first <= bin && bytes(i) <= most) here.push_back(i);
    Items taken;
    std::uint64_t left = most;
    std::erase_if(here, [&](std::size_t i) {
      const bool can = bytes(i) <= left;
      if (can) {
        left -= bytes(i);
        taken.push_back(i);
      }
      return can;
    });
    for (std::size_t back = 0; back < kTakenBack && !taken.empty(); ++back) {
      left += bytes(taken.back());
      here.insert(here.begin(), taken.back());
      taken.pop_back();
    }
    std::vector<std::uint64_t> sizes;
    for (std::size_t k = 0; k < std::min(here.size(), kTakenBack + kNext); ++k)
      sizes.push_back(bytes(here[k]));
    const std::uint32_t closing = closest(left, sizes);
    for (std::size_t k = 0; k < sizes.size(); ++k)
      if ((closing >> k & 1U) != 0) taken.push_back(here[k]);
    for (const std::size_t i : taken)
      if (room_.fits(bytes(i), bin)) put(i, bin);
    const Bin& filled = packing_.bins[bin];
    const double more = static_cast<double>(room_.used(bin) - filled.used) - chosen_.bytes[bin];
    if (filled.sol) spare_joules_[*filled.sol] -= filled.joules_per_byte * more;
    std::erase_if(waiting_, [&](std::size_t i) { return placement_[i].has_value(); });
  }

  // Moves items of one bin into others that have room, until it has room for this one.
  bool make_room(std::size_t item) {
    for (std::uint32_t bin = packing_.items[item].first; bin < packing_.bins.size(); ++bin) {
      std::vector<std::pair<std::size_t, std::uint32_t>> moved;
      for (const std::size_t i : in(bin)) {
        const auto other = free_bin(i, bin);
        if (!other) continue;
        moved.emplace_back(i, *other);
        room_.give_back(bytes(i), bin);
        put(i, *other);
        if (!room_.fits(bytes(item), bin)) continue;
        put(item, bin);
        return true;
      }
      for (const auto& [i, other] : moved) {
        room_.give_back(bytes(i), other);
        put(i, bin);
      }
    }
    return false;
  }

  // The largest come first.
  Items in(std::uint32_t bin) const {
    Items out;
    for (std::size_t i = 0; i < placement_.size(); ++i)
      if (placement_[i] == bin) out.push_back(i);
    std::ranges::stable_sort(out, [&](std::size_t a, std::size_t b) { return bytes(a) > bytes(b); });
    return out;
  }

  // Takes out what is worth least until there is room for this one, as long as that is less than it is worth.
  void exchange(std::size_t item) {
    Items among, out;
    const Item& wanted = packing_.items[item];
    for (std::size_t i = 0; i < placement_.size(); ++i)
      if (placement_[i] >= wanted.first && packing_.items[i].values < wanted.values) among.push_back(i);
    std::ranges::stable_sort(among, [&](std::size_t a, std::size_t b) { return denser(packing_, b, a); });
    const Placement before = placement_;
    std::vector<std::int64_t> loss(packing_.ranks, 0);
    for (const std::size_t i : among) {
      for (std::size_t rank = 0; rank < packing_.ranks; ++rank) loss[rank] += packing_.items[i].values[rank];
      if (out.size() == kMostOut || loss >= wanted.values) break;
      room_.give_back(bytes(i), *placement_[i]);
      placement_[i].reset();
      out.push_back(i);
      if (put_anywhere(item) || make_room(item)) return;
    }
    for (const std::size_t i : out) put(i, *before[i]);
  }

  const Packing& packing_;
  const Chosen& chosen_;
  Room room_;
  std::vector<double> spare_joules_;  ///< of each sol
  Placement placement_;
  Items waiting_;
};

}  // namespace

Placement fill(const Packing& packing, const Chosen& chosen) {
  Placement best;
  Worth most;
  for (std::uint32_t attempt = 0; attempt < kAttempts; ++attempt) {
    Placement placement = Filling(packing, chosen, attempt).run();
    Worth here = worth(packing, placement);
    if (attempt > 0 && here <= most) continue;
    most = std::move(here);
    best = std::move(placement);
  }
  return best;
}

}  // namespace roci::planner::utility_htn::downlink
