// The executive dies at every step of a whole mission, at every moment of the step, and comes back: the same
// goals end the same, the same images are taken as often, no command is carried out twice, and no plan is
// made that was not made before.
#include <gtest/gtest.h>

#include "tests/unit/exec_svc/crash_world.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::exec::testing {

using goals::GoalClass;
using goals::GoalRequest;
using goals::GoalState;
using mission::Replanning;

namespace {

// Three plans and more: a goal comes in flight, one is recalled, a command fails.
Flight mission(const CrashPlan& crash) {
  CrashWorld world(crash);
  GoalRequest recalled = photo("recalled");
  world.send(10, photo("first"));
  world.send(10, photo("second"));
  world.send(30, photo("late", GoalClass::optional, 1));
  world.send(100, recalled);
  recalled.recalled = true;
  world.send(110, recalled);
  world.break_shutter_once("second");
  return world.fly(1200);
}

void expect_nothing_doubled(const Flight& flight) {
  for (const auto& [key, count] : flight.carried_out) EXPECT_EQ(count, 1) << key.first << " " << key.second;
}

struct Case {
  Moment moment;
  bool compact = false;
  Replanning replanning = Replanning::stop_and_replan;
};

class CrashTest : public ::testing::TestWithParam<Case> {
 protected:
  static CrashPlan crash_at(std::set<std::size_t> turns, temporal::Duration away = {}) {
    return {std::move(turns), GetParam().moment, away, GetParam().compact, GetParam().replanning};
  }

  const Flight undisturbed = mission(crash_at({}));
};

TEST_P(CrashTest, AtEveryStepLosesNothing) {
  ASSERT_EQ(undisturbed.outcome, "achieved");
  ASSERT_GE(undisturbed.plan_version, 3U);
  for (std::size_t turn = 0; turn < undisturbed.turns; ++turn) {
    SCOPED_TRACE("turn " + std::to_string(turn));
    const Flight flight = mission(crash_at({turn}));
    EXPECT_EQ(flight.not_resumed, 0U);
    EXPECT_EQ(flight.goals, undisturbed.goals);
    EXPECT_EQ(flight.outcome, undisturbed.outcome);
    EXPECT_EQ(flight.images, undisturbed.images);
    EXPECT_EQ(flight.plan_version, undisturbed.plan_version);
    expect_nothing_doubled(flight);
    if (HasFailure()) return;
  }
}

// The robot ends what it does and nobody hears of it at once. A goal that comes and is taken back in that
// time was never there.
TEST_P(CrashTest, AtEveryStepAndAwayForAMinuteLosesNoGoal) {
  for (std::size_t turn = 0; turn < undisturbed.turns; ++turn) {
    SCOPED_TRACE("turn " + std::to_string(turn));
    Flight flight = mission(crash_at({turn}, temporal::seconds(61)));
    EXPECT_EQ(flight.not_resumed, 0U);
    if (flight.goals["recalled"] == GoalState::rejected) flight.goals["recalled"] = GoalState::recalled;
    EXPECT_EQ(flight.goals, undisturbed.goals);
    EXPECT_EQ(flight.outcome, undisturbed.outcome);
    expect_nothing_doubled(flight);
    if (HasFailure()) return;
  }
}

TEST_P(CrashTest, AgainAndAgainLosesNothing) {
  for (std::size_t every = 2; every < 9; ++every) {
    SCOPED_TRACE("every " + std::to_string(every));
    CrashPlan crash = crash_at({});
    for (std::size_t turn = every; turn < 500; turn += every) crash.turns.insert(turn);
    const Flight flight = mission(crash);
    EXPECT_EQ(flight.not_resumed, 0U);
    EXPECT_EQ(flight.goals, undisturbed.goals);
    EXPECT_EQ(flight.outcome, undisturbed.outcome);
    expect_nothing_doubled(flight);
  }
}

std::string name_of(const ::testing::TestParamInfo<Case>& test) {
  constexpr const char* names[] = {"before_write_ahead", "after_write_ahead", "during_send", "after_send"};
  return names[static_cast<int>(test.param.moment)] + std::string(test.param.compact ? "_compacted" : "") +
         (test.param.replanning == Replanning::background ? "_situated" : "");
}

INSTANTIATE_TEST_SUITE_P(Moments, CrashTest,
                         ::testing::Values(Case{Moment::before_write_ahead}, Case{Moment::after_write_ahead},
                                           Case{Moment::during_send}, Case{Moment::after_send},
                                           Case{Moment::after_write_ahead, true},
                                           Case{Moment::after_send, true},
                                           Case{Moment::before_write_ahead, false, Replanning::background},
                                           Case{Moment::after_write_ahead, true, Replanning::background},
                                           Case{Moment::after_send, false, Replanning::background}),
                         name_of);

}  // namespace
}  // namespace roci::exec::testing
