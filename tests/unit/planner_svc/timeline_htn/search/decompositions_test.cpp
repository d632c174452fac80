// What complex states can be made of: landmarks against leaving each state out,
// and estimates that do not depend on where they came from.
#include "planner_svc/timeline_htn/search/decompositions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "bench/timeline_htn/team_traverse.hpp"
#include "tests/unit/planner_svc/timeline_htn/search/plans.hpp"

namespace roci::planner::timeline_htn::search {
namespace {

model::Model team(int waypoints, int chords, int goals = 2) {
  return model_of({bench::timeline_htn::text_of(
      {.waypoints = waypoints, .rovers = 2, .goals = goals, .chords = chords})});
}

// A state is a landmark exactly where the one above cannot be made up without it.
TEST(Decompositions, LandmarksAreTheStatesWithoutWhichThereIsNoWay) {
  for (const int chords : {0, 1, 2}) {
    const model::Model model = team(7, chords);
    Ground ground(model);
    Bindings bindings;
    const Successors successors(ground, bindings, Order::first_declared);
    Decompositions& below = successors.below();
    const StateId root = ground.find(ground_of(model.problem->goals[0].state, {}));
    ASSERT_TRUE(below.derivable(root));
    const std::vector<StateId> landmarks = below.landmarks(root);
    EXPECT_TRUE(std::ranges::is_sorted(landmarks));
    std::size_t needed = 0, complex = 0;
    const auto all_of = [&](model::Index component, model::Index state) {
      for (model::Index a = 0; a < 7; ++a)
        for (model::Index b = 0; b < 7; ++b) {
          const StateId one = ground.find({component, state, {a, b}});
          if (one == kNone) continue;
          ++complex;
          const bool is_landmark = std::ranges::binary_search(landmarks, one);
          EXPECT_EQ(is_landmark, !below.derivable_without(root, {one})) << ground.text(one);
          needed += is_landmark ? 1 : 0;
        }
    };
    for (model::Index c = 0; c < model.components.size(); ++c)
      for (model::Index s = 0; s < model.components[c].states.size(); ++s)
        if (model.components[c].states[s].kind == model::StateKind::complex &&
            model.components[c].states[s].parameters.size() == 2)
          all_of(c, s);
    EXPECT_GT(complex, 100U);
    EXPECT_GT(needed, chords == 0 ? 10U : 1U);
  }
}

// Without chords the only way is along the line: cycles of nine steps and one more for the route and the
// cycle, below one traverse.
TEST(Decompositions, ValuesGrowWithTheWay) {
  std::vector<std::uint32_t> values;
  for (const int waypoints : {3, 5, 9}) {
    const model::Model model = team(waypoints, 0);
    Ground ground(model);
    Bindings bindings;
    const Successors successors(ground, bindings, Order::first_declared);
    values.push_back(successors.below().values(ground.find(ground_of(model.problem->goals[0].state, {}))));
  }
  EXPECT_EQ(values[2] - values[1], 2 * (values[1] - values[0])) << "so much for each way-point";
  EXPECT_GT(values[1], values[0]);
  EXPECT_GT(values[0], 2U);
}

// The estimate of a plan is the same whether it was come to step by step or by a jump from elsewhere.
TEST(Decompositions, AnEstimateDoesNotDependOnThePlanBefore) {
  const model::Model model = team(7, 1, 4);
  for (const Heuristic heuristic : {Heuristic::relaxed_plan, Heuristic::landmarks}) {
    Ground ground(model);
    Bindings bindings;
    Successors successors(ground, bindings, Order::first_declared);
    PartialPlan plan(ground, bindings, goal_order(*model.problem));
    const auto running = make_estimate(heuristic, ground, successors);
    const PartialPlan::Mark root = plan.mark();
    std::set<std::uint32_t> met;
    for (int round = 0; round < 3; ++round) {
      for (int depth = 0; depth < 30 + 20 * round; ++depth) {
        std::vector<Step> steps;
        successors.of(plan, steps);
        if (steps.empty()) break;
        ASSERT_TRUE(plan.take(steps.front()));
        const std::uint32_t estimate = running->of(plan);
        EXPECT_EQ(estimate, make_estimate(heuristic, ground, successors)->of(plan));
        met.insert(estimate);
      }
      plan.take_back(root);
    }
    EXPECT_GT(met.size(), 5U);
  }
}

}  // namespace
}  // namespace roci::planner::timeline_htn::search
