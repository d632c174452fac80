// One case for each constraint of appendix A (R111, R126): with the limit a product stays on
// board, without it it is sent.
#include <gtest/gtest.h>

#include <stdexcept>

#include "planner_svc/utility_htn/downlink/manager.hpp"

namespace roci::planner::utility_htn::downlink {
namespace {

using model::Tier;
using temporal::seconds;

// 100 bytes a second for 10 s at 20 W: 1000 bytes and 200 J.
Window window(const std::string& id, double start, std::uint32_t sol = 0) {
  return {.id = id,
          .start = seconds(start),
          .latest_end = seconds(start + 10),
          .bytes_per_s = 100,
          .power_w = 20,
          .sol = sol};
}
Product product(const std::string& id, std::uint64_t bytes, double created = 0) {
  return {.id = id, .bytes = bytes, .created = seconds(created), .utility = {1}};
}

Assignment assign(const std::vector<Product>& products, const std::vector<Window>& windows,
                  const Limits& limits = {}) {
  return Manager().assign(products, windows, limits);
}

TEST(Constraints, EarthInView) {
  EXPECT_TRUE(assign({product("p", 1000)}, {window("w", 0)}).window[0]);
  const Assignment more = assign({product("p", 1001)}, {window("w", 0)});
  EXPECT_FALSE(more.window[0]);
  EXPECT_EQ(more.left_out.at(0).why,
            "Mandatory product 'p' (1001 bytes) stays on board: it is larger than every window after its "
            "creation; the largest, 'w', carries "
            "1000 bytes (bounded by: Earth is in view no longer)");
}

TEST(Constraints, Rate) {
  Window slow = window("w", 0);
  slow.bytes_per_s = 10;
  EXPECT_TRUE(assign({product("p", 100)}, {slow}).window[0]);
  EXPECT_FALSE(assign({product("p", 101)}, {slow}).window[0]);
}

TEST(Constraints, EnergyOfOneDownlink) {
  Window poor = window("w", 0);
  poor.energy_limit_j = 100;
  const Assignment answer = assign({product("p", 500)}, {poor});
  ASSERT_TRUE(answer.window[0]);
  EXPECT_EQ(answer.loads[0].bytes, 500u);
  EXPECT_EQ(answer.loads[0].duration, seconds(5));
  EXPECT_DOUBLE_EQ(answer.loads[0].energy_j, 100);
  const Assignment more = assign({product("p", 501)}, {poor});
  ASSERT_FALSE(more.window[0]);
  EXPECT_NE(more.left_out.at(0).why.find("the energy limit of one downlink"), std::string::npos);
}

TEST(Constraints, EnergyOfASolIsSharedByItsWindows) {
  const std::vector<Product> products{product("a", 800), product("b", 800)};
  const std::vector<Window> same_sol{window("w0", 0), window("w1", 20)};
  EXPECT_TRUE(assign(products, same_sol).left_out.empty());
  const Limits limits{.sol_energy_j = {{0, 300}}};  // 1500 bytes
  const Assignment answer = assign(products, same_sol, limits);
  ASSERT_EQ(answer.left_out.size(), 1u);
  EXPECT_EQ(answer.left_out[0].reason, Reason::no_room);
  EXPECT_NE(answer.left_out[0].why.find("the energy of its sol is spent"), std::string::npos);
  EXPECT_TRUE(assign(products, {window("w0", 0, 0), window("w1", 20, 1)}, limits).left_out.empty());
}

TEST(Constraints, HeatOfTheRadio) {
  Window hot = window("w", 0);
  hot.heat_limit_s = 3;
  EXPECT_TRUE(assign({product("p", 300)}, {hot}).window[0]);
  const Assignment more = assign({product("p", 301)}, {hot});
  ASSERT_FALSE(more.window[0]);
  EXPECT_NE(more.left_out.at(0).why.find("the radio's temperature limit"), std::string::npos);
}

TEST(Constraints, SizesAddUpAndNothingIsSplit) {
  const Assignment answer =
      assign({product("a", 600), product("b", 600), product("c", 400)}, {window("w", 0)});
  EXPECT_EQ(answer.left_out.size(), 1u);
  EXPECT_EQ(answer.loads[0].bytes, 1000u);
  EXPECT_EQ(assign({product("p", 1500)}, {window("w0", 0), window("w1", 20)}).left_out.size(), 1u);
}

TEST(Constraints, CreationTime) {
  EXPECT_EQ(assign({product("p", 10, 20)}, {window("w0", 0), window("w1", 20)}).window[0], 1u);
  const Assignment late = assign({product("p", 10, 21)}, {window("w0", 0), window("w1", 20)});
  ASSERT_FALSE(late.window[0]);
  EXPECT_EQ(late.left_out.at(0).reason, Reason::no_window);
  EXPECT_EQ(late.left_out[0].why,
            "Mandatory product 'p' (10 bytes) stays on board: no downlink window starts after its creation "
            "at 21 s");
}

TEST(Constraints, CriticalGoesWithTheFirstWindowAndDecisionalWithWhatItLeaves) {
  Product critical = product("critical", 700);
  critical.tier = Tier::critical;
  Product decisional = product("decisional", 600);
  decisional.tier = Tier::decisional;
  decisional.utility = {9};  // the tier counts first
  Product mandatory = product("mandatory", 900);
  mandatory.utility = {10};
  const Assignment answer =
      assign({mandatory, decisional, critical}, {window("w0", 0), window("w1", 20), window("w2", 40)});
  EXPECT_EQ(answer.window[2], 0u);
  EXPECT_EQ(answer.window[1], 1u);
  EXPECT_EQ(answer.window[0], 2u);
  ASSERT_EQ(answer.late.size(), 1u);
  EXPECT_EQ(answer.late[0].product, 1u);
  EXPECT_EQ(answer.late[0].due, 0u);
  EXPECT_EQ(answer.late[0].why,
            "Decisional product 'decisional' (600 bytes) does not fit into its window 'w0', which carries "
            "1000 bytes (bounded by: Earth is in view "
            "no longer) and has 700 bytes of more urgent or better products");
}

TEST(Constraints, ResidualNeverDisplacesMandatory) {
  Product residual = product("residual", 600);
  residual.tier = Tier::residual;
  residual.utility = {100};
  const Assignment answer = assign({residual, product("mandatory", 600)}, {window("w", 0)});
  EXPECT_FALSE(answer.window[0]);
  EXPECT_EQ(answer.window[1], 0u);
  EXPECT_EQ(answer.left_out.at(0).reason, Reason::nothing_left_over);
  EXPECT_EQ(answer.left_out[0].why,
            "Residual product 'residual' (600 bytes) stays on board: what the other tiers and better "
            "Residual products leave over is too small; the "
            "most that one has left is 400 bytes, in 'w'");
}

TEST(Constraints, WhatCannotBeIsRefusedByName) {
  const auto refusal = [](const std::vector<Product>& products, const std::vector<Window>& windows,
                          const Limits& limits = {}) {
    try {
      assign(products, windows, limits);
      return std::string();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(refusal({product("p", 1), product("p", 2)}, {}), "downlink: two products have the id 'p'");
  Product negative = product("p", 1);
  negative.utility = {0, -1};
  EXPECT_NE(refusal({negative}, {}).find("product 'p' has the score -1"), std::string::npos);
  Window broken = window("w", 0);
  broken.bytes_per_s = std::nan("");
  EXPECT_EQ(refusal({}, {broken}), "downlink: window 'w' has an impossible rate");
  EXPECT_NE(refusal({}, {window("w1", 20), window("w0", 0)}).find("'w0' stands after one that starts later"),
            std::string::npos);
  EXPECT_EQ(refusal({}, {}, {.sol_energy_j = {{3, -1}}}), "downlink: sol 3 has an impossible energy limit");
}

}  // namespace
}  // namespace roci::planner::utility_htn::downlink
