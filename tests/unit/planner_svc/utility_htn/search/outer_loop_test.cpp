#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/planner_svc/utility_htn/search/brute_force.hpp"

namespace {

namespace search = roci::planner::utility_htn::search;
namespace model = roci::planner::utility_htn::model;
using roci::temporal::seconds;
using search::Outcome, search::Placed, search::Problem, search::Toy;
using testing::Contains, testing::ElementsAre;

Toy with_uplinks() {
  Toy toy;
  toy.network.batches = {"first", "second"};
  toy[toy.task("early", 30, 10, {0, 0.1}, true)].batch = 0;
  toy[toy.task("late", 30, 10, {0, 0.9}, true)].batch = 1;
  for (const char* id : {"uplink_1", "uplink_2"}) toy[toy.task(id, 10, 1, {}, true)].fixed = true;
  toy[2].preferred_start = seconds(50);
  toy[3].preferred_start = seconds(20);
  return toy;
}

TEST(OuterLoop, FixedUplinksComeFirstThenBatchByBatch) {
  Toy toy = with_uplinks();
  toy.close();
  const Outcome found = search::search(toy.problem(100));
  EXPECT_THAT(toy.names(found.plan), ElementsAre("uplink_2", "uplink_1", "early", "late"));
  EXPECT_EQ(toy.start(found.plan, "uplink_2"), seconds(20));
  EXPECT_EQ(toy.start(found.plan, "uplink_1"), seconds(50));
  EXPECT_EQ(toy.start(found.plan, "early"), seconds(60));
  EXPECT_EQ(toy.start(found.plan, "late"), seconds(90));
  EXPECT_EQ(toy.timelines[0].kept().tasks, 0U);
}

TEST(OuterLoop, FixedTasksThatFindNoPlaceAtTheirTimeAreNamed) {
  Toy toy = with_uplinks();
  toy[2].preferred_start = seconds(25);
  toy.close();
  const Outcome found = search::search(toy.problem(100));
  EXPECT_THAT(found.missed, ElementsAre(toy.chain("uplink_1")));
  EXPECT_EQ(toy.start(found.plan, "uplink_2"), seconds(20));
}

TEST(OuterLoop, WhatIsCommittedStaysAndItsRequestIsNotPlannedAgain) {
  Toy toy = with_uplinks();
  toy.close();
  Problem problem = toy.problem(100);
  const std::uint32_t late = toy.chain("late");
  problem.committed = {{late, {seconds(70)}}};
  problem.closed = {toy.chains.chains[toy.chain("uplink_1")].task};
  problem.from = seconds(40);
  toy.timelines[0].place(search::task_id(late, 0), model::footprint(toy[1], toy.values), seconds(70));
  const Outcome found = search::search(problem);
  EXPECT_THAT(toy.names(found.plan), ElementsAre("early"));
  EXPECT_EQ(toy.start(found.plan, "early"), seconds(40));
  EXPECT_THAT(found.missed, ElementsAre(toy.chain("uplink_2")));
}

// The second batch is planned with the first one's plan as it was without it.
TEST(OuterLoop, NoLaterBatchMovesAnEarlierOne) {
  std::size_t held = 0, added = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    std::mt19937_64 random(seed);
    Toy toy;
    search::draw(random, toy, false);
    toy.network.batches = {"first", "second", "third"};
    std::vector<model::TaskIndex> later;
    for (model::TaskIndex task = 0; task < toy.network.tasks.size(); ++task) {
      if (toy[task].is_template) continue;
      toy[task].batch = static_cast<std::uint32_t>(random() % 3);
      if (toy[task].batch > 0) later.push_back(task);
    }
    toy.close();
    Problem problem = toy.problem(500);
    const Outcome whole = search::search(problem);
    problem.closed = later;
    const Outcome first = search::search(problem);
    for (const Placed& placed : first.plan.placed) ASSERT_THAT(whole.plan.placed, Contains(placed)) << seed;
    held += first.plan.placed.size();
    added += whole.plan.placed.size() - first.plan.placed.size();
  }
  EXPECT_GT(held, 50U);
  EXPECT_GT(added, 50U);
}

}  // namespace
