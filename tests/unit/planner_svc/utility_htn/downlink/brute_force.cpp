#include "tests/unit/planner_svc/utility_htn/downlink/brute_force.hpp"

#include <algorithm>
#include <cmath>

namespace roci::planner::utility_htn::downlink {
namespace {

using Windows = std::vector<std::optional<std::uint32_t>>;

bool at_most(double value, double limit) { return value <= limit * (1 + 1e-12); }

}  // namespace

RandomQuestion draw(std::mt19937_64& random, bool all_tiers) {
  const auto between = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
  RandomQuestion out;
  const int windows = between(1, 4);
  std::int64_t time = 0;
  for (int w = 0; w < windows; ++w) {
    time += between(0, 50);
    Window window{.id = "w" + std::to_string(w),
                  .start = temporal::seconds(static_cast<double>(time)),
                  .latest_end = temporal::seconds(static_cast<double>(time + between(2, 12))),
                  .bytes_per_s = between(0, 1) == 0 ? 100.0 : 250.0,
                  .power_w = between(0, 3) == 0 ? 0.0 : between(1, 3) * 10.0,
                  .sol = static_cast<std::uint32_t>(between(0, 1))};
    if (between(0, 2) == 0) window.energy_limit_j = between(20, 150);
    if (between(0, 2) == 0) window.heat_limit_s = between(1, 8);
    out.windows.push_back(window);
  }
  for (std::uint32_t sol = 0; sol < 2; ++sol) {
    if (between(0, 1) == 0) out.limits.sol_energy_j[sol] = between(10, 250);
  }
  const int products = between(1, 8);
  const int scale = between(1, 4);
  const int ranks = between(1, 3);
  for (int p = 0; p < products; ++p) {
    std::vector<double> scores;
    for (int rank = 0; rank < ranks; ++rank)
      scores.push_back(between(0, 3) * 0.25 + (between(0, 3) == 0 ? 0.000001 * between(0, 9) : 0));
    Product product{.id = "p" + std::to_string(p),
                    .bytes = static_cast<std::uint64_t>(between(between(0, 9) == 0 ? 0 : 100, 400 * scale)),
                    .created = temporal::seconds(between(0, 2) == 0 ? between(0, 120) : 0),
                    .utility = temporal::RankVector(scores)};
    if (all_tiers) product.tier = static_cast<model::Tier>(between(0, 3));
    out.products.push_back(product);
  }
  return out;
}

bool allowed(const RandomQuestion& question, const Windows& window) {
  std::map<std::uint32_t, double> sol_energy;
  for (std::uint32_t w = 0; w < question.windows.size(); ++w) {
    const Window& here = question.windows[w];
    double bytes = 0;
    for (std::size_t p = 0; p < window.size(); ++p) {
      if (window[p] != w) continue;
      if (here.start < question.products[p].created) return false;
      bytes += static_cast<double>(question.products[p].bytes);
    }
    const double seconds = bytes / here.bytes_per_s;
    if (!at_most(seconds, temporal::to_seconds(here.latest_end - here.start))) return false;
    if (!at_most(seconds, here.heat_limit_s) || !at_most(seconds * here.power_w, here.energy_limit_j))
      return false;
    sol_energy[here.sol] += seconds * here.power_w;
  }
  return std::ranges::all_of(question.limits.sol_energy_j, [&](const auto& limit) {
    return at_most(sol_energy[limit.first], limit.second);
  });
}

std::vector<std::int64_t> worth_of(const RandomQuestion& question, model::Tier tier, const Windows& window) {
  std::vector<std::int64_t> out(5, 0);  // three ranks, number sent, earliness
  for (std::size_t p = 0; p < window.size(); ++p) {
    if (!window[p] || question.products[p].tier != tier) continue;
    for (std::size_t rank = 0; rank < 3; ++rank)
      out[rank] += std::llround(question.products[p].utility[rank] * 1e6);
    ++out[3];
    out[4] -= *window[p];
  }
  return out;
}

std::vector<std::int64_t> greatest(const RandomQuestion& question, model::Tier tier, Windows window) {
  std::vector<std::size_t> free;
  for (std::size_t p = 0; p < window.size(); ++p) {
    if (question.products[p].tier != tier) continue;
    free.push_back(p);
    window[p].reset();
  }
  std::vector<std::int64_t> best = worth_of(question, tier, window);
  const auto choose = [&](const auto& self, std::size_t depth) -> void {
    if (!allowed(question, window)) return;
    if (depth == free.size()) {
      best = std::max(best, worth_of(question, tier, window));
      return;
    }
    self(self, depth + 1);
    for (std::uint32_t w = 0; w < question.windows.size(); ++w) {
      window[free[depth]] = w;
      self(self, depth + 1);
    }
    window[free[depth]].reset();
  };
  choose(choose, 0);
  return best;
}

std::string fault(const RandomQuestion& question, const Assignment& answer) {
  if (!allowed(question, answer.window)) return "a limit is broken";
  Windows others = answer.window;
  for (std::size_t p = 0; p < others.size(); ++p) {  // the Residual ones take nothing from the others
    if (question.products[p].tier == model::Tier::residual) others[p].reset();
  }
  using model::Tier;
  if (worth_of(question, Tier::mandatory, answer.window) != greatest(question, Tier::mandatory, others)) {
    return "the Mandatory products could be worth more";
  }
  if (worth_of(question, Tier::residual, answer.window) !=
      greatest(question, Tier::residual, answer.window)) {
    return "the Residual products could be worth more";
  }
  if (answer.proof.gap != 0 || answer.proof.by == Proof::By::bound || !answer.proof.earliest_too)
    return "no proof";
  for (std::size_t p = 0; p < others.size(); ++p) {
    const bool named = std::ranges::any_of(
        answer.left_out, [&](const LeftOut& left) { return left.product == p && !left.why.empty(); });
    if (named == answer.window[p].has_value())
      return "product " + std::to_string(p) + " is not named as it should be";
  }
  for (std::uint32_t w = 0; w < question.windows.size(); ++w) {
    std::uint64_t bytes = 0;
    for (std::size_t p = 0; p < others.size(); ++p)
      bytes += answer.window[p] == w ? question.products[p].bytes : 0;
    if (answer.loads[w].bytes != bytes) return "the load of a window is not that of its products";
  }
  return "";
}

}  // namespace roci::planner::utility_htn::downlink
