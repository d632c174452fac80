// The search against brute force on small random problems (Z22): every plan that it finds is one, and where there is one it finds one.
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/planner_svc/timeline_htn/search/oracle.hpp"
#include "tests/unit/planner_svc/timeline_htn/search/plans.hpp"
#include "tests/unit/planner_svc/timeline_htn/search/random_problem.hpp"

namespace roci::planner::timeline_htn::search {
namespace {

std::vector<Sequence> sequences_of(const model::Model& model, const temporal::FlexiblePlan& plan) {
  std::vector<Sequence> out(model.components.size());
  for (const temporal::Token& token : plan.tokens)
    for (std::size_t c = 0; c < model.components.size(); ++c)
      if (model.components[c].name == token.timeline)
        for (model::Index s = 0; s < model.components[c].states.size(); ++s)
          if (model.components[c].states[s].name == std::get<temporal::State>(token.held).name)
            out[c].push_back(s);
  return out;
}

TEST(TimelineSearchAgainstBruteForce, FindsAPlanWhereThereIsOneAndNoneWhereThereIsNone) {
  int solvable = 0, unsolvable = 0, undecided = 0, unfit = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const std::string text = RandomProblem(seed).text();
    mission::Findings findings;
    const auto model = reading::parse_model({{"random", text}}, findings);
    if (!model) {  // it contradicts itself, which is told before
      ++unfit;
      continue;
    }
    const Planned result = planned(*model, {}, 20'000);
    if (result.outcome == Outcome::solved) {
      ++solvable;
      ASSERT_TRUE(Oracle(*model, 20).allows(sequences_of(*model, *result.plan))) << "seed " << seed << "\n"
                                                                                 << text;
    } else {
      ++(result.outcome == Outcome::exhausted ? unsolvable : undecided);
      ASSERT_FALSE(Oracle(*model, 5).solvable()) << "seed " << seed << "\n" << text << result.reason;
    }
  }
  EXPECT_GT(solvable, 80);
  EXPECT_GT(unsolvable, 40);
  EXPECT_LT(undecided, 40);  // in so many steps, where time is tight
  EXPECT_LT(unfit, 200);
}

}  // namespace
}  // namespace roci::planner::timeline_htn::search
