#include "services/clock/clock_master.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roci::services::clock {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

v1::ClockReady ready(const std::string& service, std::uint32_t incarnation = 1,
                     std::vector<std::string> topics = {}) {
  v1::ClockReady message;
  message.service(service);
  message.incarnation(incarnation);
  message.subscriptions(std::move(topics));
  return message;
}

v1::StreamCount count(const std::string& topic, const std::string& sender, std::uint64_t total,
                      std::uint32_t incarnation = 1) {
  v1::StreamCount stream;
  stream.topic(topic);
  stream.sender(sender);
  stream.incarnation(incarnation);
  stream.total(total);
  return stream;
}

v1::ClockDone done(const std::string& service, const v1::ClockStep& step, std::int64_t wish_us = -1,
                   std::vector<v1::StreamCount> sent = {}, std::uint32_t incarnation = 1) {
  v1::ClockDone message;
  message.service(service);
  message.incarnation(incarnation);
  message.time_us(step.time_us());
  message.micro_step(step.micro_step());
  message.sent(std::move(sent));
  message.wish_us(wish_us);
  return message;
}

std::vector<std::string> names(const std::vector<v1::RosterEntry>& roster) {
  std::vector<std::string> services;
  for (const auto& entry : roster)
    services.push_back(entry.service() + "#" + std::to_string(entry.incarnation()));
  return services;
}

// a, b and c are ready; c reads topic "t".
class ClockMasterTest : public testing::Test {
 protected:
  v1::ClockStep first_step() {
    master.ready(ready("a"));
    master.ready(ready("b"));
    master.ready(ready("c", 1, {"t"}));
    return master.issue(0s);
  }
  ClockMaster master{"a", {"a", "b", "c"}, 100};
};

TEST_F(ClockMasterTest, WaitsForTheRoster) {
  EXPECT_THAT(master.missing(), ElementsAre("a", "b", "c"));
  master.ready(ready("c"));
  master.ready(ready("a"));
  EXPECT_THAT(master.missing(), ElementsAre("b"));
  EXPECT_FALSE(master.window());
  master.ready(ready("b"));
  EXPECT_TRUE(master.window());
}

TEST_F(ClockMasterTest, EveryoneActsInTheFirstStep) {
  const auto step = first_step();
  EXPECT_EQ(step.time_us(), 0);
  EXPECT_EQ(step.micro_step(), 0U);
  EXPECT_THAT(step.participants(), ElementsAre("a", "b", "c"));
  EXPECT_THAT(names(step.roster()), ElementsAre("a#1", "b#1", "c#1"));
  EXPECT_FALSE(master.window());
}

TEST_F(ClockMasterTest, ReadersOfGrownStreamsActInTheNextMicroStep) {
  const auto step = first_step();
  master.done(done("a", step));
  master.done(done("b", step, -1, {count("t", "b", 2)}));
  EXPECT_FALSE(master.window());
  master.done(done("c", step));
  ASSERT_TRUE(master.window());
  EXPECT_EQ(master.window()->earliest, 0s);
  const auto next = master.issue(0s);
  EXPECT_EQ(next.micro_step(), 1U);
  EXPECT_THAT(next.participants(), ElementsAre("c"));
  ASSERT_EQ(next.totals().size(), 1U);
  EXPECT_EQ(next.totals()[0].total(), 2U);
}

TEST(ClockMasterOfRobots, OnlyThoseWhoHearARobotActOnItsInnerStreams) {
  ClockMaster master("world", {"a", "b", "world"}, 100);
  master.ready(ready("a", 1, {"t", "t@rover"}));
  master.ready(ready("b", 1, {"t", "t@lander"}));
  master.ready(ready("world", 1, {"t", "t@*"}));
  const auto step = master.issue(0s);
  master.done(done("a", step, -1, {count("t@rover", "a", 1)}));
  master.done(done("b", step));
  master.done(done("world", step));
  const auto next = master.issue(0s);
  EXPECT_THAT(next.participants(), ElementsAre("a", "world"));
  master.done(done("a", next));
  master.done(done("world", next, -1, {count("t", "world", 1)}));
  EXPECT_THAT(master.issue(0s).participants(), ElementsAre("a", "b", "world"));
}

TEST_F(ClockMasterTest, TimeJumpsToTheEarliestWish) {
  const auto step = first_step();
  master.done(done("a", step, 9'000'000));
  master.done(done("b", step, 5'000'000));
  master.done(done("c", step));
  EXPECT_EQ(master.window()->earliest, 5s);
  EXPECT_EQ(master.window()->latest, 5s);
  const auto next = master.issue(5s);
  EXPECT_EQ(next.micro_step(), 0U);
  EXPECT_THAT(next.participants(), ElementsAre("b"));
  master.done(done("b", next));
  EXPECT_EQ(master.window()->earliest, 9s);
}

// A death that nobody has noticed yet: what the dead one would have heard, or wished to do, stops the clock.
TEST_F(ClockMasterTest, TimeDoesNotPassWhatAnUnnoticedDeadOneWouldHaveActedOn) {
  const auto step = first_step();
  master.done(done("a", step, 2'000'000, {count("t", "a", 1)}));
  master.done(done("b", step, 1'000'000));
  master.done(done("c", step, 9'000'000));
  const auto input = master.issue(0s);  // c reads t, and died
  EXPECT_THAT(input.participants(), ElementsAre("c"));
  EXPECT_FALSE(master.window());
  master.lost("c", 1, "killed");
  ASSERT_TRUE(master.window());
  EXPECT_EQ(master.window()->earliest, 0s);
}

TEST_F(ClockMasterTest, NobodyWantsToAct) {
  const auto step = first_step();
  for (const char* service : {"a", "b", "c"}) master.done(done(service, step));
  EXPECT_FALSE(master.window());
}

TEST_F(ClockMasterTest, OutsideInputMayComeAnywhereBeforeTheNextWish) {
  const auto step = first_step();
  master.done(done("a", step, 9'000'000));
  master.done(done("b", step));
  master.done(done("c", step));
  master.done(done("b", step, 0));  // again: b holds input from an observer
  ASSERT_TRUE(master.window());
  EXPECT_EQ(master.window()->earliest, 0s);
  EXPECT_EQ(master.window()->latest, 9s);
  EXPECT_THAT(master.issue(4s).participants(), ElementsAre("b"));
}

TEST_F(ClockMasterTest, ADeathInAStepReissuesItWithoutTheDead) {
  const auto step = first_step();
  master.done(done("a", step));
  master.done(done("c", step));
  EXPECT_THAT(master.awaited(), ElementsAre("b"));
  master.lost("b", 1, "killed");
  EXPECT_TRUE(master.awaited().empty());
  EXPECT_FALSE(master.take_revision()) << "nobody is left to tell";
  const auto next = master.issue(0s);
  EXPECT_THAT(next.participants(), ElementsAre("a", "c")) << "a death is news for all";
  ASSERT_EQ(next.losses().size(), 1U);
  EXPECT_EQ(next.losses()[0].cause(), "killed");
}

TEST_F(ClockMasterTest, ARevisionIsTheSameMicroStepForThoseWhoStillOwe) {
  const auto step = first_step();
  master.done(done("a", step));
  master.lost("b", 1, "killed");
  const auto revision = master.take_revision();
  ASSERT_TRUE(revision);
  EXPECT_EQ(revision->time_us(), step.time_us());
  EXPECT_EQ(revision->micro_step(), step.micro_step());
  EXPECT_EQ(revision->revision(), 1U);
  EXPECT_THAT(names(revision->roster()), ElementsAre("a#1", "c#1"));
  EXPECT_FALSE(master.take_revision());
  EXPECT_THAT(master.awaited(), ElementsAre("c"));
}

// A newcomer may be waiting for the state that the dead one never gets across.
TEST_F(ClockMasterTest, ADeathAfterTheAnswerRevisesTheStepToo) {
  const auto step = first_step();
  master.done(done("a", step));
  master.done(done("b", step, -1, {count("t", "b", 3)}));
  master.lost("b", 1, "killed");
  const auto revision = master.take_revision();
  ASSERT_TRUE(revision);
  EXPECT_THAT(names(revision->roster()), ElementsAre("a#1", "c#1"));
  EXPECT_THAT(master.awaited(), ElementsAre("c"));
}

TEST_F(ClockMasterTest, ARestartedServiceIsAdmittedAtTheNextBoundary) {
  const auto step = first_step();
  master.done(done("a", step));
  master.done(done("c", step));
  master.ready(ready("b", 2));  // no death was seen: the new incarnation proves it
  const auto next = master.issue(0s);
  EXPECT_THAT(names(next.roster()), ElementsAre("a#1", "b#2", "c#1"));
  EXPECT_THAT(next.participants(), ElementsAre("a", "b", "c"));
  EXPECT_EQ(next.losses().at(0).cause(), "restarted");
}

TEST_F(ClockMasterTest, IgnoresTheDeadAndTheStale) {
  const auto step = first_step();
  master.done(done("a", step));
  master.done(done("b", step));
  master.done(done("c", step));
  master.ready(ready("b", 2));
  const auto next = master.issue(0s);
  master.done(done("b", next, 0, {count("t", "b", 7)}, 1));
  EXPECT_THAT(master.awaited(), ElementsAre("a", "b", "c")) << "incarnation 1 of b is gone";
  master.done(done("a", step));
  EXPECT_THAT(master.awaited(), ElementsAre("a", "b", "c")) << "that answered an older micro-step";
  master.lost("b", 1, "killed");
  EXPECT_THAT(names(next.roster()), ElementsAre("a#1", "b#2", "c#1"));
  master.ready(ready("b", 2));
  EXPECT_THAT(master.awaited(), ElementsAre("a", "b", "c"));
}

TEST_F(ClockMasterTest, ForgetsStreamsOfTheDeadOnceAllHaveActed) {
  auto step = first_step();
  master.done(done("a", step));
  master.done(done("b", step, -1, {count("t", "b", 2)}));
  master.done(done("c", step));
  master.lost("b", 1, "killed");
  step = master.issue(0s);
  EXPECT_EQ(step.totals().size(), 1U);
  master.done(done("a", step, 0));
  master.done(done("c", step));
  EXPECT_THAT(master.issue(0s).totals(), IsEmpty());
}

TEST_F(ClockMasterTest, LivelockNamesWhoStillActs) {
  auto step = first_step();
  master.done(done("a", step));
  master.done(done("b", step));
  master.done(done("c", step, 0));
  for (int i = 0; i < 100; ++i) {
    step = master.issue(0s);
    master.done(done("c", step, 0));
  }
  try {
    master.issue(0s);
    FAIL() << "101 micro-steps";
  } catch (const ClockError& error) {
    EXPECT_THAT(error.what(), HasSubstr("livelock: 100 micro-steps at mission time 0 us"));
    EXPECT_THAT(error.what(), HasSubstr("act: c;"));
  }
}

TEST_F(ClockMasterTest, TheLastStepIsForAll) {
  const auto step = first_step();
  for (const char* service : {"a", "b", "c"}) master.done(done(service, step, 1));
  const auto last = master.issue_last();
  EXPECT_TRUE(last.last());
  EXPECT_THAT(last.participants(), ElementsAre("a", "b", "c"));
  for (const char* service : {"a", "b", "c"}) master.done(done(service, last, 1));
  EXPECT_THAT(master.awaited(), IsEmpty());
  EXPECT_FALSE(master.window());
}

}  // namespace
}  // namespace roci::services::clock
