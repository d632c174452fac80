#include "services/clock/hold_back_queue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "services/clock/stream_topic.hpp"

namespace roci::services::clock {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

v1::SampleHeader header(const std::string& sender, std::uint64_t seq, std::uint32_t incarnation = 1) {
  v1::SampleHeader h;
  h.sender(sender);
  h.incarnation(incarnation);
  h.seq(seq);
  return h;
}

std::shared_ptr<const void> value(const std::string& text) { return std::make_shared<std::string>(text); }

// Values are strings "key=content".
HoldBackQueue::Key key_of(const void* sample) {
  const auto& text = *static_cast<const std::string*>(sample);
  const auto key = text.substr(0, text.find('='));
  return {key.begin(), key.end()};
}

struct Total {
  std::string topic, sender;
  std::uint64_t total;
  std::uint32_t incarnation = 1;
};

v1::ClockStep step_with(const std::vector<std::string>& roster, const std::vector<Total>& totals) {
  v1::ClockStep step;
  for (const auto& service : roster) {
    v1::RosterEntry entry;
    entry.service(service);
    entry.incarnation(1);
    step.roster().push_back(entry);
  }
  for (const Total& total : totals) {
    v1::StreamCount count;
    count.topic(total.topic);
    count.sender(total.sender);
    count.incarnation(total.incarnation);
    count.total(total.total);
    step.totals().push_back(count);
  }
  return step;
}

std::vector<std::string> texts(const std::vector<Delivery>& deliveries) {
  std::vector<std::string> all;
  for (const Delivery& delivery : deliveries)
    all.push_back(*static_cast<const std::string*>(delivery.value.get()));
  return all;
}

class HoldBackQueueTest : public testing::Test {
 protected:
  HoldBackQueueTest() {
    follower.subscribe("event", Durability::volatile_, key_of);
    follower.subscribe("state", Durability::transient_local, key_of);
  }
  void join() { follower.take(step_with({"a", "b"}, {})); }
  HoldBackQueue follower;
};

// Inner topics of robots: what another robot's services write never comes, so nobody waits for it.
TEST(HoldBackQueueOfARobot, WaitsForItsOwnRobotAndForThoseWithoutOne) {
  HoldBackQueue rover;
  for (const auto& stream : inner_subscriptions("event", "rover"))
    rover.subscribe(stream, Durability::volatile_, key_of);
  rover.take(step_with({"a", "b", "c"}, {}));
  const auto step =
      step_with({"a", "b", "c"}, {{"event", "c", 1}, {"event@lander", "b", 1}, {"event@rover", "a", 1}});
  EXPECT_THAT(rover.missing(step), ElementsAre("event c#1 0/1", "event@rover a#1 0/1"));
  rover.add("event", header("c", 1), value("x=c"));
  rover.add("event@rover", header("a", 1), value("x=a"));
  ASSERT_TRUE(rover.complete(step));
  EXPECT_THAT(texts(rover.take(step)), ElementsAre("x=a", "x=c")) << "by sender, whatever robot it is of";
}

TEST(HoldBackQueueOfARobot, WithoutARobotItWaitsForAll) {
  HoldBackQueue world;
  for (const auto& topic : {"event", "event/late"}) {
    for (const auto& stream : inner_subscriptions(topic, ""))
      world.subscribe(stream, Durability::volatile_, key_of);
  }
  world.take(step_with({"a", "b"}, {}));
  const auto step =
      step_with({"a", "b"}, {{"event/late", "b", 1}, {"event@lander", "b", 1}, {"event@rover", "a", 1}});
  EXPECT_EQ(world.missing(step).size(), 3U);
  world.add("event/late", header("b", 1), value("x=late"));
  world.add("event@lander", header("b", 1), value("x=b"));
  world.add("event@rover", header("a", 1), value("x=a"));
  ASSERT_TRUE(world.complete(step));
  const auto deliveries = world.take(step);
  EXPECT_THAT(texts(deliveries), ElementsAre("x=a", "x=b", "x=late")) << "by topic, then by sender";
  EXPECT_EQ(deliveries.front().topic, "event");
}

TEST_F(HoldBackQueueTest, IsCompleteWithExactlyTheAnnouncedSamples) {
  join();
  const auto step = step_with({"a"}, {{"event", "a", 2}});
  EXPECT_FALSE(follower.complete(step));
  EXPECT_THAT(follower.missing(step), ElementsAre("event a#1 0/2"));
  follower.add("event", header("a", 2), value("x=2"));
  EXPECT_FALSE(follower.complete(step)) << "number 1 is missing";
  follower.add("event", header("a", 1), value("x=1"));
  follower.add("event", header("a", 3), value("x=3"));
  ASSERT_TRUE(follower.complete(step));
  EXPECT_THAT(texts(follower.take(step)), ElementsAre("x=1", "x=2"))
      << "number 3 belongs to a later micro-step";
  EXPECT_THAT(texts(follower.take(step_with({"a"}, {{"event", "a", 3}}))), ElementsAre("x=3"));
}

TEST_F(HoldBackQueueTest, DeliversOnceInOrderWhateverTheArrival) {
  join();
  std::vector<std::tuple<std::string, std::string, std::uint64_t>> samples;
  for (const char* topic : {"event", "state"}) {
    for (const char* sender : {"a", "b"}) {
      for (std::uint64_t seq = 1; seq <= 5; ++seq) samples.emplace_back(topic, sender, seq);
    }
  }
  std::vector<std::string> expected;
  for (const auto& [topic, sender, seq] : samples) expected.push_back(topic + sender + std::to_string(seq));
  std::mt19937_64 random(7);
  std::ranges::shuffle(samples, random);
  const auto step =
      step_with({"a", "b"}, {{"event", "a", 5}, {"event", "b", 5}, {"state", "a", 5}, {"state", "b", 5}});
  for (const auto& [topic, sender, seq] : samples) {
    EXPECT_FALSE(follower.complete(step));
    follower.add(topic, header(sender, seq), value(topic + sender + std::to_string(seq)));
  }
  ASSERT_TRUE(follower.complete(step));
  EXPECT_EQ(texts(follower.take(step)), expected);
  EXPECT_THAT(follower.take(step), IsEmpty());
}

TEST_F(HoldBackQueueTest, DoesNotWaitForTopicsOfOthers) {
  join();
  const auto step = step_with({"a"}, {{"unread", "a", 3}});
  EXPECT_TRUE(follower.complete(step));
  EXPECT_THAT(follower.take(step), IsEmpty());
}

TEST_F(HoldBackQueueTest, DoesNotWaitForTheDeadButDeliversWhatTheyLeft) {
  join();
  follower.add("event", header("b", 1), value("b=1"));
  const auto step = step_with({"a"}, {{"event", "b", 2}});
  ASSERT_TRUE(follower.complete(step));
  EXPECT_THAT(texts(follower.take(step)), ElementsAre("b=1"));
}

TEST_F(HoldBackQueueTest, TheUnfinishedMicroStepOfTheDeadIsNeverSeen) {
  join();
  follower.add("event", header("b", 1), value("b=1"));
  follower.add("event", header("b", 2), value("b=2"));
  EXPECT_THAT(texts(follower.take(step_with({"a"}, {{"event", "b", 1}}))), ElementsAre("b=1"));
  EXPECT_THAT(texts(follower.take(step_with({"a"}, {}))), IsEmpty());
}

TEST_F(HoldBackQueueTest, ALateJoinerGetsTheNewestOfEachKeyOfStateTopics) {
  // History as a late joiner's reader brings it: in order, older samples of a key may be gone.
  for (const auto& [seq, text] :
       std::vector<std::pair<int, std::string>>{{3, "k=3"}, {4, "m=4"}, {6, "k=6"}, {7, "n=7"}, {8, "k=8"}}) {
    follower.add("state", header("a", static_cast<std::uint64_t>(seq)), value(text));
  }
  follower.add("event", header("a", 9), value("e=9"));
  const auto step = step_with({"a", "b"}, {{"event", "a", 9}, {"state", "a", 7}});
  ASSERT_TRUE(follower.complete(step));
  EXPECT_THAT(texts(follower.take(step)), ElementsAre("m=4", "k=6", "n=7"));
  EXPECT_THAT(texts(follower.take(step_with({"a", "b"}, {{"event", "a", 9}, {"state", "a", 8}}))),
              ElementsAre("k=8"));
}

TEST_F(HoldBackQueueTest, ALateJoinerWaitsForTheNewestAnnouncedState) {
  const auto step = step_with({"a"}, {{"event", "a", 4}, {"state", "a", 7}});
  EXPECT_FALSE(follower.complete(step));
  follower.add("state", header("a", 5), value("k=5"));
  EXPECT_FALSE(follower.complete(step));
  follower.add("state", header("a", 7), value("k=7"));
  EXPECT_TRUE(follower.complete(step)) << "events from before it joined are not awaited";
}

TEST_F(HoldBackQueueTest, IncarnationsAreStreamsOfTheirOwn) {
  join();
  follower.add("event", header("a", 1, 1), value("old"));
  follower.add("event", header("a", 1, 2), value("new"));
  auto step = step_with({"a"}, {{"event", "a", 1, 1}, {"event", "a", 1, 2}});
  step.roster()[0].incarnation(2);
  EXPECT_THAT(texts(follower.take(step)), ElementsAre("old", "new"));
}

}  // namespace
}  // namespace roci::services::clock
