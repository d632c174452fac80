// Several resolvers on threads (R132): the plan is the same for any number of them.
#include "planner_svc/timeline_htn/search/resolvers.hpp"

#include <gtest/gtest.h>

#include "bench/timeline_htn/team_traverse.hpp"
#include "tests/unit/planner_svc/timeline_htn/search/plans.hpp"

namespace roci::planner::timeline_htn {
namespace {

using search::Heuristic, search::Order, search::Outcome, search::Resolver;

const std::vector<Resolver> kAll{{Heuristic::blind, Order::first_declared},
                                 {Heuristic::blind, Order::last_declared},
                                 {Heuristic::relaxed_plan, Order::first_declared},
                                 {Heuristic::landmarks, Order::first_declared}};

TEST(Resolvers, AreKnownByTheirNames) {
  EXPECT_EQ(search::resolver_named("landmarks"), (Resolver{Heuristic::landmarks, Order::first_declared}));
  EXPECT_EQ(search::resolver_named("blind_last"), (Resolver{Heuristic::blind, Order::last_declared}));
  EXPECT_FALSE(search::resolver_named("last"));
  for (const std::string& name : search::resolver_names()) EXPECT_TRUE(search::resolver_named(name)) << name;
}

TEST(Resolvers, GiveTheSamePlanOnAnyNumberOfThreads) {
  const model::Model model =
      model_of({bench::timeline_htn::text_of({.waypoints = 9, .goals = 3, .chords = 1})});
  std::optional<temporal::FlexiblePlan> first;
  std::uint64_t evaluated = 0;
  for (std::size_t threads = 1; threads <= 4; ++threads) {
    const auto result = search::resolve(model, kAll, threads, 400'000, 0, [] { return false; });
    ASSERT_EQ(result.outcome, Outcome::solved);
    const auto plan = extraction::plan_of(*result.search, {"plan", "a", temporal::Time{0}});
    if (!first) {
      first = plan;
      evaluated = result.evaluated;
    }
    EXPECT_EQ(plan, *first) << threads;
    EXPECT_EQ(result.evaluated, evaluated) << threads;
  }
}

TEST(Resolvers, TheOneWithTheFewestExpansionsWins) {
  const model::Model model =
      model_of({bench::timeline_htn::text_of({.waypoints = 9, .goals = 3, .chords = 1})});
  const auto result = search::resolve(model, kAll, 2, 400'000, 0, [] { return false; });
  ASSERT_EQ(result.outcome, Outcome::solved);
  for (std::size_t i = 0; i < kAll.size(); ++i) {
    search::Search alone(model, kAll[i]);
    if (alone.run(1000, 0, [] { return false; }) != Outcome::solved) continue;
    EXPECT_GE(alone.count().expanded, result.search->count().expanded) << i;
  }
}

TEST(Resolvers, OneThatHasExhaustedTheProblemEndsAll) {
  const model::Model model = model_of(
      {with(bench::timeline_htn::text_of({.waypoints = 3, .goals = 1}), "horizon_s: 6000", "horizon_s: 8")});
  const auto result = search::resolve(model, kAll, 2, 400'000, 0, [] { return false; });
  EXPECT_EQ(result.outcome, Outcome::exhausted);
  EXPECT_NE(result.search->reason().find("time"), std::string::npos);
}

}  // namespace
}  // namespace roci::planner::timeline_htn
