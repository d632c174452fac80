// The engine against brute force on random tasks, with every switch on and off; every plan is validated.
#include "tests/unit/planner_svc/temporal_pddl/brute_force.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/pddl/printer.hpp"
#include "tests/unit/planner_svc/temporal_pddl/random_task.hpp"
#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::Budget;
using call::Options;
using call::WindowExtraction;
using temporal::Duration;
using temporal::Verdict;

constexpr std::size_t kActions = 3;  // of the brute force plans

constexpr std::size_t kNeverMeasured = std::numeric_limits<std::size_t>::max();

struct Named {
  const char* name;
  Options options;
};

std::vector<Named> configurations() {
  std::vector<Named> result{{"default", {}}};
  result.push_back({"resources at once", {}});
  result.back().options.resource_patience = 0;
  result.push_back({"dead pairs at once", {}});
  result.back().options.pair_patience = 0;
  result.push_back({"no compression", {}});
  result.back().options.compression_safety = false;
  result.push_back({"no dominance", {}});
  result.back().options.dominance = false;
  result.push_back({"no preferred operators", {}});
  result.back().options.preferred_operators = false;
  result.push_back({"no landmarks", {}});
  result.back().options.landmarks = false;
  result.push_back({"no whole actions", {}});
  result.back().options.compress_all_actions = false;
  result.push_back({"no novelty", {}});
  result.back().options.novelty = false;
  result.push_back({"no lookahead", {}});
  result.back().options.lookahead = false;
  result.push_back({"no width", {}});
  result.back().options.best_first_width = false;
  result.push_back({"no serial search", {}});
  result.back().options.goal_serialization = false;
  result.push_back({"timed literals as steps", {}});
  result.back().options.windows = WindowExtraction::none;
  result.push_back({"one-off windows", {}});
  result.back().options.windows = WindowExtraction::one_off;
  result.push_back({"improved", {}});
  result.back().options.improvement_evaluations = 200;
  Options bare{
      Duration{1000},         false,          false,          false, false, false, false, false, false, false,
      WindowExtraction::none, kNeverMeasured, kNeverMeasured, 0,     17};
  result.push_back({"bare, shuffled", bare});
  return result;
}

std::string text(const testing::Model& model) {
  return pddl::print(model.domain) + pddl::print(model.problem);
}

class AgainstBruteForce : public ::testing::TestWithParam<int> {};

TEST_P(AgainstBruteForce, AgreesOnSolvability) {
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()));
  Budget budget;
  budget.evaluations = 1000;
  std::size_t solved = 0, unsolvable = 0, unknown = 0, missed = 0;
  for (int round = 0; round < 100; ++round) {
    const testing::Model model = testing::random_task(random);
    const bool expected = testing::has_plan(model, kActions);
    const std::size_t solved_before = solved, unsolvable_before = unsolvable;
    for (const auto& [name, options] : configurations()) {
      const Result result = testing::solved(model, options, budget);
      ASSERT_TRUE(result.verdict == Verdict::solved || result.verdict == Verdict::unsolvable ||
                  result.verdict == Verdict::timeout)
          << to_string(result.verdict) << " " << result.reason << text(model);
      if (result.plan) testing::expect_valid(model, result, options);
      if (HasFailure()) FAIL() << name << text(model);
      if (expected) {
        EXPECT_NE(result.verdict, Verdict::unsolvable) << name << ": " << result.reason << text(model);
      }
      missed += expected && result.verdict == Verdict::timeout;
      solved += result.verdict == Verdict::solved;
      unsolvable += result.verdict == Verdict::unsolvable;
      unknown += result.verdict == Verdict::timeout;
    }
    EXPECT_TRUE(solved == solved_before || unsolvable == unsolvable_before) << "contradictory" << text(model);
  }
  EXPECT_GT(solved, 80u);
  EXPECT_GT(unsolvable, 80u);
  EXPECT_LT(unknown, unsolvable / 2);
  EXPECT_LT(missed, solved / 4);
}

// Many small tasks: what resources are said not to suffice for has no plan.
TEST(AgainstBruteForce, ResourcesCutOffNoPlan) {
  std::mt19937_64 random(99);
  Budget budget;
  budget.evaluations = 200;
  Options with, without;
  with.resource_patience = 0;
  without.resource_patience = kNeverMeasured;
  std::size_t cut = 0, told = 0;
  for (int round = 0; round < 4000; ++round) {
    const testing::Model model = testing::random_task(random);
    with.compression_safety = round % 2 == 0;
    const Result result = testing::solved(model, with, budget);
    cut += result.statistics.dead_ends > 0;
    told += result.reason.starts_with("the goals take");
    if (result.statistics.dead_ends == 0 || result.verdict != Verdict::unsolvable) continue;
    EXPECT_NE(testing::solved(model, without, budget).verdict, Verdict::solved) << text(model);
    EXPECT_FALSE(testing::has_plan(model, kActions)) << result.reason << text(model);
  }
  EXPECT_GT(cut, 60u);
  EXPECT_GT(told, 20u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AgainstBruteForce, ::testing::Range(1, 9));

}  // namespace
}  // namespace roci::planner::temporal_pddl
