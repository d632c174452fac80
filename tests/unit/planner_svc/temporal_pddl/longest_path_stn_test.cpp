#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/longest_path_stn.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using constraints::kNoPath;
using constraints::LongestPathStn;
using temporal::Duration;

struct RandomNetwork {
  std::size_t points;
  std::vector<std::tuple<std::size_t, std::size_t, Duration>> edges;
};

// Mostly forward edges, as plans have them, and bounds from above; about half of the networks are
// inconsistent.
RandomNetwork random_network(std::mt19937_64& random) {
  RandomNetwork network{2 + random() % 9, {}};
  const std::size_t edges = random() % 20;
  for (std::size_t i = 0; i < edges; ++i) {
    const std::size_t a = random() % network.points;
    const std::size_t b = random() % network.points;
    const Duration weight(random() % 20);
    network.edges.emplace_back(std::min(a, b), std::max(a, b), weight);
    if (random() % 3 == 0)
      network.edges.emplace_back(std::max(a, b), std::min(a, b),
                                 -weight - Duration(random() % 10));
  }
  return network;
}

// All-pairs longest paths; empty if a cycle is positive.
std::vector<std::vector<Duration>> floyd_warshall(const RandomNetwork& network) {
  std::vector<std::vector<Duration>> d(network.points, std::vector<Duration>(network.points, kNoPath));
  for (std::size_t i = 0; i < network.points; ++i) d[i][i] = Duration{0};
  for (const auto& [from, to, least] : network.edges) d[from][to] = std::max(d[from][to], least);
  for (std::size_t k = 0; k < network.points; ++k) {
    for (std::size_t i = 0; i < network.points; ++i) {
      for (std::size_t j = 0; j < network.points; ++j) {
        if (d[i][k] != kNoPath && d[k][j] != kNoPath) d[i][j] = std::max(d[i][j], d[i][k] + d[k][j]);
      }
    }
  }
  for (std::size_t i = 0; i < network.points; ++i) {
    if (d[i][i] > Duration{0}) return {};
  }
  return d;
}

TEST(LongestPathStn, AgreesWithFloydAndWarshall) {
  std::mt19937_64 random(1);
  std::size_t consistent = 0;
  for (int round = 0; round < 3000; ++round) {
    const RandomNetwork network = random_network(random);
    LongestPathStn stn(network.points);
    for (const auto& [from, to, least] : network.edges) stn.require(from, to, least);
    const auto all = floyd_warshall(network);
    std::vector<Duration> times(network.points, Duration{0});
    EXPECT_EQ(stn.raise(times), !all.empty());
    if (all.empty()) continue;
    ++consistent;
    for (std::size_t i = 0; i < network.points; ++i) {
      EXPECT_EQ(stn.longest_from(i), all[i]);
      Duration least{0};
      for (std::size_t j = 0; j < network.points; ++j) least = std::max(least, all[j][i]);
      EXPECT_EQ(times[i], least);  // all points start at 0 at the earliest
    }
  }
  EXPECT_GT(consistent, 500u);
  EXPECT_LT(consistent, 2500u);
}

TEST(LongestPathStn, RaiseKeepsWhatIsHighEnough) {
  LongestPathStn stn(3);
  stn.require(0, 1, Duration{5});
  stn.require(1, 2, Duration{5});
  std::vector<Duration> times{Duration{0}, Duration{20}, kNoPath};
  EXPECT_TRUE(stn.raise(times));
  EXPECT_EQ(times, (std::vector<Duration>{Duration{0}, Duration{20}, Duration{25}}));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
