#include "planner_svc/utility_htn/search/scheduler.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace {

using roci::planner::utility_htn::search::EarliestScheduler, roci::planner::utility_htn::search::Link,
    roci::planner::utility_htn::search::make_scheduler, roci::planner::utility_htn::search::NearestScheduler;
using roci::temporal::Duration, roci::temporal::ImpactKind, roci::temporal::ImpactWhen,
    roci::temporal::no_bound, roci::temporal::seconds, roci::temporal::Time;
using roci::temporal::timelines::Footprint, roci::temporal::timelines::Kind, roci::temporal::timelines::Phase,
    roci::temporal::timelines::Timelines;
using testing::ElementsAre, testing::Optional;

Footprint of_arm(double duration) {
  return {seconds(duration), {{0, ImpactKind::delta, ImpactWhen::during, 1}}, {}};
}
Link link(std::uint64_t id, double duration) {
  Link out;
  out.id = id;
  out.footprint = of_arm(duration);
  out.starts = {seconds(0), seconds(100)};
  return out;
}
Timelines arm_and_heat() {
  return Timelines({{"arm", Kind::atomic, {}, 0, 0, 1}, {"heat", Kind::state, {"cold", "warm"}}});
}

TEST(EarliestScheduler, PutsAnEarlierLinkOffAsFarAsTheGapAsks) {
  Timelines timelines = arm_and_heat();
  timelines.place(1000, of_arm(20), seconds(30));
  std::vector<Link> links{link(1, 10), link(2, 25)};
  links[1].longest_gap = seconds(5);
  EXPECT_THAT(EarliestScheduler().schedule(links, timelines),
              Optional(ElementsAre(seconds(50), seconds(60))));
  links[1].longest_gap = no_bound;
  timelines.remove(1);
  timelines.remove(2);
  EXPECT_THAT(EarliestScheduler().schedule(links, timelines), Optional(ElementsAre(seconds(0), seconds(50))));
}

TEST(EarliestScheduler, TriesLaterIntervalsOfALinkWhoseSuccessorHasNoPlace) {
  Timelines timelines = arm_and_heat();
  timelines.place(
      1000,
      {seconds(20),
       {{0, ImpactKind::delta, ImpactWhen::during, 1}, {1, ImpactKind::assign, ImpactWhen::at_end, 0}},
       {}},
      seconds(20));
  std::vector<Link> links{link(1, 10),
                          link(2, 30)};  // heats, then needs it warm for 30 s, which the other task ends
  links[0].footprint.impacts.push_back({1, ImpactKind::assign, ImpactWhen::at_end, 1});
  links[1].footprint.constraints.push_back({1, Phase::pre, -INFINITY, INFINITY, 2});
  EXPECT_THAT(EarliestScheduler().schedule(links, timelines),
              Optional(ElementsAre(seconds(40), seconds(50))));
}

TEST(Schedulers, LeaveTheTimelinesAsTheyWereWhenTheWholeChainHasNoPlace) {
  Timelines timelines = arm_and_heat();
  timelines.place(1000, of_arm(20), seconds(30));
  std::vector<Link> links{link(1, 10), link(2, 10), link(3, 10)};
  links[1].preferred_start = seconds(80);
  links[2].footprint.constraints.push_back({1, Phase::pre, -INFINITY, INFINITY, 2});  // never warm
  for (const char* name : {"earliest", "nearest"}) {
    EXPECT_FALSE(make_scheduler(name)->schedule(links, timelines)) << name;
    EXPECT_EQ(timelines.kept().tasks, 1U) << name;
    EXPECT_EQ(timelines.value(0, seconds(5)), 0) << name;
  }
}

TEST(NearestScheduler, TakesTheNearestValidStartAndTheEarlierOfTwo) {
  Timelines timelines = arm_and_heat();
  timelines.place(1000, of_arm(20), seconds(40));
  std::vector<Link> links{link(1, 10)};
  links[0].preferred_start = seconds(48);
  EXPECT_THAT(NearestScheduler().schedule(links, timelines), Optional(ElementsAre(seconds(60))));
  timelines.remove(1);
  links[0].preferred_start = seconds(45);  // 30 and 60 are equally near
  EXPECT_THAT(NearestScheduler().schedule(links, timelines), Optional(ElementsAre(seconds(30))));
}

TEST(NearestScheduler, PlacesWhatTheEarliestPlacesWhereNothingIsPreferredOrAttemptsEnd) {
  Timelines timelines = arm_and_heat();
  std::vector<Link> links{link(1, 10), link(2, 10)};
  EXPECT_THAT(NearestScheduler().schedule(links, timelines), Optional(ElementsAre(seconds(0), seconds(10))));
  timelines.remove(1);
  timelines.remove(2);
  links[1].preferred_start = seconds(70);
  EXPECT_THAT(NearestScheduler().schedule(links, timelines), Optional(ElementsAre(seconds(0), seconds(70))));
  timelines.remove(1);
  timelines.remove(2);
  EXPECT_THAT(NearestScheduler(1).schedule(links, timelines), Optional(ElementsAre(seconds(0), seconds(10))));
}

TEST(Schedulers, AnUnknownNameIsAnsweredWithThoseThereAre) {
  try {
    make_scheduler("latest");
    FAIL();
  } catch (const std::invalid_argument& fault) {
    EXPECT_STREQ(fault.what(), "there is no scheduler 'latest'; there are: earliest, nearest");
  }
}

// Random calendars of the arm in whole seconds: what permits a link does not depend on the links before it.
TEST(EarliestScheduler, FindsTheEarliestPlacementThatAnExhaustiveScanFinds) {
  int found = 0, missing = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    std::mt19937_64 random(seed);
    const auto up_to = [&](unsigned bound) { return static_cast<int>(random() % (bound + 1)); };
    Timelines timelines = arm_and_heat();
    std::vector<bool> busy(60);
    for (int block = 0; block < 4; ++block) {
      const int start = up_to(45), length = 1 + up_to(6);
      bool clear = true;
      for (int at = start; at < start + length; ++at) clear = clear && !busy[static_cast<std::size_t>(at)];
      if (!clear) continue;
      for (int at = start; at < start + length; ++at) busy[static_cast<std::size_t>(at)] = true;
      timelines.place(1000U + static_cast<unsigned>(block), of_arm(length), seconds(start));
    }
    std::vector<Link> links;
    for (std::uint64_t id = 1; id <= 3; ++id) {
      Link& added = links.emplace_back(link(id, 1 + up_to(8)));
      const int first = up_to(10);
      added.starts = {seconds(first), seconds(first + 5 + up_to(25))};
      added.shortest_gap = seconds(up_to(2));
      if (up_to(2) != 0) added.longest_gap = added.shortest_gap + seconds(up_to(3));
    }
    std::optional<std::vector<Time>> expected;
    std::vector<Time> starts;
    const std::function<void()> scan = [&] {
      const std::size_t at = starts.size();
      if (at == links.size()) {
        expected = expected ? std::min(*expected, starts) : starts;
        return;
      }
      for (int start = 0; start <= 40; ++start) {
        const Link& next = links[at];
        const auto length = static_cast<int>(roci::temporal::to_seconds(next.footprint.duration) + 0.5);
        bool fits = seconds(start) >= next.starts.earliest && seconds(start) <= next.starts.latest;
        for (int second = start; second < start + length; ++second)
          fits = fits && !busy[static_cast<std::size_t>(second)];
        if (at > 0) {
          const Duration gap = seconds(start) - starts.back() - links[at - 1].footprint.duration;
          fits = fits && gap >= next.shortest_gap && gap <= next.longest_gap;
        }
        if (!fits) continue;
        starts.push_back(seconds(start));
        scan();
        starts.pop_back();
      }
    };
    scan();
    ASSERT_EQ(EarliestScheduler().schedule(links, timelines), expected) << seed;
    ++(expected ? found : missing);
  }
  EXPECT_GT(found, 60);
  EXPECT_GT(missing, 50);
}

}  // namespace
