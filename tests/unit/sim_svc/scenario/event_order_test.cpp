#include "sim_svc/scenario/event_order.hpp"

#include <gtest/gtest.h>

namespace roci::sim::scenario {
namespace {

EventOrder dropped_between_plans() {
  return EventOrder({{"plan.adopted", ""}, {"goal.dropped", "gap"}, {"plan.adopted", "plan 2"}});
}

TEST(EventOrder, TheListedEventsInTheirOrderWithOthersBetween) {
  EventOrder order = dropped_between_plans();
  order.note("goal.accepted", "goal gap accepted");
  order.note("plan.adopted", "plan 1");
  order.note("goal.dropped", "goal gap dropped");
  EXPECT_EQ(order.final_fault(),
            "after 2 of 3 events, plan.adopted (plan 2) was expected, but the run ended");
  order.note("plan.adopted", "plan 2");
  EXPECT_EQ(order.final_fault(), "");
}

TEST(EventOrder, AListedCodeAtAnotherPlaceIsAFaultForGood) {
  EventOrder order = dropped_between_plans();
  order.note("goal.dropped", "goal gap dropped");
  EXPECT_EQ(order.fault(),
            "after 0 of 3 events, plan.adopted was expected, but there was goal.dropped: goal gap dropped");
  const std::string first = order.fault();
  order.note("plan.adopted", "plan 1");
  EXPECT_EQ(order.final_fault(), first);
}

TEST(EventOrder, AnotherTextIsAnotherEvent) {
  EventOrder order = dropped_between_plans();
  order.note("plan.adopted", "plan 1");
  order.note("goal.dropped", "goal ridge dropped");
  EXPECT_NE(order.fault(), "");
}

TEST(EventOrder, OneTooManyIsAFault) {
  EventOrder order(std::vector<ExpectedEvent>{{"goal.achieved", ""}});
  order.note("goal.achieved", "a");
  EXPECT_EQ(order.final_fault(), "");
  order.note("goal.achieved", "b");
  EXPECT_EQ(order.final_fault(),
            "after 1 of 1 events, no further one was expected, but there was goal.achieved: b");
}

TEST(EventOrder, WhatRepeatsComesOnceOrMore) {
  EventOrder order({{"hazard.seen", "rock", true}, {"plan.broken", ""}});
  order.note("plan.broken", "");
  EXPECT_NE(order.fault(), "");
  for (int times = 1; times < 4; ++times) {
    EventOrder several({{"hazard.seen", "rock", true}, {"plan.broken", ""}});
    for (int i = 0; i < times; ++i) several.note("hazard.seen", "a rock");
    several.note("plan.broken", "");
    EXPECT_EQ(several.final_fault(), "");
    several.note("hazard.seen", "a rock");
    EXPECT_NE(several.final_fault(), "");
  }
}

}  // namespace
}  // namespace roci::sim::scenario
