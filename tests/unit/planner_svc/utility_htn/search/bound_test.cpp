#include "planner_svc/utility_htn/search/bound.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "planner_svc/utility_htn/search/anytime.hpp"
#include "tests/unit/planner_svc/utility_htn/search/brute_force.hpp"

namespace {

namespace search = roci::planner::utility_htn::search;
namespace model = roci::planner::utility_htn::model;
using roci::temporal::ImpactKind, roci::temporal::ImpactWhen, roci::temporal::RankVector;
using roci::temporal::timelines::Phase;
using search::Progress, search::Toy;

TEST(UtilityBound, FillsTheBudgetByRatioWithOneWayOfEachRequest) {
  Toy toy;
  const model::TaskIndex raw = toy.task("raw", 10, 60, {6, 1}, false, true);
  const model::TaskIndex compressed = toy.task("compressed", 10, 20, {4, 1}, false, true);
  toy.parent("sample", {{raw}, {compressed}});
  toy.task("panorama", 10, 50, {1});
  toy.close();
  // compressed 4 for 20, then raw instead: 2 more for 40, then 40 of the panorama's 50.
  EXPECT_NEAR(search::utility_bound(toy.problem(100))[0], 4 + 2 + 0.8, 1e-6);
  EXPECT_NEAR(search::utility_bound(toy.problem(100))[1], 1, 1e-6);
}

TEST(UtilityBound, OpeningASiteIsPaidOnceByAllItsSamples) {
  Toy toy;
  const model::TaskIndex dig = toy.task("dig", 10, 80, {}, true, true);
  toy[dig].impacts.push_back({Toy::kPhase, ImpactKind::assign, ImpactWhen::at_end, {1, {}, 1}});
  toy.network.subway.sites.push_back({"site", {1, {}, 1}, {}});
  for (const char* name : {"0", "1", "2"}) {
    const model::TaskIndex collect = toy.task(std::string("collect_") + name, 10, 20, {1}, true, true);
    const model::TaskIndex sample = toy.parent(std::string("sample_") + name, {{dig, collect}, {collect}});
    toy[sample].decompositions[1].when = {{Toy::kPhase, Phase::pre, -INFINITY, INFINITY, 2}};
    toy.network.subway.sites[0].targets.push_back({sample, 0, {1, {}, 1}});
  }
  toy.close();
  search::Problem problem = toy.problem(130);
  EXPECT_NEAR(search::utility_bound(problem)[0], 3.0 * 130 / 140, 1e-6);  // 80 once, 20 each
  EXPECT_EQ(search::search(problem).plan.utility, RankVector{2});
  toy.now[Toy::kPhase] = 1;  // the site is open
  const search::Problem opened = toy.problem(50);
  EXPECT_NEAR(search::utility_bound(opened)[0], 2.5, 1e-6);
}

TEST(UtilityBound, ATaskThatOpensASiteForOthersIsPaidBeforeThem) {
  Toy toy;
  const model::TaskIndex dig = toy.task("dig", 10, 80, {}, true);
  toy[dig].impacts.push_back({Toy::kPhase, ImpactKind::assign, ImpactWhen::at_end, {1, {}, 1}});
  toy.network.subway.sites.push_back({"site", {1, {}, 1}, {}});
  for (const char* name : {"0", "1"}) {
    const model::TaskIndex collect = toy.task(std::string("collect_") + name, 10, 20, {1}, true);
    toy[collect].constraints = {{Toy::kPhase, Phase::pre, -INFINITY, INFINITY, 2}};
    toy.network.subway.sites[0].targets.push_back({collect, 0, {1, {}, 1}});
  }
  toy.close();
  EXPECT_NEAR(search::utility_bound(toy.problem(90))[0], 2.0 * 90 / 120, 1e-6);
  EXPECT_EQ(search::search(toy.problem(121)).plan.utility, RankVector{2});
}

TEST(Anytime, GetsBetterAndEndsWithTheBestAndItsGap) {
  int improvements = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    std::mt19937_64 random(seed);
    Toy toy;
    search::draw(random, toy, false);
    toy.close();
    const search::Problem problem = toy.problem(500);
    std::vector<Progress> all;
    const Progress last =
        search::search_anytime(problem, {1, 1'000'000}, [&](const Progress& now) { all.push_back(now); });
    ASSERT_FALSE(all.empty());
    for (std::size_t at = 1; at < all.size(); ++at) {
      EXPECT_GE(all[at].outcome.plan.utility, all[at - 1].outcome.plan.utility);
      EXPECT_GT(all[at].entries, all[at - 1].entries);
    }
    improvements += static_cast<int>(all.size()) - 1;
    EXPECT_TRUE(last.outcome.complete || last.gap == RankVector{});
    EXPECT_EQ(last.outcome.plan.utility, search::search(problem, 1'000'000).plan.utility) << seed;
    EXPECT_GE(last.gap, RankVector{});
    for (std::size_t rank = 0; rank < 3; ++rank)
      EXPECT_NEAR(last.gap[rank], last.bound[rank] - last.outcome.plan.utility[rank], 1e-8);
  }
  EXPECT_GT(improvements, 30);
}

TEST(Anytime, NoPassBeginsWhenTheEffortIsSpent) {
  std::mt19937_64 random(3);
  Toy toy;
  search::draw(random, toy, false);
  toy.close();
  EXPECT_EQ(search::search_anytime(toy.problem(500), {2, 2}).entries, 2U);
}

}  // namespace
