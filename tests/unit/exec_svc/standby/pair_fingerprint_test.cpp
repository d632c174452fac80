// Worlds with one fingerprint go on alike, whatever happens to them: walks at random meet in many of them, and then both
// take one way.
#include <gtest/gtest.h>

#include <iostream>
#include <random>
#include <unordered_map>

#include "tests/unit/exec_svc/standby/pair_events.hpp"

namespace roci::exec::testing {
namespace {

constexpr int kWalks = 400;
constexpr int kEvents = 24;       // of a walk
constexpr int kFollowedFor = 10;  // events after two have met

void happen(const Event& event, Course& course, int steps) {
  event.happen(course);
  course.world.run(steps * kStep);
}

TEST(PairFingerprint, WorldsThatHaveOneGoOnAlike) {
  Bounds bounds;
  bounds.cuts = bounds.kills = 100;
  std::minstd_rand random(7);
  const auto any_event = [&](const Course& course) -> const Event& {
    for (;;) {
      const Event& event = all_events()[random() % 3 == 0 ? random() % all_events().size() : 0];
      if (event.may(course, bounds)) return event;
    }
  };
  std::unordered_map<std::uint64_t, Course> seen;
  int met = 0;
  for (int walk = 0; walk < kWalks; ++walk) {
    Course course{new_pair(Bug::none)};
    for (int i = 0; i < kEvents; ++i) {
      happen(any_event(course), course, 1 + static_cast<int>(random() % 3));
      ASSERT_TRUE(course.world.faults.empty()) << course.world.faults.front();
      const auto [known, is_new] = seen.try_emplace(course.world.fingerprint(kOldest), course);
      if (is_new) continue;
      ++met;
      Course one = course, other = known->second;
      std::string way;
      for (int follow = 0; follow < kFollowedFor; ++follow) {
        const Event& event = any_event(one);
        const int steps = 1 + static_cast<int>(random() % 3);
        way += event.what + ", " + std::to_string(steps) + " steps; ";
        happen(event, one, steps);
        happen(event, other, steps);
        ASSERT_EQ(one.world.fingerprint(kOldest), other.world.fingerprint(kOldest)) << way;
        ASSERT_EQ(one.world.lost(), other.world.lost()) << way;
      }
    }
  }
  std::cout << seen.size() << " worlds, met again " << met << " times" << std::endl;
  EXPECT_GT(met, 1000);
}

}  // namespace
}  // namespace roci::exec::testing
