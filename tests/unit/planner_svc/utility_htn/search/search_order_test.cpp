#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/planner_svc/utility_htn/search/toy.hpp"

namespace {

namespace search = roci::planner::utility_htn::search;
namespace model = roci::planner::utility_htn::model;
using roci::temporal::RankVector, roci::temporal::seconds, roci::temporal::Time;
using roci::temporal::timelines::Timelines;
using search::Outcome, search::Problem, search::Toy;
using testing::ElementsAre, testing::IsEmpty;

// Notes which chains are tried.
class Spy final : public search::Scheduler {
 public:
  std::optional<std::vector<Time>> schedule(std::span<const search::Link> links,
                                            Timelines& timelines) const override {
    tried.push_back(static_cast<std::uint32_t>(links.front().id >> 16U));
    return search::EarliestScheduler().schedule(links, timelines);
  }
  mutable std::vector<std::uint32_t> tried;
};

Toy three_tasks() {
  Toy toy;
  toy.task("a", 10, 30, {6});  // 0.2 for each unit of energy
  toy.task("b", 10, 20, {5});  // 0.25
  toy.task("c", 10, 50, {4});  // 0.08
  toy.close();
  return toy;
}

TEST(SearchOrder, TakesTheGreatestUtilityPlusUtilityPerCostFirst) {
  Toy toy = three_tasks();
  Problem simple = toy.problem(80);
  const Spy spy;
  Problem problem{toy.network, toy.values, toy.chains, toy.sums, spy, toy.timelines[0]};
  problem.until = simple.until;
  problem.budget = 80;
  const Outcome found = search::search(problem);
  const std::uint32_t a = 0, b = 1, c = 2;
  // b; b+a at 5.2; b+c at 5.08; a at 0.2; a+b at 6.25, met before; c at 0.08; c+b, met before. a+c would cost 80.
  EXPECT_THAT(spy.tried, ElementsAre(b, a, c, a, b, c, b));
  EXPECT_EQ(found.statistics.first_pairs, 3U);
  EXPECT_EQ(found.statistics.entries, 7U);
  EXPECT_EQ(found.statistics.nodes, 6U);
  EXPECT_EQ(found.statistics.duplicates, 2U);
  EXPECT_TRUE(found.complete);
  EXPECT_EQ(found.plan.utility, RankVector{11});
  EXPECT_EQ(found.plan.cost, 50);
}

TEST(SearchOrder, BeginsWithEveryDecomposition) {
  Toy toy;
  std::vector<std::vector<model::TaskIndex>> ways;
  for (const char* id : {"x", "y", "z"}) ways.push_back({toy.task(id, 10, 10, {1}, false, true)});
  toy.parent("p", ways);
  toy.parent("q", {ways[0], ways[1]});
  toy.close();
  EXPECT_EQ(search::search(toy.problem(100)).statistics.first_pairs, 5U);
}

TEST(SearchOrder, EqualPairsGoByPriorityThenByTheNetwork) {
  Toy toy;
  for (const char* id : {"first", "second", "third"}) toy.task(id, 10, 10, {1}, true);
  toy[2].priority = 1;
  toy.close();
  EXPECT_THAT(toy.names(search::search(toy.problem(100), 3).plan), ElementsAre("third", "first", "second"));
}

TEST(SearchOrder, WhatCostsNothingGoesFirst) {
  Toy toy;
  toy.task("cheap", 10, 1, {9}, true);
  toy.task("free", 10, 0, {0.1}, true);
  toy.close();
  EXPECT_THAT(toy.names(search::search(toy.problem(100)).plan), ElementsAre("free", "cheap"));
}

TEST(SearchOrder, ThePlanCostsLessThanTheBudget) {
  Toy toy = three_tasks();
  EXPECT_THAT(toy.names(search::search(toy.problem(20)).plan), IsEmpty());
  EXPECT_THAT(toy.names(search::search(toy.problem(20.001)).plan), ElementsAre("b"));
}

TEST(SearchOrder, ExplorationIsBounded) {
  Toy toy = three_tasks();
  const Outcome one = search::search(toy.problem(101), 1);
  EXPECT_EQ(one.statistics.entries, 1U);
  EXPECT_FALSE(one.complete);
  EXPECT_THAT(toy.names(one.plan), ElementsAre("b"));
  int asked = 0;
  Problem stopped = toy.problem(101);
  stopped.stop = [&] { return ++asked > 2; };
  EXPECT_EQ(search::search(stopped).statistics.entries, 2U);
}

TEST(SearchOrder, OfEqualUtilitiesTheCheaperPlanIsBest) {
  Toy toy;
  toy.task("dear", 10, 30, {5});
  toy.task("cheap", 10, 20, {5});
  toy.close();
  EXPECT_THAT(toy.names(search::search(toy.problem(40)).plan), ElementsAre("cheap"));
}

TEST(SearchOrder, SumsThatAreEqualOnPaperAreEqual) {
  Toy toy;  // 0.1 + 0.2 against 0.3, of which the first is greater in binary
  toy.task("tenth", 5, 10, {0.1}, true);
  toy.task("fifth", 5, 10, {0.2}, true);
  toy.task("both", 10, 15, {0.3}, true);
  for (model::TaskIndex task = 0; task < 3; ++task) toy[task].closes = seconds(10);
  toy.close();
  EXPECT_THAT(toy.names(search::search(toy.problem(100)).plan), ElementsAre("both"));
}

TEST(SearchOrder, AHigherRankOutweighsAnySumOfLowerOnes) {
  Toy toy;
  toy.task("mission", 10, 90, {0.1});
  for (const char* id : {"x", "y", "z"}) toy.task(id, 10, 30, {0, 0.9, 1});
  toy.close();
  const Outcome found = search::search(toy.problem(100));
  EXPECT_THAT(toy.names(found.plan), ElementsAre("mission"));
  EXPECT_EQ(found.plan.utility, RankVector{0.1});
}

TEST(SearchOrder, AChainIsScheduledWholeOrNotAtAll) {
  Toy toy;
  const model::TaskIndex sample = toy.task("sample", 10, 10, {5}, true, true);
  const model::TaskIndex downlink = toy.task("downlink", 10, 10, {1}, false, true);
  toy[downlink].closes = seconds(15);
  toy.parent("sample_and_send", {{sample, downlink}});
  toy.task("other", 10, 10, {0.1}, true);
  toy.close();
  const auto kept = toy.timelines[0].kept().tasks;
  const Outcome found = search::search(toy.problem(100));
  EXPECT_THAT(toy.names(found.plan), ElementsAre("other"));
  EXPECT_EQ(found.plan.utility, (RankVector{0.1}));
  EXPECT_EQ(found.statistics.unplaced, 2U);
  EXPECT_EQ(toy.timelines[0].kept().tasks, kept);
}

TEST(SearchOrder, TheSameProblemGivesTheSamePlan) {
  Toy toy = three_tasks();
  const Outcome first = search::search(toy.problem(101));
  const Outcome second = search::search(toy.problem(101));
  EXPECT_EQ(first.plan, second.plan);
  EXPECT_EQ(first.statistics.entries, second.statistics.entries);
}

}  // namespace
