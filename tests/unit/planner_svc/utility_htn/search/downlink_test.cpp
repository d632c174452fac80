#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/planner_svc/utility_htn/search/toy.hpp"

namespace {

namespace search = roci::planner::utility_htn::search;
namespace model = roci::planner::utility_htn::model;
using model::DataProduct, search::Outcome, search::Problem, search::Toy;
using roci::temporal::seconds;
using testing::ElementsAre;

Toy three_products() {
  Toy toy;
  for (const char* id : {"a", "b", "c"}) {
    const model::TaskIndex task = toy.task(id, 10, 10, {id[0] == 'c' ? 0.9 : 0.5}, true);
    toy[task].products = {{"data", model::Tier::decisional, {id[0] == 'c' ? 900.0 : 100.0, {}, 1}, {0.5}}};
  }
  toy.close();
  return toy;
}

TEST(DownlinkQuestion, ABranchWhoseDataGetNoDownlinkIsPruned) {
  Toy toy = three_products();
  Problem problem = toy.problem(100);
  problem.downlink = [](const search::PlannedData& data) {
    std::uint64_t bytes = 0;
    for (const DataProduct& product : data.products) bytes += product.bytes;
    return bytes <= 500;
  };
  const Outcome found = search::search(problem);
  EXPECT_THAT(toy.names(found.plan), ElementsAre("a", "b"));
  EXPECT_GT(found.statistics.without_downlink, 0U);
}

TEST(DownlinkQuestion, IsAskedForAllThatThePartialPlanGenerates) {
  Toy toy = three_products();
  Problem problem = toy.problem(100);
  std::vector<DataProduct> longest;
  problem.downlink = [&](const search::PlannedData& data) {
    if (data.products.size() > longest.size()) longest = data.products;
    return true;
  };
  search::search(problem);
  ASSERT_EQ(longest.size(), 3U);
  EXPECT_EQ(longest[0].id, "c/c/data");
  EXPECT_EQ(longest[0].tier, model::Tier::decisional);
  EXPECT_EQ(longest[0].bytes, 900U);
  EXPECT_EQ(longest[0].created, seconds(10));
  EXPECT_EQ(longest[2].created, seconds(30));
}

}  // namespace
