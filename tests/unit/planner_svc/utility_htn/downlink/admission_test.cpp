// Whether the data of one more task has room (appendix A, R127).
#include <gtest/gtest.h>

#include "planner_svc/utility_htn/downlink/manager.hpp"

namespace roci::planner::utility_htn::downlink {
namespace {

using model::Tier;
using temporal::seconds;

Window window(const std::string& id, double start) {
  return {.id = id,
          .start = seconds(start),
          .latest_end = seconds(start + 10),
          .bytes_per_s = 100,
          .power_w = 20};
}
Product product(const std::string& id, std::uint64_t bytes, double created = 0, Tier tier = Tier::mandatory) {
  return {.id = id, .tier = tier, .bytes = bytes, .created = seconds(created), .utility = {1}};
}
bool admits(const std::vector<Product>& products, const std::vector<Window>& windows,
            const std::vector<Product>& candidates, const Limits& limits = {}) {
  return Manager().admits(products, windows, limits, candidates);
}

TEST(Admission, ACandidateNeedsRoomBesideAllThatIsSent) {
  const std::vector<Window> windows{window("w0", 0), window("w1", 20)};
  EXPECT_TRUE(admits({product("a", 900)}, windows, {product("new", 1000)}));
  EXPECT_FALSE(admits({product("a", 900), product("b", 200)}, windows, {product("new", 1000)}));
  EXPECT_FALSE(admits({}, windows, {product("new", 10, 21)}));
  EXPECT_FALSE(admits({}, {}, {product("new", 10)}));
  EXPECT_TRUE(admits({}, {}, {}));
}

// Taking data stops while there is energy left to send what was taken: it is the sol's energy that runs out.
TEST(Admission, EndsWithTheEnergyForDownlinks) {
  const std::vector<Window> windows{window("w0", 0), window("w1", 20)};
  const Limits limits{.sol_energy_j = {{0, 250}}};  // 1250 bytes of 2000
  std::vector<Product> taken;
  while (taken.size() < 10 &&
         admits(taken, windows, {product("p" + std::to_string(taken.size()), 300)}, limits)) {
    taken.push_back(product("p" + std::to_string(taken.size()), 300));
  }
  EXPECT_EQ(taken.size(), 4u);
  EXPECT_TRUE(Manager().assign(taken, windows, limits).left_out.empty());
}

TEST(Admission, WhatHasNoRoomAnywayIsNoReasonToRefuse) {
  const std::vector<Window> windows{window("w0", 0), window("w1", 20)};
  EXPECT_TRUE(admits({product("huge", 5000)}, windows, {product("new", 500)}));
  EXPECT_TRUE(admits({product("huge", 5000), product("a", 900)}, windows, {product("new", 1000)}));
  EXPECT_FALSE(
      admits({product("huge", 5000), product("a", 900), product("b", 900)}, windows, {product("new", 500)}));
}

TEST(Admission, WhatIsUrgentMustBeInTime) {
  const std::vector<Window> windows{window("w0", 0), window("w1", 20)};
  const Product urgent = product("urgent", 600, 0, Tier::critical);
  EXPECT_TRUE(admits({urgent}, windows, {product("new", 400, 0, Tier::decisional)}));
  EXPECT_FALSE(admits({urgent}, windows, {product("new", 500, 0, Tier::decisional)}));
  EXPECT_TRUE(admits({urgent}, windows, {product("new", 500)}));
  // What is late without the candidate stays so.
  EXPECT_TRUE(admits({urgent, product("second", 600, 0, Tier::critical)}, windows, {product("new", 400)}));
}

TEST(Admission, ResidualIsNoReasonToRefuseUnlessItIsAll) {
  const std::vector<Window> windows{window("w0", 0)};
  EXPECT_TRUE(
      admits({product("a", 500)}, windows, {product("new", 500), product("extra", 500, 0, Tier::residual)}));
  EXPECT_FALSE(admits({product("a", 600)}, windows, {product("extra", 500, 0, Tier::residual)}));
  EXPECT_TRUE(admits({product("a", 500)}, windows, {product("extra", 500, 0, Tier::residual)}));
  // Residual products on board give way.
  EXPECT_TRUE(admits({product("old", 900, 0, Tier::residual)}, windows, {product("new", 500)}));
}

// Three of six tenths cannot share two windows, though the bytes would.
TEST(Admission, TheSolverAnswersWhereTheCertificateCannot) {
  const std::vector<Window> windows{window("w0", 0), window("w1", 20)};
  Manager manager;
  EXPECT_FALSE(manager.admits(std::vector{product("a", 600), product("b", 600)}, windows, {},
                              std::vector{product("new", 600)}));
  EXPECT_EQ(manager.counts().solver, 1u);
  EXPECT_TRUE(manager.admits(std::vector{product("a", 600)}, windows, {}, std::vector{product("new", 600)}));
  EXPECT_EQ(manager.counts().certificate, 1u);
}

}  // namespace
}  // namespace roci::planner::utility_htn::downlink
