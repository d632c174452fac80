// The search against brute force on small random problems (Z22): every plan that it finds is one,
// and where there is one it finds one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "planner_svc/timeline_htn/checking/check.hpp"
#include "planner_svc/timeline_htn/search/resolvers.hpp"
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

/// Counts what came of random problems.
struct Tally {
  int solvable = 0, unsolvable = 0, undecided = 0;
  int unfit = 0;  ///< contradict themselves, which is told before
};

void compare(std::uint64_t seed, const RandomProblem& problem, Tally& tally,
             const std::string& resolver = "blind") {
  SCOPED_TRACE(resolver);
  const std::string text = RandomProblem(problem).text();
  mission::Findings findings;
  const auto model = reading::parse_model({{"random", text}}, findings);
  if (!model) {
    ++tally.unfit;
    return;
  }
  const Planned result = planned(*model, resolver_named(resolver).value(), 20'000);
  if (result.outcome == Outcome::solved) {
    ++tally.solvable;
    ASSERT_TRUE(Oracle(*model, 20).allows(sequences_of(*model, *result.plan))) << "seed " << seed << "\n"
                                                                               << text;
    ASSERT_THAT(checking::faults(*model, *result.plan), testing::IsEmpty()) << "seed " << seed << "\n"
                                                                            << text;
  } else {
    ++(result.outcome == Outcome::exhausted ? tally.unsolvable : tally.undecided);
    ASSERT_FALSE(Oracle(*model, 5).solvable()) << "seed " << seed << "\n" << text << result.reason;
  }
}

TEST(TimelineSearchAgainstBruteForce, FindsAPlanWhereThereIsOneAndNoneWhereThereIsNone) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 400 && !HasFatalFailure(); ++seed)
    compare(seed, RandomProblem(seed), tally);
  EXPECT_GT(tally.solvable, 80);
  EXPECT_GT(tally.unsolvable, 40);
  EXPECT_LT(tally.undecided, 40);  // in so many steps, where time is tight
  EXPECT_LT(tally.unfit, 200);
}

// What a heuristic takes to be impossible, or leaves for later, hides no plan.
TEST(TimelineSearchAgainstBruteForce, EveryHeuristicAndOrderFindsAPlanWhereThereIsOne) {
  for (const std::string& resolver : resolver_names()) {
    Tally tally;
    for (std::uint64_t seed = 0; seed < 50 && !HasFatalFailure(); ++seed) {
      compare(seed, RandomProblem(seed), tally, resolver);
      compare(seed, RandomProblem::with_windows(seed), tally, resolver);
      compare(seed, RandomProblem::with_late_goals(seed), tally, resolver);
    }
    EXPECT_GT(tally.solvable, 60) << resolver;
    EXPECT_GT(tally.unsolvable, 20) << resolver;
    EXPECT_LT(tally.undecided, 30) << resolver;
  }
}

// What is predicted of a timeline stands at its times, and needs and conditions find it there or not at all.
TEST(TimelineSearchAgainstBruteForce, PlansWithWhatIsPredicted) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 400 && !HasFatalFailure(); ++seed)
    compare(seed, RandomProblem::with_windows(seed), tally);
  EXPECT_GT(tally.solvable, 60);
  EXPECT_GT(tally.unsolvable, 60);
  EXPECT_LT(tally.undecided, 40);
}

// One goal waits for another, which ends just as the default state does that the first one wants: that one is met by a
// state which is over.
TEST(TimelineSearchAgainstBruteForce, AGoalMayBeMetByADefaultStateThatEndsAsWhatItWaitsForDoes) {
  Tally tally;
  compare(1480, RandomProblem::with_windows(1480), tally);
  EXPECT_EQ(tally.solvable, 1);
}

// What is placed later may have to find a wanted state ended, or another one in between: the timeline leaves that state,
// also one that it passes on its way, and comes back to it.
TEST(TimelineSearchAgainstBruteForce, ATimelineMayLeaveWhatIsWantedAndComeBackToIt) {
  Tally tally;
  for (const std::uint64_t seed : {6689, 7787, 8791, 8910}) compare(seed, RandomProblem(seed), tally);
  for (const std::uint64_t seed : {4646, 7489, 10172})
    compare(seed, RandomProblem::with_windows(seed), tally);
  for (const std::uint64_t seed : {5411, 7278, 8163, 10059, 13032, 13193})
    compare(seed, RandomProblem::with_late_goals(seed), tally);
  EXPECT_EQ(tally.solvable, 13);
}

// A detour or the parts of another goal take a timeline so far that a goal on it which is still open comes too late.
// Whatever is tried behind that is in vain: it took 234,541 steps.
TEST(TimelineSearchAgainstBruteForce, NothingIsTriedBehindWhatIsTooLateForAGoal) {
  Tally tally;
  compare(7189, RandomProblem(7189), tally);
  EXPECT_EQ(tally.solvable, 1);
}

// On its way to rest one timeline needs a state that another one can be in only before it rests, or on a longer way.
TEST(TimelineSearchAgainstBruteForce, TimelinesGoToRestInAnyOrderAndByAnyWay) {
  Tally tally;
  compare(598, RandomProblem(598), tally);
  compare(10201, RandomProblem::with_late_goals(10201), tally);
  EXPECT_EQ(tally.solvable, 2);
}

// A goal waits for another, and so do its parts: one of them is met by a default state that ended just as that one did.
TEST(TimelineSearchAgainstBruteForce, APartMayBeMetByADefaultStateThatEndsAsWhatItsGoalWaitsForDoes) {
  Tally tally;
  compare(11487, RandomProblem::with_windows(11487), tally);
  EXPECT_EQ(tally.solvable, 1);
}

// A default state may be brought about before the window of its goal opens, and must last until then, or come again.
TEST(TimelineSearchAgainstBruteForce, BringsAboutBeforeTheWindowWhatRestsInIt) {
  Tally tally;
  for (std::uint64_t seed = 1000; seed < 1400 && !HasFatalFailure(); ++seed)
    compare(seed, RandomProblem::with_late_goals(seed), tally);
  EXPECT_GT(tally.solvable, 80);
  EXPECT_GT(tally.unsolvable, 20);
  EXPECT_LT(tally.undecided, 40);
}

}  // namespace
}  // namespace roci::planner::timeline_htn::search
