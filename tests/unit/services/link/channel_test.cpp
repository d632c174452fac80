// One direction of a link: its rules one by one, and what holds for random links and samples.
#include "services/link/channel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace roci::services::link {
namespace {

using namespace std::chrono_literals;
using temporal::Time;
using testing::ElementsAre;
using testing::IsEmpty;

LinkSample sample(std::uint64_t number, std::size_t bytes = 0, const std::string& instance = "") {
  LinkSample out{"roci/event", "a", 1, number, bytes};
  if (instance.empty()) return out;
  out.topic = "roci/observation";
  out.lifetime = Lifetime::newest;
  out.instance = instance;
  return out;
}

// "number@milliseconds"
std::vector<std::string> texts(const std::vector<Channel::Arrival>& arrivals) {
  std::vector<std::string> out;
  for (const auto& arrival : arrivals)
    out.push_back(std::to_string(arrival.sample.number) + "@" + std::to_string(arrival.at / 1ms));
  return out;
}

TEST(Channel, WithoutAnySettingEverythingArrivesAtOnce) {
  const Link link{"l", {"a", "b"}};
  Channel channel(link, 1);
  EXPECT_TRUE(channel.offer(sample(1), 5ms));
  EXPECT_TRUE(channel.offer(sample(2), 5ms));
  EXPECT_EQ(channel.next(), std::nullopt);
  EXPECT_EQ(channel.counts(), (Counts{.offered = 2, .arrived = 2}));
}

TEST(Channel, TheLightTimeDelaysAll) {
  Link link{"l", {"a", "b"}};
  link.light_time = 1500ms;
  Channel channel(link, 1);
  EXPECT_FALSE(channel.offer(sample(1), 10ms));
  EXPECT_FALSE(channel.offer(sample(2), 20ms));
  EXPECT_EQ(channel.next(), 1510ms);
  EXPECT_THAT(channel.take(1509ms), IsEmpty());
  EXPECT_THAT(texts(channel.take(1600ms)), ElementsAre("1@1510", "2@1520"));
}

TEST(Channel, TheRateSendsOneAfterTheOther) {
  Link link{"l", {"a", "b"}};
  link.rate_bit_s = 8000;  // a byte in a millisecond
  link.light_time = 1s;
  Channel channel(link, 1);
  EXPECT_FALSE(channel.offer(sample(1, 100), 0ms));
  EXPECT_FALSE(channel.offer(sample(2, 50), 10ms));
  EXPECT_FALSE(channel.offer(sample(3, 1), 500ms));
  EXPECT_THAT(texts(channel.take(5s)), ElementsAre("1@1100", "2@1150", "3@1501"));
}

TEST(Channel, AClosedLinkLosesWhatIsSaidOnceAndKeepsTheNewestState) {
  Link link{"l", {"a", "b"}};
  link.open = Schedule({{10s, 20s}}, {});
  Channel channel(link, 1);
  EXPECT_FALSE(channel.offer(sample(1), 1s));
  EXPECT_FALSE(channel.offer(sample(2, 0, "x"), 2s));
  EXPECT_FALSE(channel.offer(sample(3, 0, "y"), 3s));
  EXPECT_FALSE(channel.offer(sample(4, 0, "x"), 4s));
  EXPECT_EQ(channel.next(), 10s);
  EXPECT_THAT(texts(channel.take(10s)), ElementsAre("3@10000", "4@10000"));
  EXPECT_EQ(channel.counts(), (Counts{.offered = 4, .arrived = 2, .lost = 1, .superseded = 1}));
}

TEST(Channel, WhatIsUnderWayWhenTheLinkIsCutIsLostOrSentAgain) {
  Link link{"l", {"a", "b"}};
  link.rate_bit_s = 8000;
  link.open = Schedule({}, {{100ms, 3s}});
  Channel channel(link, 1);
  EXPECT_FALSE(channel.offer(sample(1, 200), 0ms));
  EXPECT_FALSE(channel.offer(sample(2, 200), 0ms));  // its turn never comes
  EXPECT_FALSE(channel.offer(sample(3, 200, "x"), 0ms));
  EXPECT_THAT(texts(channel.take(10s)), ElementsAre("3@3200"));
  EXPECT_EQ(channel.counts(), (Counts{.offered = 3, .arrived = 1, .lost = 2}));
}

TEST(Channel, AStateSampleIsRepeatedUntilItArrivesOrANewerOneComes) {
  Link link{"l", {"a", "b"}};
  link.loss = 0.9;
  int repeated = 0;
  for (std::uint64_t number = 1; number <= 50; ++number) {
    Channel channel(link, number);
    const bool at_once = channel.offer(sample(number, 0, "x"), 0s);
    const auto arrivals = channel.take(3600s);
    EXPECT_EQ(arrivals.size(), at_once ? 0U : 1U);
    repeated += static_cast<int>(channel.counts().repeated);
    if (at_once) continue;
    EXPECT_EQ(arrivals[0].at % 200ms, 0us);
  }
  EXPECT_GT(repeated, 50);
  link.loss = 1;
  Channel channel(link, 1);
  EXPECT_FALSE(channel.offer(sample(1, 0, "x"), 0s));
  EXPECT_FALSE(channel.offer(sample(2, 0, "x"), 1s));
  EXPECT_THAT(channel.take(60s), IsEmpty());
  EXPECT_EQ(channel.counts().superseded, 1U);
}

// "number fate@milliseconds" of each.
std::vector<std::string> texts(const std::vector<Loss>& losses) {
  std::vector<std::string> out;
  for (const Loss& loss : losses) {
    const char* fate = loss.fate == Fate::lost       ? " lost@"
                       : loss.fate == Fate::repeated ? " repeated@"
                                                     : " superseded@";
    out.push_back(std::to_string(loss.sample.number) + fate + std::to_string(loss.at / 1ms));
  }
  return out;
}

TEST(Channel, WhatDoesNotArriveIsToldByName) {
  Link link{"l", {"a", "b"}};
  link.rate_bit_s = 8000;
  link.open = Schedule({}, {{100ms, 3s}});
  Channel channel(link, 1);
  channel.offer(sample(1, 200), 0ms);
  channel.offer(sample(2, 200), 0ms);
  channel.offer(sample(3, 200, "x"), 10ms);
  channel.offer(sample(4, 200, "y"), 20ms);
  channel.take(200ms);
  EXPECT_THAT(texts(channel.take_losses()), ElementsAre("1 lost@100", "2 lost@100"));
  channel.offer(sample(5, 200, "x"), 1s);
  channel.offer(sample(6), 2s);
  EXPECT_THAT(texts(channel.take_losses()), ElementsAre("3 superseded@1000", "6 lost@2000"));
  link.loss = 1;
  channel.take(3300ms);
  EXPECT_THAT(texts(channel.take_losses()), ElementsAre("4 repeated@3200", "5 repeated@3400"));
  EXPECT_THAT(channel.take_losses(), IsEmpty());
}

// The numbers stand for all machines: a trace is the same on each.
TEST(Channel, ChanceDependsOnTheSampleAlone) {
  EXPECT_EQ(chance(1, "l", sample(1), 1), chance(1, "l", sample(1, 99), 1));
  std::vector<double> all{chance(1, "l", sample(1), 1),        chance(2, "l", sample(1), 1),
                          chance(1, "m", sample(1), 1),        chance(1, "l", sample(2), 1),
                          chance(1, "l", sample(1), 2),        chance(1, "l", {"roci/event", "b", 1, 1}, 1),
                          chance(1, "l", {"x", "a", 1, 1}, 1), chance(1, "l", {"roci/event", "a", 2, 1}, 1)};
  std::ranges::sort(all);
  EXPECT_EQ(std::ranges::adjacent_find(all), all.end());
  Link link{"l", {"a", "b"}};
  link.loss = 0.2;
  Channel channel(link, 7);
  int arrived = 0;
  for (std::uint64_t number = 1; number <= 10'000; ++number) arrived += channel.offer(sample(number), 0s);
  EXPECT_NEAR(arrived, 8000, 160);
  EXPECT_EQ(channel.counts().lost, 10'000U - static_cast<std::uint64_t>(arrived));
}

TEST(Channel, WhatWaitsForANarrowLinkIsBounded) {
  Link link{"l", {"a", "b"}};
  link.rate_bit_s = 1;
  Channel channel(link, 1);
  for (std::uint64_t number = 1; number <= 2 * kLongestQueue; ++number)
    channel.offer(sample(number, 1000), 0s);
  EXPECT_EQ(channel.counts().lost, kLongestQueue - 1);  // one is being sent
}

// ---- random links and samples

struct Sent {
  Time at{};
  LinkSample sample;
};

struct Case {
  Link link{"l", {"a", "b"}};
  std::vector<Sent> sent;
};

Case random_case(std::mt19937& random) {
  Case out;
  const auto up_to = [&random](int most) {
    return static_cast<int>(random() % static_cast<unsigned>(most + 1));
  };
  if (up_to(1)) out.link.light_time = std::chrono::milliseconds(up_to(3000));
  if (up_to(1)) out.link.rate_bit_s = 1000 + up_to(20'000);
  if (up_to(1)) out.link.loss = up_to(8) / 10.0;
  std::vector<Interval> windows, cuts;
  if (up_to(1)) windows = {{2s, 10s}, {15s, 25s}, {40s, 3600s}};
  if (up_to(1)) cuts = {{5s, 6s}, {18s, 19500ms}};
  out.link.open = Schedule(windows, cuts);
  Time at{0};
  for (std::uint64_t number = 1; number <= 80; ++number) {
    at += std::chrono::milliseconds(up_to(1) * up_to(1000));
    const std::string instance = up_to(1) ? std::string(1, static_cast<char>('x' + up_to(2))) : "";
    out.sent.push_back({at, sample(number, static_cast<std::size_t>(4 + 4 * up_to(300)), instance)});
  }
  return out;
}

// "topic number at" of all that arrives, with take() called at `stops`, at each sample, and at each next().
std::vector<std::string> fly(const Case& test, const std::vector<Time>& stops, Counts* counts = nullptr,
                             std::vector<Loss>* losses = nullptr) {
  Channel channel(test.link, 3);
  std::vector<std::string> out;
  const auto note = [&out](Time at, const LinkSample& one) {
    out.push_back(std::to_string(at.count()) + " " + one.topic + " " + std::to_string(one.number));
  };
  const auto take_until = [&](Time until) {
    for (auto next = channel.next(); next && *next <= until; next = channel.next())
      for (const auto& arrival : channel.take(*next)) note(arrival.at, arrival.sample);
  };
  auto stop = stops.begin();
  for (const Sent& sent : test.sent) {
    for (; stop != stops.end() && *stop <= sent.at; ++stop) {
      take_until(*stop);
      EXPECT_THAT(channel.take(*stop), IsEmpty());
    }
    take_until(sent.at);
    if (channel.offer(sent.sample, sent.at)) note(sent.at, sent.sample);
  }
  take_until(3600s);
  if (counts) *counts = channel.counts();
  if (losses) *losses = channel.take_losses();
  return out;
}

TEST(ChannelProperties, WhenItIsAskedMakesNoDifference) {
  std::mt19937 random(11);
  for (int round = 0; round < 200; ++round) {
    const Case test = random_case(random);
    std::vector<Time> stops;
    for (int i = 0; i < 50; ++i) stops.push_back(std::chrono::milliseconds(random() % 40'000));
    std::ranges::sort(stops);
    ASSERT_EQ(fly(test, {}), fly(test, stops)) << "round " << round;
  }
}

TEST(ChannelProperties, EverySampleHasOneFate) {
  std::mt19937 random(12);
  for (int round = 0; round < 200; ++round) {
    const Case test = random_case(random);
    Counts counts;
    std::vector<Loss> losses;
    const auto arrived = fly(test, {}, &counts, &losses);
    const auto of = [&](Fate fate) {
      return static_cast<std::uint64_t>(std::ranges::count(losses, fate, &Loss::fate));
    };
    EXPECT_EQ(of(Fate::lost), counts.lost) << "round " << round;
    EXPECT_EQ(of(Fate::superseded), counts.superseded) << "round " << round;
    EXPECT_EQ(of(Fate::repeated), counts.repeated) << "round " << round;
    EXPECT_EQ(counts.offered, test.sent.size());
    EXPECT_EQ(counts.arrived, arrived.size());
    EXPECT_EQ(counts.offered, counts.arrived + counts.lost + counts.superseded) << "round " << round;
    for (const char* instance : {"x", "y", "z"}) {
      const auto newest = std::find_if(test.sent.rbegin(), test.sent.rend(),
                                       [&](const Sent& sent) { return sent.sample.instance == instance; });
      if (newest == test.sent.rend()) continue;
      const std::string end = " roci/observation " + std::to_string(newest->sample.number);
      EXPECT_TRUE(std::ranges::any_of(arrived, [&](const auto& one) { return one.ends_with(end); }))
          << "round " << round << end;
    }
  }
}

TEST(ChannelProperties, NothingIsFasterThanTheLinkOrPassesItWhileItIsClosed) {
  std::mt19937 random(13);
  for (int round = 0; round < 200; ++round) {
    const Case test = random_case(random);
    Channel channel(test.link, 3);
    std::vector<std::pair<Time, std::size_t>> ends;  // of sending, with the bytes
    const auto note = [&](Time at, const LinkSample& one) {
      const Time end = at - test.link.light_time;
      EXPECT_GE(end, test.sent[one.number - 1].at);
      EXPECT_TRUE(test.link.open.open(end) || test.link.open.open(end - 1us)) << "round " << round;
      ends.emplace_back(end, one.bytes);
    };
    for (const Sent& sent : test.sent) {
      for (const auto& arrival : channel.take(sent.at)) note(arrival.at, arrival.sample);
      if (channel.offer(sent.sample, sent.at)) note(sent.at, sent.sample);
    }
    for (const auto& arrival : channel.take(3600s)) note(arrival.at, arrival.sample);
    if (test.link.rate_bit_s == 0) continue;
    std::ranges::sort(ends);
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const double gap_s = temporal::to_seconds(ends[i].first - ends[i - 1].first);
      EXPECT_GE(gap_s + 1e-6, 8.0 * static_cast<double>(ends[i].second) / test.link.rate_bit_s);
    }
  }
}

TEST(ChannelProperties, WithoutARateNoSampleDependsOnAnother) {
  std::mt19937 random(14);
  for (int round = 0; round < 100; ++round) {
    Case test = random_case(random);
    test.link.rate_bit_s = 0;
    std::erase_if(test.sent, [](const Sent& sent) { return sent.sample.lifetime == Lifetime::newest; });
    const auto all = fly(test, {});
    Case fewer = test;
    std::erase_if(fewer.sent, [](const Sent& sent) { return sent.sample.number % 3 == 0; });
    for (const std::string& one : fly(fewer, {}))
      EXPECT_TRUE(std::ranges::find(all, one) != all.end()) << "round " << round << ": " << one;
  }
}

TEST(ChannelBounds, WhatIsUnderWayIsBounded) {
  Link link{"l", {"a", "b"}};
  link.light_time = 20min;
  Channel channel(link, 1);
  for (std::uint64_t i = 0; i < kLongestFlight + 10; ++i) channel.offer(sample(i + 1), 0ms);
  EXPECT_EQ(channel.counts().under_way, kLongestFlight);
  EXPECT_EQ(channel.counts().lost, 10U);
  EXPECT_EQ(channel.take(20min).size(), kLongestFlight);
  EXPECT_FALSE(channel.offer(sample(1), 20min));
  EXPECT_EQ(channel.counts().lost, 10U) << "room again";
}

TEST(ChannelBounds, InstancesOfStatesAreBounded) {
  const Link link{"l", {"a", "b"}};
  Channel channel(link, 1);
  std::size_t arrived = 0;
  for (std::uint64_t i = 0; i < kLongestFlight + 10; ++i)
    arrived += channel.offer(sample(i + 1, 0, std::to_string(i)), 0ms) ? 1 : 0;
  EXPECT_EQ(arrived, kLongestFlight);
  EXPECT_EQ(channel.counts().lost, 10U);
  EXPECT_TRUE(channel.offer(sample(1, 0, "7"), 0ms)) << "who is known goes on";
}

}  // namespace
}  // namespace roci::services::link
