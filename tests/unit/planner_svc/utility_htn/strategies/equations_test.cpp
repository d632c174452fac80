// Golden numbers, worked out by hand.
#include "planner_svc/utility_htn/strategies/equations.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace roci::planner::utility_htn::strategies {
namespace {

// R106: 30 % of 0.1 is 0.03; 60 % of the other 0.07 is 0.042; 0.028 is left.
TEST(Equations, ProbabilitiesAreDerivedFromOneAndTwoShares) {
  const FailureProbabilities derived = split(0.1, 0.3, 0.6);
  EXPECT_DOUBLE_EQ(derived.fail, 0.1);
  EXPECT_NEAR(derived.flexible, 0.03, 1e-15);
  EXPECT_NEAR(derived.replanning, 0.042, 1e-15);
  EXPECT_NEAR(derived.ground, 0.028, 1e-15);
  // Z6: the three are all failures.
  EXPECT_DOUBLE_EQ(derived.flexible + derived.replanning + derived.ground, derived.fail);
  // Z5: given a failure, they are 0.3, 0.42 and 0.28.
  EXPECT_NEAR(given_failure(derived.flexible, derived), 0.3, 1e-15);
  EXPECT_NEAR(given_failure(derived.replanning, derived), 0.42, 1e-15);
  EXPECT_NEAR(given_failure(derived.ground, derived), 0.28, 1e-15);
  EXPECT_EQ(given_failure(0, split(0, 0.3, 0.6)), 0);
  EXPECT_THROW(split(1.1, 0.3, 0.6), std::invalid_argument);
  EXPECT_THROW(split(0.1, -0.3, 0.6), std::invalid_argument);
}

// Z16: (1 + 9) / (10 + 30) = 0.25, while 1/10 + 9/30 = 0.4 would promise 16 for a plan that holds 10.
TEST(Equations, UtilityPerCostIsAQuotientOfSums) {
  const std::vector<double> utilities{1, 9};
  const std::vector<double> costs{10, 30};
  EXPECT_DOUBLE_EQ(utility_per_cost(utilities, costs), 0.25);
  EXPECT_DOUBLE_EQ(utility_per_cost(utilities, costs) * 40, 10);
  EXPECT_THROW(utility_per_cost(utilities, std::vector<double>{0, 0}), std::invalid_argument);
  EXPECT_THROW(utility_per_cost(utilities, std::vector<double>{1}), std::invalid_argument);
}

// b = 1000, n = 100, c_avg = 10, u_avg = 0.2: without failures 200.
constexpr PlanFigures kPlan{.budget = 1000, .tasks = 100, .utility_per_cost = 0.2, .cost_per_task = 10};

// R103: (1 - 0.1) / 0.1 = 9 tasks, each worth 0.2 · 10 = 2.
TEST(Equations, StaticEndsAfterNineTasks) {
  EXPECT_DOUBLE_EQ(successes_before_failure(0.1), 9);
  EXPECT_DOUBLE_EQ(static_utility(kPlan, split(0.1, 0.3, 0.6)), 18);
  // With P = 0.001 999 tasks would succeed, but the plan is worth 200 at most.
  EXPECT_DOUBLE_EQ(static_utility(kPlan, split(0.001, 0.3, 0.6)), 200);
  EXPECT_DOUBLE_EQ(static_utility(kPlan, split(0, 0.3, 0.6)), 200);
  EXPECT_DOUBLE_EQ(static_utility(kPlan, split(1, 0.3, 0.6)), 0);
}

// R104: 0.2 · (1000 - 0.1 · 100 · 20) = 160 and 0.2 · (1000 - 0.07 · 100 · 20) = 172.
TEST(Equations, GroundAndFlexibleExecution) {
  const FailureProbabilities derived = split(0.1, 0.3, 0.6);
  EXPECT_NEAR(ground_utility(kPlan, derived, {.ground = 20, .replanning = 5}), 160, 1e-9);
  EXPECT_NEAR(flexible_utility(kPlan, derived, {.ground = 20, .replanning = 5}), 172, 1e-9);
}

// R105: 3 · 4 + 0.2 · (1000 - 100 · (0.028 · 20 + 0.042 · 5)) = 12 + 0.2 · (1000 - 77) = 196.6.
TEST(Equations, ReplanningUsesDiscoveries) {
  const FailureProbabilities derived = split(0.1, 0.3, 0.6);
  EXPECT_NEAR(
      replanning_utility(kPlan, derived, {.ground = 20, .replanning = 5}, {.count = 3, .utility_each = 4}),
      196.6, 1e-9);
  EXPECT_NEAR(replanning_utility(kPlan, derived, {.ground = 20, .replanning = 5}, {}), 184.6, 1e-9);
  EXPECT_DOUBLE_EQ(most_discoveries(1000, 250), 4);
  EXPECT_THROW(most_discoveries(1000, 0), std::invalid_argument);
}

TEST(Equations, EachMechanismHelpsWhileItIsCheaper) {
  const FailureProbabilities derived = split(0.1, 0.3, 0.6);
  for (const double ground : {1.0, 5.0, 20.0, 60.0}) {
    const RecoveryCosts costs{.ground = ground, .replanning = ground / 4};
    EXPECT_LT(static_utility(kPlan, derived), ground_utility(kPlan, derived, costs));
    EXPECT_LT(ground_utility(kPlan, derived, costs), flexible_utility(kPlan, derived, costs));
    EXPECT_LT(flexible_utility(kPlan, derived, costs), replanning_utility(kPlan, derived, costs, {}));
  }
}

TEST(Equations, CurvesOverEnergyEndAtTheWholePlan) {
  const FailureProbabilities derived = split(0.1, 0.3, 0.6);
  const RecoveryCosts costs{.ground = 20, .replanning = 5};
  EXPECT_NEAR(ground_utility(until_spent(kPlan, 500), derived, costs), 80, 1e-9);
  EXPECT_NEAR(ground_utility(until_spent(kPlan, 2000), derived, costs), 160, 1e-9);
  EXPECT_DOUBLE_EQ(ground_utility(until_spent(kPlan, -1), derived, costs), 0);
}

}  // namespace
}  // namespace roci::planner::utility_htn::strategies
