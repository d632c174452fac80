#include "planner_svc/utility_htn/downlink/solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "planner_svc/utility_htn/downlink/certificate.hpp"
#include "planner_svc/utility_htn/downlink/integer_program.hpp"

namespace roci::planner::utility_htn::downlink {
namespace {

// A placement that the solver's tolerances let through is cut off by name and the solver asked again, at most so often.
constexpr int kMostRefusals = 20;

// Is one answer of CBC: a better placement than asked for, if any, and whether its search came to the end.
struct Answer {
  std::optional<Placement> better;
  bool ended = false;
  double bound = 0;  // of the value, when it did not end
};

// One 0-1 variable for each pair of item and bin, and the rows that stay from rank to rank.
class Program {
 public:
  explicit Program(const Packing& packing) : packing_(packing) {
    const auto allowed = choices(packing);
    by_item_.resize(allowed.size());
    by_bin_.resize(packing.bins.size());
    for (std::size_t i = 0; i < allowed.size(); ++i) {
      for (const std::uint32_t bin : allowed[i]) {
        by_item_[i].push_back(static_cast<int>(pairs_.size()));
        by_bin_[bin].push_back(static_cast<int>(pairs_.size()));
        pairs_.emplace_back(i, bin);
      }
      if (by_item_[i].size() > 1) add_once(i);
    }
    add_capacities();
    add_energies();
  }

  // Asks that the sum over the items placed is at least `value`.
  template <typename Value>
  void keep(const Value& value_of, double value) {
    Row row{.lower = value - 0.5};  // all are integers
    double largest = 1;
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      largest = std::max(largest, std::abs(value_of(pairs_[p].first)));
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const double here = value_of(pairs_[p].first);
      if (here != 0) row.terms.emplace_back(static_cast<int>(p), here / largest);
    }
    row.lower /= largest;
    rows_.push_back(std::move(row));
  }

  // Looks for a placement whose sum of gains is greater than `value`; gains are integers.
  template <typename Gain>
  Answer improve(const Gain& gain, double value, int most_nodes) {
    for (int refusals = 0; refusals < kMostRefusals; ++refusals) {
      Answer answer;
      Placement placement(packing_.items.size());
      if (!ask(gain, value, most_nodes, answer, placement)) return answer;
      if (holds(packing_, placement)) {
        answer.better = std::move(placement);
        return answer;
      }
      refuse(placement);
    }
    return {.better = {}, .ended = false, .bound = std::numeric_limits<double>::max()};
  }

 private:
  void add_once(std::size_t item) {
    Row row{.upper = 1};
    for (const int p : by_item_[item]) row.terms.emplace_back(p, 1);
    rows_.push_back(std::move(row));
  }

  void add_capacities() {
    for (std::size_t bin = 0; bin < packing_.bins.size(); ++bin) {
      if (packing_.bins[bin].used >= packing_.bins[bin].capacity) continue;
      const double left = static_cast<double>(packing_.bins[bin].capacity - packing_.bins[bin].used);
      Row row{.upper = 1};
      for (const int p : by_bin_[bin]) {
        row.terms.emplace_back(
            p, static_cast<double>(packing_.items[pairs_[static_cast<std::size_t>(p)].first].bytes) / left);
      }
      rows_.push_back(std::move(row));
    }
  }

  void add_energies() {
    const std::vector<double> joules = joules_left(packing_);
    for (std::size_t sol = 0; sol < joules.size(); ++sol) {
      const double left = joules[sol];
      if (left <= 0) continue;  // nothing fits there, so no pair stands for it
      Row row{.upper = 1};
      for (std::size_t p = 0; p < pairs_.size(); ++p) {
        const Bin& bin = packing_.bins[pairs_[p].second];
        if (bin.sol != sol) continue;
        row.terms.emplace_back(
            static_cast<int>(p),
            bin.joules_per_byte * static_cast<double>(packing_.items[pairs_[p].first].bytes) / left);
      }
      rows_.push_back(std::move(row));
    }
  }

  void refuse(const Placement& placement) {
    Row row;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      if (placement[pairs_[p].first] == pairs_[p].second) row.terms.emplace_back(static_cast<int>(p), 1);
    }
    row.upper = static_cast<double>(row.terms.size()) - 1;
    rows_.push_back(std::move(row));
  }

  // Returns whether there is a better one.
  template <typename Gain>
  bool ask(const Gain& gain, double value, int most_nodes, Answer& answer, Placement& placement) const {
    std::vector<Variable> variables;
    for (const auto& [item, bin] : pairs_) variables.push_back({.gain = gain(item, bin)});
    const Optimum found = maximize(variables, rows_, value, most_nodes);
    answer.ended = found.ended;
    answer.bound = found.bound;
    for (std::size_t p = 0; p < found.values.size(); ++p)
      if (found.values[p] == 1) placement[pairs_[p].first] = pairs_[p].second;
    return !found.values.empty();
  }

  const Packing& packing_;
  std::vector<std::pair<std::size_t, std::uint32_t>> pairs_;
  std::vector<std::vector<int>> by_item_;
  std::vector<std::vector<int>> by_bin_;
  std::vector<Row> rows_;
};

}  // namespace

std::size_t variables(const Packing& packing) {
  std::size_t out = 0;
  for (const auto& bins : choices(packing)) out += bins.size();
  return out;
}

Solved solve(const Packing& packing, const Placement& start, int most_nodes) {
  Solved out{.placement = start};
  const auto allowed = choices(packing);
  Program program(packing);
  for (std::uint32_t rank = 0; rank <= packing.ranks; ++rank) {  // the last one counts what is sent
    const auto value = [&](std::size_t i) { return static_cast<double>(value_of(packing, i, rank)); };
    const auto sum = [&] {
      double total = 0;
      for (std::size_t i = 0; i < out.placement.size(); ++i) total += out.placement[i] ? value(i) : 0;
      return total;
    };
    double most = 0;
    for (std::size_t i = 0; i < allowed.size(); ++i) most += allowed[i].empty() ? 0 : value(i);
    if (most == 0) continue;
    if (sum() < most) {
      const Answer answer =
          program.improve([&](std::size_t i, std::uint32_t) { return value(i); }, sum(), most_nodes);
      if (answer.better) out.placement = *answer.better;
      if (!answer.ended) {
        const double bound = std::min(most, std::floor(answer.bound * (1 + 1e-9)));
        out.rank = rank;
        out.gap = bound > 0 ? std::max(0.0, (bound - sum()) / bound) : 0;
        if (out.gap > 0) return out;
      }
    }
    program.keep(value, sum());
  }
  out.best = true;
  const Worth here = worth(packing, out.placement);
  if (-here.earliness <= least_lateness(packing, here.sent)) {
    out.earliest = true;
    return out;
  }
  const Answer answer =
      program.improve([](std::size_t, std::uint32_t bin) { return -static_cast<double>(bin); },
                      static_cast<double>(here.earliness), most_nodes);
  if (answer.better) out.placement = *answer.better;
  out.earliest = answer.ended;
  return out;
}

std::optional<bool> solve_all_fit(const Packing& packing, int most_nodes) {
  Program program(packing);
  const double one_less = static_cast<double>(packing.items.size()) - 1;
  const Answer answer = program.improve([](std::size_t, std::uint32_t) { return 1.0; }, one_less, most_nodes);
  if (answer.better) return true;
  return answer.ended ? std::optional(false) : std::nullopt;
}

}  // namespace roci::planner::utility_htn::downlink
