// The fold of messages into what the ground knows: the newest of each, in whatever order they come.
#include "ground_console/lib/mission_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "ground_console/lib/limits.hpp"
#include "tests/unit/ground_console/messages.hpp"

namespace roci::console {
namespace {

using namespace testing;

TEST(MissionViewTest, IsEmptyAtFirst) {
  const lib::MissionView view;
  EXPECT_FALSE(view.mission());
  EXPECT_FALSE(view.plan());
  EXPECT_TRUE(view.goals().empty());
  EXPECT_EQ(view.goal({"ground", "ridge"}), nullptr);
  EXPECT_EQ(view.step("1.a1"), nullptr);
  EXPECT_EQ(view.timeline("rover.nav"), nullptr);
  EXPECT_EQ(view.now_us(), 0);
}

TEST(MissionViewTest, KeepsTheNewestOfEachKey) {
  lib::MissionView view = flying_mission();
  view.take(goal_status("ridge", v1::GOAL_ACHIEVED, 7));
  EXPECT_EQ(view.goals().at({"ground", "ridge"}).goal_state(), v1::GOAL_ACHIEVED);
  EXPECT_EQ(view.goals().at({"ground", "far"}).goal_state(), v1::GOAL_REJECTED);
  EXPECT_EQ(view.now_us(), 300'000'000) << "of the newest sample, whichever it is";
}

TEST(MissionViewTest, KeepsABoundedNumberOfEach) {
  lib::MissionView view;
  for (std::size_t i = 0; i < lib::kEntries + 50; ++i) {
    const std::string name = "n" + std::to_string(i);
    view.take(goal_status(name, v1::GOAL_PENDING, 1));
    v1::Observation observation;
    observation.timeline(name);
    view.take(observation);
    v1::Hazard hazard;
    hazard.id(name);
    view.take(hazard);
    v1::DataProduct product;
    product.id(name);
    view.take(product);
    v1::Decision decision;
    decision.id(name);
    view.take(decision);
    v1::Heartbeat beat;
    beat.service(name);
    view.take(beat);
  }
  EXPECT_EQ(view.goals().size(), lib::kEntries);
  EXPECT_EQ(view.timelines().size(), lib::kEntries);
  EXPECT_EQ(view.hazards().size(), lib::kEntries);
  EXPECT_EQ(view.products().size(), lib::kEntries);
  EXPECT_EQ(view.decisions().size(), lib::kEntries);
  EXPECT_EQ(view.services().size(), lib::kServices);
  EXPECT_EQ(view.unseen(), 5 * 50 + lib::kEntries + 50 - lib::kServices);
  view.take(goal_status("n7", v1::GOAL_ACHIEVED, 2));
  EXPECT_EQ(view.goals().at({"ground", "n7"}).goal_state(), v1::GOAL_ACHIEVED) << "what is known goes on";
  v1::OrderStatus status;
  for (std::size_t i = 0; i < 3 * lib::kStages; ++i) view.take(status);
  EXPECT_EQ(view.order("", "").size(), lib::kStages);
}

TEST(MissionViewTest, ARestartedSenderCountsAnew) {
  lib::MissionView view;
  view.take(goal_status("ridge", v1::GOAL_PENDING, 900));
  v1::GoalStatus again = goal_status("ridge", v1::GOAL_PLANNED, 1);
  again.header(sent("exec_svc", 1, 11, 2));
  view.take(again);
  view.take(goal_status("ridge", v1::GOAL_PENDING, 901));
  EXPECT_EQ(view.goals().at({"ground", "ridge"}).goal_state(), v1::GOAL_PLANNED);
}

TEST(MissionViewTest, AnOlderPlanNeverReplacesANewerOne) {
  lib::MissionView view = flying_mission();
  v1::Plan old;
  old.version(1);
  view.take(old);
  EXPECT_EQ(view.plan()->version(), 2U);
}

v1::MissionStatus status_of(const std::string& executive, const std::string& outcome) {
  v1::MissionStatus status;
  status.executive(executive);
  status.header(sent(executive, 1, 10));
  status.outcome(outcome);
  return status;
}

v1::Plan plan_of(const std::string& executive, std::uint32_t version) {
  v1::Plan plan;
  plan.executive(executive);
  plan.version(version);
  return plan;
}

// Two executives fly two robots: neither's plan, steps or result stands for the other's.
TEST(MissionViewTest, EachExecutiveHasItsOwnPlanStepsAndResult) {
  lib::MissionView view;
  for (const auto& [executive, version] : {std::pair("exec.digger", 7U), {"exec.hauler", 3U}}) {
    view.take(plan_of(executive, version));
    v1::StepStatus started = step("p1.a", v1::ACTIVITY_RUNNING, version, 0, 0, -1);
    started.executive(executive);
    started.plan_version(version);
    view.take(started);
  }
  view.take(status_of("exec.digger", "achieved"));
  view.take(status_of("exec.hauler", ""));
  EXPECT_THAT(view.executives(), ::testing::ElementsAre("exec.digger", "exec.hauler"));
  EXPECT_EQ(view.executive(), "exec.digger");
  EXPECT_EQ(view.plan()->version(), 7U);
  EXPECT_FALSE(view.ended()) << "one still flies";
  view.look_at("exec.hauler");
  EXPECT_EQ(view.plan()->version(), 3U);
  EXPECT_EQ(view.step("p1.a")->plan_version(), 3U);
  EXPECT_EQ(view.mission()->outcome(), "");
  view.look_at("exec.digger");
  EXPECT_TRUE(view.ended());
  view.look_at("nobody");
  EXPECT_EQ(view.plan(), nullptr);
}

TEST(MissionViewTest, AHeartbeatOfAnEarlierLifeIsNoNews) {
  lib::MissionView view;
  v1::Heartbeat beat;
  beat.service("arm_svc");
  beat.incarnation(2);
  beat.progress(1);
  view.take(beat);
  beat.incarnation(1);
  beat.progress(900);
  view.take(beat);
  EXPECT_EQ(view.services().at("arm_svc").incarnation(), 2U);
}

TEST(MissionViewTest, KeepsABoundedNumberOfEventsAndCountsThemAll) {
  lib::MissionView view;
  for (std::size_t i = 0; i < lib::MissionView::kEvents + 5; ++i) view.take(event(std::to_string(i), 1));
  EXPECT_EQ(view.events().size(), lib::MissionView::kEvents);
  EXPECT_EQ(view.events().front().text(), "5");
  EXPECT_EQ(view.events_seen(), lib::MissionView::kEvents + 5);
}

// Any order, any repetition: the same view of everything that has a key.
TEST(MissionViewTest, TheOrderOfArrivalDoesNotMatter) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<std::function<void(lib::MissionView&)>> messages;
    for (std::uint64_t seq = 1; seq <= 4; ++seq) {
      for (const char* id : {"a", "b"}) {
        const auto state = static_cast<v1::GoalState>(random() % 7);
        messages.emplace_back([=](lib::MissionView& view) { view.take(goal_status(id, state, seq)); });
        messages.emplace_back(
            [=](lib::MissionView& view) { view.take(observation(id, std::to_string(seq), seq)); });
        messages.emplace_back([=](lib::MissionView& view) {
          view.take(step(id, v1::ACTIVITY_RUNNING, seq, 0, static_cast<double>(seq), -1));
        });
      }
      messages.emplace_back([=](lib::MissionView& view) {
        v1::Plan plan;
        plan.version(static_cast<std::uint32_t>(seq));
        view.take(plan);
      });
    }
    lib::MissionView in_order;
    for (const auto& message : messages) message(in_order);
    for (std::size_t i = 0, count = messages.size(); i < count / 2; ++i)
      messages.push_back(messages[random() % count]);
    std::ranges::shuffle(messages, random);
    lib::MissionView shuffled;
    for (const auto& message : messages) message(shuffled);
    EXPECT_EQ(shuffled.goals(), in_order.goals()) << "seed " << seed;
    EXPECT_EQ(shuffled.timelines(), in_order.timelines()) << "seed " << seed;
    EXPECT_EQ(shuffled.plan()->version(), 4U) << "seed " << seed;
    for (const char* id : {"a", "b"})
      EXPECT_EQ(shuffled.step(id)->started_us(), 4'000'000) << "seed " << seed;
  }
}

TEST(Ways, JoinCoordinatesOfTheSameTime) {
  lib::MissionView view;
  view.take(number("rover.x", 1, 10));
  view.take(number("rover.y", 2, 10));
  view.take(number("rover.y", 5, 20));
  view.take(number("rover.x", 1, 20));
  view.take(number("rover.x", 9, 30));  // its y is still to come
  view.take(number("mast.x", 7, 30));   // has no y
  ASSERT_EQ(view.ways().size(), 1U);
  EXPECT_THAT(view.ways().at("rover"), ::testing::ElementsAre(lib::Place{1, 2}, lib::Place{1, 5}));
}

TEST(Ways, LongOnesAreThinnedOut) {
  lib::MissionView view;
  for (int i = 1; i <= 10'000; ++i) {
    view.take(number("rover.x", i, i));
    view.take(number("rover.y", 0, i));
  }
  const auto& way = view.ways().at("rover");
  EXPECT_LE(way.size(), lib::MissionView::kWay);
  EXPECT_EQ(way.front(), (lib::Place{1, 0}));
  EXPECT_NEAR(way.back().x_m, 10'000, 0);
  EXPECT_TRUE(std::ranges::is_sorted(way, {}, &lib::Place::x_m));
}

TEST(ValueText, IsWhatPeopleRead) {
  v1::TimelineValue value;
  EXPECT_EQ(lib::value_text(value), "none");
  value.kind(v1::VALUE_BOOLEAN);
  value.truth(true);
  EXPECT_EQ(lib::value_text(value), "true");
  value.kind(v1::VALUE_NUMBER);
  value.number(12.5);
  EXPECT_EQ(lib::value_text(value), "12.5");
  value.kind(v1::VALUE_STATE);
  value.state("going-to");
  value.arguments({"ridge"});
  EXPECT_EQ(lib::value_text(value), "going-to ridge");
  EXPECT_EQ(lib::clock_text(3'723'999'999), "01:02:03");
}

TEST(Names, OfValuesFromANewerVersionAreUnknown) {
  EXPECT_STREQ(lib::name_of(static_cast<v1::GoalState>(77)), "unknown");
  EXPECT_STREQ(lib::name_of(static_cast<v1::MissionPhase>(77)), "unknown");
  EXPECT_STREQ(lib::name_of(v1::PHASE_SAFE), "safe");
}

// A pair of which nobody leads, as an owner of commands is away.
TEST(Pair, WhoLooksForALeaderInVainIsNamedWhileNobodyLeads) {
  lib::MissionView view;
  EXPECT_EQ(view.leaderless(), "");
  v1::LeaseMessage second;
  second.executive("exec_svc");
  second.member("second");
  second.exec_role(v1::EXEC_FOLLOWING);
  view.take(second);
  EXPECT_EQ(view.leaderless(), "") << "it has just come";
  second.searching(true);
  view.take(second);
  EXPECT_EQ(view.leaderless(), "exec_svc (second)");
  v1::LeaseMessage first = second;
  first.member("first");
  first.exec_role(v1::EXEC_LEADING);
  view.take(first);
  EXPECT_EQ(view.leaderless(), "");
}

// A goal may be open when a scenario's time is up; the executive has no outcome then.
TEST(MissionViewTest, ARunIsOverWhenTheWorldSaysSo) {
  for (const char* code : {"scenario.over", "scenario.time-up"}) {
    lib::MissionView view = flying_mission();
    EXPECT_FALSE(view.ended());
    v1::Event event;
    event.code("scenario.started");
    view.take(event);
    EXPECT_FALSE(view.ended());
    event.code(code);
    view.take(event);
    EXPECT_TRUE(view.ended()) << code;
  }
}

}  // namespace
}  // namespace roci::console
