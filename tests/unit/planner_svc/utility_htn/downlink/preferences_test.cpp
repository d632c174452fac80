// The two preferences of appendix A (R126, Z17): utility, rank by rank, and then the earliest downlink.
#include <gtest/gtest.h>

#include "planner_svc/utility_htn/downlink/manager.hpp"

namespace roci::planner::utility_htn::downlink {
namespace {

using temporal::seconds;

Window window(const std::string& id, double start) {
  return {.id = id,
          .start = seconds(start),
          .latest_end = seconds(start + 10),
          .bytes_per_s = 100,
          .power_w = 20};
}
Product product(const std::string& id, std::uint64_t bytes, temporal::RankVector utility) {
  return {.id = id, .bytes = bytes, .utility = std::move(utility)};
}

TEST(Preferences, AHigherRankOutweighsAnySumOfLowerOnes) {
  std::vector<Product> products{product("analysis", 1000, {0.001})};
  for (int p = 0; p < 10; ++p) products.push_back(product("image" + std::to_string(p), 100, {0, 1, 1}));
  const Assignment answer = Manager().assign(products, std::vector{window("w", 0)}, {});
  EXPECT_TRUE(answer.window[0]);
  EXPECT_EQ(answer.left_out.size(), 10u);
}

TEST(Preferences, TheHigherUtilityIsSent) {
  const std::vector<Product> products{product("a", 600, {0.4}), product("b", 600, {0.6}),
                                      product("c", 400, {0.1})};
  const Assignment answer = Manager().assign(products, std::vector{window("w", 0)}, {});
  EXPECT_FALSE(answer.window[0]);
  EXPECT_TRUE(answer.window[1]);
  EXPECT_TRUE(answer.window[2]);
}

// Densest first would take "small" and then has room for neither of the others.
TEST(Preferences, TheBestSetIsFoundWhereTheGreedyOneIsNot) {
  const std::vector<Product> products{product("small", 300, {0.35}), product("left", 500, {0.5}),
                                      product("right", 500, {0.5})};
  Manager manager;
  const Assignment answer = manager.assign(products, std::vector{window("w", 0)}, {});
  EXPECT_FALSE(answer.window[0]);
  EXPECT_EQ(answer.proof.by, Proof::By::solver);
  EXPECT_EQ(manager.counts().solver, 1u);
}

TEST(Preferences, OfEqualUtilityMoreIsSentEvenWithoutAny) {
  const std::vector<Product> products{product("whole", 1000, {1}), product("half0", 500, {0.5}),
                                      product("half1", 500, {0.5})};
  EXPECT_EQ(Manager().assign(products, std::vector{window("w", 0)}, {}).left_out.size(), 1u);
  EXPECT_TRUE(
      Manager().assign(std::vector{product("plain", 10, {})}, std::vector{window("w", 0)}, {}).window[0]);
}

TEST(Preferences, TheEarliestDownlinkIsTaken) {
  const std::vector<Window> windows{window("w0", 0), window("w1", 20), window("w2", 40)};
  Manager manager;
  const Assignment answer =
      manager.assign(std::vector{product("a", 400, {1}), product("b", 400, {1})}, windows, {});
  EXPECT_EQ(answer.window[0], 0u);
  EXPECT_EQ(answer.window[1], 0u);
  EXPECT_TRUE(answer.proof.earliest_too);
  EXPECT_EQ(manager.counts().certificate, 1u);
}

// The best product of all goes later so that two others go earlier: what counts is what arrives,
// then how early all of it does.
TEST(Preferences, TheSumOfTheWindowsIsLeast) {
  const std::vector<Window> windows{window("w0", 0), window("w1", 20)};
  const std::vector<Product> products{product("best", 1000, {1}), product("a", 500, {0.5}),
                                      product("b", 500, {0.5})};
  const Assignment answer = Manager().assign(products, windows, {});
  EXPECT_EQ(answer.window[0], 1u);
  EXPECT_EQ(answer.window[1], 0u);
  EXPECT_EQ(answer.window[2], 0u);
}

}  // namespace
}  // namespace roci::planner::utility_htn::downlink
