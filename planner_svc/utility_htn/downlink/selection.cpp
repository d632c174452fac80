#include "planner_svc/utility_htn/downlink/selection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "planner_svc/utility_htn/downlink/filling.hpp"
#include "planner_svc/utility_htn/downlink/integer_program.hpp"

namespace roci::planner::utility_htn::downlink {
namespace {

using Items = std::vector<std::size_t>;

/// Asks of the ranks above what has been reached there.
struct Kept {
  std::size_t rank = 0;
  std::int64_t sum = 0;
};

/// Chooses items that the bins together can carry.
class Selection {
 public:
  Selection(const Packing& packing, int most_nodes)
      : packing_(packing),
        allowed_(choices(packing)),
        most_nodes_(most_nodes),
        settled_(packing.items.size()) {
    for (const Bin& bin : packing.bins) unit_ = std::max(unit_, static_cast<double>(bin.capacity));
  }

  /// Returns no less than any placement is worth at a rank that has what was kept above it; one that is known is
  /// worth `above` there. What is worth more is chosen.
  std::int64_t bound(std::size_t rank, std::int64_t above) {
    chosen_ = {};
    std::int64_t all = 0;
    for (std::size_t i = 0; i < allowed_.size(); ++i) all += allowed_[i].empty() ? 0 : value(i, rank);
    if (above == all) return all;
    const auto counts = [&](std::size_t i) {
      for (std::size_t upper = 0; upper <= rank; ++upper)
        if (value(i, upper) > 0) return true;
      return false;
    };
    return std::min(all, choose(rank, counts, settled_, kept_, above));
  }
  /// Keeps what the placement is worth at that rank; if it has all there is, those items are settled.
  void keep(std::size_t rank, const Placement& placement) {
    Kept kept{rank, 0};
    bool whole = true;
    for (std::size_t i = 0; i < allowed_.size(); ++i) {
      if (allowed_[i].empty() || value(i, rank) == 0) continue;
      whole = whole && placement[i];
      if (placement[i]) kept.sum += value(i, rank);
    }
    for (std::size_t i = 0; whole && i < allowed_.size(); ++i)
      settled_[i] = settled_[i] || (!allowed_[i].empty() && value(i, rank) > 0);
    if (!whole) kept_.push_back(kept);
  }
  /// Returns what was chosen last, with as much below its rank as has room beside it; empty where nothing was.
  Chosen completed(std::size_t rank) {
    if (chosen_.items.empty()) return {};
    return with_lower_ranks(rank + 1);
  }
  /// Returns what this placement has above the rank, with as much at the rank and below as has room beside it.
  Chosen completed(const Placement& placement, std::size_t rank) {
    chosen_ = {std::vector<bool>(allowed_.size(), false), {}};
    for (std::size_t i = 0; i < allowed_.size(); ++i)
      for (std::size_t upper = 0; upper < rank && placement[i]; ++upper)
        if (value(i, upper) > 0) chosen_.items[i] = true;
    return with_lower_ranks(rank);
  }

 private:
  std::int64_t value(std::size_t i, std::size_t rank) const { return value_of(packing_, i, rank); }

  Chosen with_lower_ranks(std::size_t from) {
    for (std::size_t rank = from; rank <= packing_.ranks; ++rank) {
      const std::vector<bool> before = chosen_.items;
      std::int64_t sum = 0;
      for (std::size_t i = 0; i < before.size(); ++i) sum += before[i] ? value(i, rank) : 0;
      choose(rank, [&](std::size_t i) { return value(i, rank) > 0; }, before, {}, sum - 1);
    }
    return chosen_.bytes.empty() ? Chosen{} : std::exchange(chosen_, {});
  }

  // Adds to `settled` what is best of those that count; returns no less than the sum of the rank's values then.
  template <typename Counts>
  std::int64_t choose(std::size_t rank, const Counts& counts, const std::vector<bool>& settled,
                      const std::vector<Kept>& kept, std::int64_t above) {
    // A variable for each item that is open, and behind them one for what each bin takes, in units of the largest bin.
    Items open;
    std::vector<Variable> variables;
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < allowed_.size(); ++i) {
      if (settled[i]) sum += value(i, rank);
      if (settled[i] || allowed_[i].empty() || !counts(i)) continue;
      open.push_back(i);
      variables.push_back({.gain = static_cast<double>(value(i, rank))});
    }
    for (const Bin& bin : packing_.bins) {
      const double left = bin.used < bin.capacity ? static_cast<double>(bin.capacity - bin.used) : 0;
      variables.push_back({.gain = 0, .whole = false, .upper = left / unit_});
    }
    std::vector<Row> rows = rows_of_bytes(open, settled);
    add_energies(open.size(), rows);
    for (const Kept& one : kept) rows.push_back(row_of(one, open, settled));
    const Optimum found = maximize(variables, rows, static_cast<double>(above - sum), most_nodes_);
    if (!found.values.empty()) {
      chosen_ = {settled, {}};
      for (std::size_t v = 0; v < open.size(); ++v) chosen_.items[open[v]] = found.values[v] == 1;
      for (std::size_t v = open.size(); v < variables.size(); ++v)
        chosen_.bytes.push_back(found.values[v] * unit_);
    }
    if (!found.ended) return sum + static_cast<std::int64_t>(std::floor(found.bound * (1 + 1e-9) + 1e-6));
    if (found.values.empty()) return above;
    for (std::size_t v = 0; v < open.size(); ++v) sum += found.values[v] == 1 ? value(open[v], rank) : 0;
    return sum;
  }

  // What can only go into the bins from one on, these take.
  std::vector<Row> rows_of_bytes(const Items& open, const std::vector<bool>& settled) const {
    std::vector<Row> out;
    for (std::uint32_t bin = 0; bin < packing_.bins.size(); ++bin) {
      Row row{.upper = 0};
      for (std::size_t i = 0; i < allowed_.size(); ++i)
        if (settled[i] && allowed_[i].front() >= bin) row.upper -= units(i);
      for (std::size_t v = 0; v < open.size(); ++v)
        if (allowed_[open[v]].front() >= bin) row.terms.emplace_back(static_cast<int>(v), units(open[v]));
      for (std::size_t later = bin; later < packing_.bins.size(); ++later)
        row.terms.emplace_back(static_cast<int>(open.size() + later), -1);
      out.push_back(std::move(row));
    }
    return out;
  }

  void add_energies(std::size_t before, std::vector<Row>& out) const {
    const std::vector<double> joules = joules_left(packing_);
    for (std::size_t sol = 0; sol < joules.size(); ++sol) {
      const double left = joules[sol], scale = std::max(1.0, left);
      Row row{.upper = std::max(0.0, left) / scale};
      for (std::size_t bin = 0; bin < packing_.bins.size(); ++bin)
        if (packing_.bins[bin].sol == sol)
          row.terms.emplace_back(static_cast<int>(before + bin),
                                 packing_.bins[bin].joules_per_byte * unit_ / scale);
      out.push_back(std::move(row));
    }
  }

  Row row_of(const Kept& kept, const Items& open, const std::vector<bool>& settled) const {
    Row out{.lower = static_cast<double>(kept.sum) - 0.5};  // all are integers
    for (std::size_t i = 0; i < allowed_.size(); ++i)
      if (settled[i]) out.lower -= static_cast<double>(value(i, kept.rank));
    const double scale = std::max(1.0, out.lower);
    for (std::size_t v = 0; v < open.size(); ++v)
      if (const auto here = value(open[v], kept.rank); here > 0)
        out.terms.emplace_back(static_cast<int>(v), static_cast<double>(here) / scale);
    out.lower /= scale;
    return out;
  }

  double units(std::size_t i) const { return static_cast<double>(packing_.items[i].bytes) / unit_; }

  const Packing& packing_;
  std::vector<std::vector<std::uint32_t>> allowed_;
  int most_nodes_;
  double unit_ = 1;            ///< bytes
  std::vector<bool> settled_;  ///< items of ranks of which all has room
  std::vector<Kept> kept_;     ///< of the other ranks so far
  Chosen chosen_;
};

}  // namespace

Solved select_and_fill(const Packing& packing, const Placement& start, int most_nodes) {
  Solved out{.placement = start};
  Worth best = worth(packing, start);
  Selection selection(packing, most_nodes);
  const auto try_to_fill = [&](const Chosen& chosen) {
    if (chosen.items.empty()) return;
    Placement filled = fill(packing, chosen);
    Worth here = worth(packing, filled);
    if (here <= best) return;
    best = std::move(here);
    out.placement = std::move(filled);
  };
  for (std::uint32_t rank = 0; rank <= packing.ranks; ++rank) {  // the last one counts what is sent
    const auto value = [&] { return rank < packing.ranks ? best.sums[rank] : best.sent; };
    const std::int64_t bound = selection.bound(rank, value());
    if (value() < bound) try_to_fill(selection.completed(rank));
    if (value() < bound) try_to_fill(selection.completed(out.placement, rank));
    if (value() < bound) {
      out.rank = rank;
      out.gap = static_cast<double>(bound - value()) / static_cast<double>(bound);
      return out;
    }
    selection.keep(rank, out.placement);
  }
  out.best = true;
  return out;
}

}  // namespace roci::planner::utility_htn::downlink
