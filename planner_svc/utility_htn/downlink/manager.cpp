#include "planner_svc/utility_htn/downlink/manager.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "planner_svc/utility_htn/downlink/capacity.hpp"
#include "planner_svc/utility_htn/downlink/certificate.hpp"
#include "planner_svc/utility_htn/downlink/packing.hpp"
#include "planner_svc/utility_htn/downlink/selection.hpp"
#include "planner_svc/utility_htn/downlink/solver.hpp"
#include "planner_svc/utility_htn/downlink/words.hpp"

namespace roci::planner::utility_htn::downlink {
namespace {

using model::Tier;
using Indices = std::vector<std::size_t>;

bool has_no_choice(Tier tier) { return tier == Tier::critical || tier == Tier::decisional; }

std::uint32_t first_window(const Product& product, std::span<const Window> windows) {
  const auto found =
      std::ranges::find_if(windows, [&](const Window& window) { return window.start >= product.created; });
  return static_cast<std::uint32_t>(found - windows.begin());
}

// Answers one question step by step: first the products that have no choice,
// then each of the other tiers with what is left.
class Question {
 public:
  Question(std::span<const Product> products, std::span<const Window> windows, const Limits& limits)
      : products_(products), windows_(windows), limits_(limits), bins_(bins_of(windows, limits)) {
    answer_.window.resize(products.size());
    for (const Product& product : products) ranks_ = std::max(ranks_, product.utility.scores().size());
  }

  // Those of the higher tier, then utility, then creation come first.
  // All are tried in their own windows before any goes later.
  void place_those_without_choice() {
    Indices order;
    for (std::size_t p = 0; p < products_.size(); ++p) {
      if (has_no_choice(products_[p].tier)) order.push_back(p);
    }
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      const Product& one = products_[a];
      const Product& other = products_[b];
      if (one.tier != other.tier) return one.tier < other.tier;
      if (one.utility != other.utility) return one.utility > other.utility;
      if (one.created != other.created) return one.created < other.created;
      return one.id < other.id;
    });
    Room room(bins_.bins, bins_.sol_joules);
    Indices later;
    for (const std::size_t p : order) {
      const std::uint32_t due = first_window(products_[p], windows_);
      if (due == windows_.size()) continue;
      if (room.fits(products_[p].bytes, due)) {
        put(p, due, room);
      } else {
        answer_.late.push_back(
            {p, due,
             why_late(products_[p], windows_[due], capacity(windows_[due], limits_), room.used(due))});
        later.push_back(p);
      }
    }
    for (const std::size_t p : later) {
      for (std::uint32_t w = first_window(products_[p], windows_) + 1; w < windows_.size(); ++w) {
        if (!room.fits(products_[p].bytes, w)) continue;
        put(p, w, room);
        break;
      }
    }
    for (std::size_t w = 0; w < windows_.size(); ++w) bins_.bins[w].used = room.used(w);
  }

  Packing packing(const Indices& items) const {
    Packing out{.items = {}, .bins = bins_.bins, .sol_joules = bins_.sol_joules, .ranks = ranks_};
    for (const std::size_t p : items) {
      Item item{.bytes = products_[p].bytes, .first = first_window(products_[p], windows_), .values = {}};
      for (std::size_t rank = 0; rank < ranks_; ++rank)
        item.values.push_back(std::llround(products_[p].utility[rank] / kScoreStep));
      out.items.push_back(std::move(item));
    }
    return out;
  }

  Indices of_tier(Tier tier) const {
    Indices out;
    for (std::size_t p = 0; p < products_.size(); ++p) {
      if (products_[p].tier == tier) out.push_back(p);
    }
    // The answer must not depend on the order in which products are named.
    std::ranges::sort(out, [&](std::size_t a, std::size_t b) { return products_[a].id < products_[b].id; });
    return out;
  }

  void adopt(const Indices& items, const Placement& placement) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (!placement[i]) continue;
      answer_.window[items[i]] = placement[i];
      bins_.bins[*placement[i]].used += products_[items[i]].bytes;
    }
  }

  void add_proof(const Proof& proof) {
    Proof& all = answer_.proof;
    if (all.gap == 0) {
      all.gap = proof.gap;
      all.rank = proof.rank;
    }
    all.by = std::max(all.by, proof.by);
    all.earliest_too = all.earliest_too && proof.earliest_too;
  }

  Assignment finish() && {
    for (std::size_t w = 0; w < windows_.size(); ++w)
      answer_.loads.push_back(load(windows_[w], bins_.bins[w].used));
    for (std::size_t p = 0; p < products_.size(); ++p) {
      if (answer_.window[p]) continue;
      answer_.left_out.push_back(
          left_out(products_, p, windows_, limits_, first_window(products_[p], windows_), answer_.loads));
    }
    std::erase_if(answer_.late, [&](const Late& late) { return !answer_.window[late.product]; });
    std::ranges::sort(answer_.late, {}, &Late::product);
    return std::move(answer_);
  }

  const Assignment& so_far() const { return answer_; }
  void expect_all_proven() { answer_.proof.earliest_too = true; }

 private:
  void put(std::size_t product, std::uint32_t window, Room& room) {
    room.take(products_[product].bytes, window);
    answer_.window[product] = window;
  }

  std::span<const Product> products_;
  std::span<const Window> windows_;
  const Limits& limits_;
  Bins bins_;
  std::size_t ranks_ = 0;
  Assignment answer_;
};

// A node of a large question takes longer, and more of them are needed for the same gain.
int nodes(const Effort& effort, std::size_t variables) {
  const double share = std::min(1.0, 500 / static_cast<double>(std::max<std::size_t>(variables, 1)));
  return std::max(1, static_cast<int>(effort.most_nodes * share * share));
}

struct Settled {
  Placement placement;
  Proof proof;
};

Settled settle(const Packing& packing, const Effort& effort, Counts& counts) {
  Certified certified = certify(packing);
  if (certified.best && certified.earliest) {
    ++counts.certificate;
    return {std::move(certified.placement), {.by = Proof::By::certificate, .earliest_too = true}};
  }
  const bool large = variables(packing) > effort.most_variables;
  if (large && packing.items.size() > effort.most_items) {
    ++counts.open;
    return {std::move(certified.placement),
            {.by = Proof::By::bound, .gap = certified.gap, .rank = certified.rank}};
  }
  Solved solved = large ? select_and_fill(packing, certified.placement, effort.most_nodes_of_items)
                        : solve(packing, certified.placement, nodes(effort, variables(packing)));
  ++(solved.best && solved.earliest ? counts.solver : counts.open);
  return {std::move(solved.placement),
          {.by = solved.best ? Proof::By::solver : Proof::By::bound,
           .gap = solved.gap,
           .rank = solved.rank,
           .earliest_too = solved.earliest}};
}

// Is an answer to "do all have room, each in time?", and what it took; none: the effort was spent.
struct Fit {
  std::optional<bool> all{};
  bool solver = false;
};

Fit fit(const std::vector<Product>& products, std::span<const Window> windows, const Limits& limits,
        const Effort& effort) {
  Question question(products, windows, limits);
  question.place_those_without_choice();
  const Assignment& answer = question.so_far();
  if (!answer.late.empty()) return {.all = false};
  for (std::size_t p = 0; p < products.size(); ++p) {
    if (has_no_choice(products[p].tier) && !answer.window[p]) return {.all = false};
  }
  const Packing packing = question.packing(question.of_tier(Tier::mandatory));
  const AllFit quick = all_fit(packing);
  if (quick != AllFit::unknown) return {.all = quick == AllFit::yes};
  if (variables(packing) > effort.most_variables) return {};
  return {.all = solve_all_fit(packing, nodes(effort, variables(packing))), .solver = true};
}

}  // namespace

Assignment Manager::assign(std::span<const Product> products, std::span<const Window> windows,
                           const Limits& limits) {
  refuse_impossible(products, windows, limits);
  Question question(products, windows, limits);
  question.expect_all_proven();
  question.place_those_without_choice();
  for (const Tier tier : {Tier::mandatory, Tier::residual}) {
    const Indices items = question.of_tier(tier);
    if (items.empty()) continue;
    const Settled settled = settle(question.packing(items), effort_, counts_);
    question.adopt(items, settled.placement);
    question.add_proof(settled.proof);
  }
  return std::move(question).finish();
}

bool Manager::admits(std::span<const Product> products, std::span<const Window> windows, const Limits& limits,
                     std::span<const Product> candidates) {
  const auto residual = [](const Product& product) { return product.tier == Tier::residual; };
  std::vector<Product> all(products.begin(), products.end());
  all.insert(all.end(), candidates.begin(), candidates.end());
  if (!candidates.empty() && std::ranges::all_of(candidates, residual)) {
    const Assignment answer = assign(all, windows, limits);
    return std::all_of(answer.window.begin() + static_cast<std::ptrdiff_t>(products.size()),
                       answer.window.end(), [](const auto& window) { return window.has_value(); });
  }
  std::erase_if(all, residual);
  refuse_impossible(all, windows, limits);
  const auto count = [&](const Fit& fit) {
    ++(!fit.all ? counts_.open : fit.solver ? counts_.solver : counts_.certificate);
    return fit.all.value_or(false);
  };
  const Fit together = fit(all, windows, limits, effort_);
  if (together.all == true) return count(together);

  // Something has no room. It is only the candidates' fault if all has without them;
  // otherwise what stays on board, or goes late, does so.
  std::vector<Product> others(products.begin(), products.end());
  std::erase_if(others, residual);
  Manager inner(effort_);
  const Assignment without = inner.assign(others, windows, limits);
  if (without.left_out.empty() && without.late.empty()) return count(together);
  for (const Late& late : without.late) others[late.product].tier = Tier::mandatory;
  std::vector<Product> rest;
  for (std::size_t p = 0; p < others.size(); ++p) {
    if (without.window[p]) rest.push_back(others[p]);
  }
  std::ranges::copy_if(candidates, std::back_inserter(rest), std::not_fn(residual));
  Fit beside = fit(rest, windows, limits, effort_);
  beside.solver |= inner.counts().solver > 0;
  return count(beside);
}

}  // namespace roci::planner::utility_htn::downlink
