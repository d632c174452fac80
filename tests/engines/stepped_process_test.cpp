// The engine that plans all the time, as a process beside an executive: a mission without PDDL, site or arm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engines/lock_executive.hpp"
#include "tests/engines/planner_process.hpp"

namespace roci::planner::proof {
namespace {

using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Stepped : public ::testing::TestWithParam<Pairing> {
 protected:
  PlannerProcess run{"chain", GetParam().own, GetParam().planner};
  LockExecutive executive{run.node()};
};

TEST_P(Stepped, AGoalIsPlannedCommittedPieceByPieceAndAchieved) {
  executive.ask_at(10s, "lift", "a");
  run.run_until(1000s);
  ASSERT_FALSE(executive.planned.empty());
  EXPECT_EQ(executive.planned.front(), "open-lower, enter-below, shut-lower, fill, open-upper, leave-above");
  EXPECT_THAT(executive.done,
              ElementsAre("open-lower", "enter-below", "shut-lower", "fill", "open-upper", "leave-above"));
  EXPECT_THAT(executive.achieved, ElementsAre("a"));
  EXPECT_EQ(executive.versions.size(), 7U) << "the plan, and one commitment for each activity";
  EXPECT_THAT(executive.faults, IsEmpty());
  EXPECT_THAT(run.events, IsEmpty());
}

TEST_P(Stepped, AnotherStateGivesAnotherPlan) {
  executive.observe_at(5s, "ship", temporal::state("inside"));
  executive.observe_at(5s, "level", temporal::state("high"));
  executive.ask_at(10s, "lift", "a");
  run.run_until(1000s);
  EXPECT_THAT(executive.done, ElementsAre("open-upper", "leave-above"));
}

TEST_P(Stepped, AGoalThatComesLaterIsPlannedBehindTheFirst) {
  executive.ask_at(10s, "lift", "a");
  executive.ask_at(200s, "lower", "b");
  run.run_until(2000s);
  EXPECT_THAT(executive.done,
              ElementsAre("open-lower", "enter-below", "shut-lower", "fill", "open-upper", "leave-above",
                          "enter-above", "shut-upper", "drain", "open-lower", "leave-below"));
  EXPECT_THAT(executive.achieved, Contains("a"));
  EXPECT_THAT(executive.achieved, Contains("b"));
  EXPECT_THAT(executive.faults, IsEmpty());
}

TEST_P(Stepped, AnImpossibleGoalIsToldWithWhatBlocksItAndTheOthersArePlanned) {
  executive.ask_at(10s, "flood", "quay");
  executive.ask_at(20s, "lift", "a");
  run.run_until(1000s);
  EXPECT_THAT(run.events,
              ElementsAre("planner.blocked: goal ground/quay cannot be planned: quay: no task makes it wet"));
  EXPECT_THAT(executive.achieved, ElementsAre("a"));
}

TEST_P(Stepped, AGoalThatIsRecalledTakesWhatIsNotCommittedWithIt) {
  executive.ask_at(10s, "lift", "a");
  executive.recall_at(60s, "a");  // while the ship enters or the gate opens
  run.run_until(1000s);
  EXPECT_LT(executive.done.size(), 4U);
  EXPECT_EQ(executive.planned.back(), executive.planned.back().substr(0, executive.planned.back().find(',')))
      << "no more than what was committed is left";
  EXPECT_THAT(executive.faults, IsEmpty());
}

TEST_P(Stepped, AFailureIsPlannedAroundFromWhatIsObserved) {
  executive.fail_first("fill");
  executive.ask_at(10s, "lift", "a");
  run.run_until(3000s);
  EXPECT_THAT(executive.done, ElementsAre("open-lower", "enter-below", "shut-lower", "fill!", "fill",
                                          "open-upper", "leave-above"));
  EXPECT_THAT(executive.achieved, ElementsAre("a"));
  EXPECT_THAT(executive.faults, IsEmpty());
}

// While the chamber fills. Its memory is gone; what it committed goes on, and nothing is done twice.
TEST_P(Stepped, KilledWhileItsPlanRunsItGoesOnWithIt) {
  executive.ask_at(10s, "lift", "a");
  run.node().at(200s, [&] { run.kill_and_restart(); });
  executive.ask_at(210s, "lower", "b");
  run.run_until(3000s);
  EXPECT_THAT(executive.done,
              ElementsAre("open-lower", "enter-below", "shut-lower", "fill", "open-upper", "leave-above",
                          "enter-above", "shut-upper", "drain", "open-lower", "leave-below"));
  EXPECT_THAT(executive.achieved, ElementsAre("a", "b"));
  EXPECT_THAT(executive.faults, IsEmpty());
  EXPECT_THAT(run.events, Not(Contains(HasSubstr("planner.defect"))));
}

INSTANTIATE_TEST_SUITE_P(Transports, Stepped, ::testing::ValuesIn(kPairings),
                         [](const auto& pairing) { return pairing.param.name; });

}  // namespace
}  // namespace roci::planner::proof
