// Offset and drift of a clock, for random delays and drifts; and who is told when they are too large.
#include "services/clock/clock_offset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace roci::services::clock {
namespace {

using namespace std::chrono_literals;
using temporal::Duration;
using temporal::Time;
using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

// A host's clock beside the mission clock, and a network with random delays between them.
struct Host {
  double offset_us = 0;
  double drift_ppm = 0;

  double offset_at(double mission_us) const { return offset_us + drift_ppm * 1e-6 * mission_us; }
  Time own(double mission_us) const { return Time(std::llround(mission_us + offset_at(mission_us))); }

  // A question at this mission time; it ends `there` + `back` later.
  ClockExchange ask(double at_us, double there_us, double back_us, double handling_us = 50) const {
    const double received = at_us + there_us;
    const double answered = received + handling_us;
    return {own(at_us), Time(std::llround(received)), Time(std::llround(answered)), own(answered + back_us)};
  }
};

TEST(OffsetEstimator, KnowsNothingBeforeTheFirstAnswer) {
  EXPECT_FALSE(OffsetEstimator().estimate().has_value());
}

TEST(OffsetEstimator, OneExchangeGivesTheOffsetWithinHalfOfItsDelay) {
  OffsetEstimator estimator;
  estimator.add({10s, 7010ms, 7020ms, 10050ms});  // 3 s ahead; 20 ms there, 20 ms back
  const ClockOffset found = *estimator.estimate();
  EXPECT_EQ(found.offset, 3010ms);
  EXPECT_GE(found.error, 20ms);
  EXPECT_LE(found.error, 21ms);
  EXPECT_TRUE(std::isinf(found.drift_error_ppm));
}

TEST(OffsetEstimator, TheExchangeWithTheLeastDelayCounts) {
  const Host host{1e6, 0};
  OffsetEstimator estimator;
  estimator.add(host.ask(0, 200, 200));
  for (int i = 1; i < 8; ++i) estimator.add(host.ask(i * 1e5, 90'000, 100));
  EXPECT_NEAR(static_cast<double>(estimator.estimate()->offset.count()), 1e6, 5);
}

TEST(OffsetEstimator, TheTrueFiguresLieWithinTheErrorsForAnyDelays) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> offset(-4e9, 4e9), drift(-400, 400), period(5e4, 2e6);
  for (int round = 0; round < 100; ++round) {
    const Host host{offset(random), drift(random)};
    const double every = period(random);
    std::exponential_distribution<double> delay(1.0 / (100 + round * 200));
    OffsetEstimator estimator;
    double at = 1e6;
    for (int i = 0; i < 600; ++i, at += every) {
      const double there = 20 + delay(random), back = 20 + delay(random);
      const ClockExchange exchange = host.ask(at, there, back);
      estimator.add(exchange);
      const ClockOffset found = *estimator.estimate();
      const double truth = host.offset_at(at);
      ASSERT_LE(std::abs(static_cast<double>(found.offset.count()) - truth),
                static_cast<double>(found.error.count()) + 1e-3 * (there + back) + 3)
          << "round " << round << " exchange " << i;
      if (std::isinf(found.drift_error_ppm)) continue;
      ASSERT_LE(std::abs(found.drift_ppm - host.drift_ppm), found.drift_error_ppm + 0.5)
          << "round " << round << " exchange " << i;
    }
    EXPECT_LT(estimator.estimate()->drift_error_ppm, 1e6 * 6 * (200 + round * 400) / (500 * every));
  }
}

TEST(OffsetEstimator, AClockThatIsSetIsFollowedAtOnce) {
  Host host{2e6, 50};
  OffsetEstimator estimator;
  for (int i = 0; i < 100; ++i) estimator.add(host.ask(i * 1e5, 300, 300));
  host.offset_us = 0;
  estimator.add(host.ask(100 * 1e5, 300, 300));
  EXPECT_NEAR(static_cast<double>(estimator.estimate()->offset.count()), 0, 1000);
  EXPECT_TRUE(std::isinf(estimator.estimate()->drift_error_ppm));
}

TEST(OffsetEstimator, WhatCannotBeChangesNothing) {
  OffsetEstimator estimator;
  estimator.add({10s, 5s, 5s, 9s});   // heard before it was asked
  estimator.add({10s, 5s, 7s, 10s});  // answered later than it was heard
  EXPECT_FALSE(estimator.estimate().has_value());
}

std::vector<ClockJudge::Change> judged(ClockJudge& judge, Duration offset, Duration error, double drift = 0,
                                       double drift_error = 1) {
  return judge.judge({offset, error, drift, drift_error});
}

TEST(ClockJudge, TellsOnceWhenTheClockGoesBeyondItsBoundAndOnceWhenItIsBack) {
  ClockJudge judge({250ms, 200});
  EXPECT_THAT(judged(judge, 240ms, 1ms), IsEmpty());
  EXPECT_THAT(judged(judge, -1s, 2ms),
              ElementsAre(AllOf(
                  Field(&ClockJudge::Change::code, "clock.offset"),
                  Field(&ClockJudge::Change::text,
                        "the clock is 1.000 s behind (give or take 0.002 s), beyond the bound of 0.250 s"))));
  EXPECT_TRUE(judge.beyond());
  EXPECT_THAT(judged(judge, -1s, 2ms), IsEmpty());
  EXPECT_THAT(judged(judge, 249ms, 2ms), ElementsAre(Field(&ClockJudge::Change::text, HasSubstr("within"))));
  EXPECT_FALSE(judge.beyond());
}

TEST(ClockJudge, WhatASlowNetworkExplainsIsNotBeyond) {
  ClockJudge judge({250ms, 200});
  EXPECT_THAT(judged(judge, 400ms, 200ms), IsEmpty());
  EXPECT_THAT(judged(judge, 0ms, 1ms, 900, 800), IsEmpty());
}

TEST(ClockJudge, ADriftBeyondItsBoundIsToldApart) {
  ClockJudge judge({250ms, 50});
  EXPECT_THAT(
      judged(judge, 0ms, 1ms, 100, 20),
      ElementsAre(Field(&ClockJudge::Change::text,
                        "the clock runs 100 ppm fast (give or take 20 ppm), beyond the bound of 50 ppm")));
  EXPECT_THAT(judged(judge, 0ms, 1ms, 0, INFINITY), IsEmpty()) << "after a step nothing is known";
  EXPECT_TRUE(judge.beyond());
  EXPECT_THAT(judged(judge, 0ms, 1ms, 10, 5), ElementsAre(Field(&ClockJudge::Change::code, "clock.drift")));
  EXPECT_FALSE(judge.beyond());
}

}  // namespace
}  // namespace roci::services::clock
