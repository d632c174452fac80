#include "tests/unit/planner_svc/utility_htn/search/brute_force.hpp"

#include <gtest/gtest.h>

#include "planner_svc/utility_htn/assessor/subway_assessor.hpp"
#include "planner_svc/utility_htn/search/bound.hpp"

namespace {

namespace search = roci::planner::utility_htn::search;
using roci::planner::utility_htn::assessor::SubwayAssessor;
using search::Outcome, search::Plan, search::Problem, search::Toy;

constexpr std::uint64_t kUnbounded = 1'000'000'000;

void compare(const Problem& problem, std::uint64_t seed, std::uint64_t& planned) {
  std::vector<double> most;
  const Plan expected = search::best_by_brute_force(problem, most);
  const Outcome found = search::search(problem, kUnbounded);
  ASSERT_TRUE(found.complete) << seed;
  EXPECT_EQ(found.plan.utility, expected.utility)
      << seed << ": " << to_text(found.plan.utility) << " instead of " << to_text(expected.utility);
  EXPECT_NEAR(found.plan.cost, expected.cost, 1e-6) << seed;
  const auto bound = search::utility_bound(problem);
  for (std::size_t rank = 0; rank < most.size(); ++rank)
    EXPECT_GE(bound[rank], most[rank]) << seed << " " << rank;
  planned += found.plan.placed.size();
}

TEST(AgainstBruteForce, TheSearchWithoutABoundFindsTheBestPlanAndNoPlanExceedsTheBound) {
  std::uint64_t planned = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    std::mt19937_64 random(seed);
    Toy toy;
    search::draw(random, toy, false);
    toy.close();
    compare(toy.problem(100.0 + 100.0 * static_cast<double>(random() % 7)), seed, planned);
    if (HasFailure()) return;
  }
  EXPECT_GT(planned, 300U);
}

TEST(AgainstBruteForce, SoItDoesWhereTheWorthOfASampleDependsOnThePlan) {
  std::uint64_t planned = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    std::mt19937_64 random(seed);
    Toy toy;
    search::draw(random, toy, true);
    toy.close();
    Problem problem = toy.problem(200.0 + 100.0 * static_cast<double>(random() % 7));
    const SubwayAssessor assessor(toy.network, toy.chains);
    Problem by_map{problem.network, problem.values,    problem.chains,
                   assessor,        problem.scheduler, problem.anchored};
    by_map.until = problem.until;
    by_map.budget = problem.budget;
    by_map.timelines_now = toy.now;
    compare(by_map, seed, planned);
    compare(problem, seed, planned);
    if (HasFailure()) return;
  }
  EXPECT_GT(planned, 100U);
}

}  // namespace
