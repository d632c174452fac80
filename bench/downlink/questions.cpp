#include "bench/downlink/questions.hpp"

#include <algorithm>
#include <string>

namespace roci::bench::downlink {

using planner::utility_htn::downlink::Limits, planner::utility_htn::downlink::Product,
    planner::utility_htn::downlink::Window;
using planner::utility_htn::model::Tier;

namespace {

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

double seconds_of(const Window& window) {
  double out = std::min(temporal::to_seconds(window.latest_end - window.start), window.heat_limit_s);
  return window.power_w > 0 ? std::min(out, window.energy_limit_j / window.power_w) : out;
}

}  // namespace

std::vector<Window> draw_windows(Random& random, std::size_t count, Limits& limits) {
  std::vector<Window> out;
  for (std::size_t w = 0; w < count; ++w) {
    const double start = static_cast<double>(w / 3) * 84 * 3600 + static_cast<double>(w % 3) * 14 * 3600 +
                         between(random, 0, 3600);
    Window window{.id = "w" + std::to_string(w),
                  .start = temporal::seconds(start),
                  .latest_end = temporal::seconds(start + between(random, 1200, 3600)),
                  .bytes_per_s = between(random, 5'000, 50'000) / 8,
                  .power_w = between(random, 60, 120),
                  .sol = static_cast<std::uint32_t>(w / 3)};
    if (random() % 4 == 0) window.heat_limit_s = between(random, 600, 1800);
    if (random() % 4 == 0) window.energy_limit_j = between(random, 50'000, 200'000);
    limits.sol_energy_j[window.sol] += 0.8 * seconds_of(window) * window.power_w;
    out.push_back(window);
  }
  return out;
}

double capacity(const std::vector<Window>& windows) {
  double out = 0;
  for (const Window& window : windows) out += seconds_of(window) * window.bytes_per_s;
  return out;
}

std::vector<Product> draw_products(Random& random, std::size_t count, double demand, temporal::Time until) {
  std::vector<Product> out;
  double total = 0;
  for (std::size_t p = 0; p < count; ++p) {
    Product product{.id = "p" + std::to_string(p),
                    .bytes = static_cast<std::uint64_t>(between(random, 1'000, 100'000))};
    const std::uint64_t tier = random() % 100;
    product.tier = tier == 0   ? Tier::critical
                   : tier == 1 ? Tier::decisional
                   : tier < 12 ? Tier::residual
                               : Tier::mandatory;
    product.created = temporal::seconds(between(random, 0, temporal::to_seconds(until)));
    std::vector<double> scores(7, 0);
    scores[random() % 3 == 0 ? 1 : 2 + random() % 4] = between(random, 0.05, 1);
    scores[6] = 1;
    product.utility = temporal::RankVector(scores);
    total += static_cast<double>(product.bytes);
    out.push_back(product);
  }
  for (Product& product : out) {
    product.bytes = static_cast<std::uint64_t>(static_cast<double>(product.bytes) * demand / total);
  }
  return out;
}

}  // namespace roci::bench::downlink
