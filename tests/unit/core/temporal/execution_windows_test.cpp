#include "core/temporal/execution_windows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace roci::temporal {
namespace {

constexpr ConstraintKind kind = ConstraintKind::ordering;

/// Windows by repeated relaxation from scratch: points that have happened are given, edges into them do not
/// count.
struct Oracle {
  std::vector<TemporalConstraint> constraints;
  std::vector<std::optional<Time>> happened;
  std::vector<bool> dropped;

  std::vector<Window> windows() const {
    std::vector<Window> all(happened.size());
    for (std::size_t p = 0; p < happened.size(); ++p)
      if (happened[p]) all[p] = {*happened[p], *happened[p]};
    for (std::size_t round = 0; round < happened.size(); ++round)
      for (const TemporalConstraint& c : constraints) {
        if (dropped[c.from_point] || dropped[c.to_point]) continue;
        Window& from = all[c.from_point];
        Window& to = all[c.to_point];
        if (!happened[c.to_point]) {
          to.lower = std::max(to.lower, plus(from.lower, c.lower));
          if (bounded(c.upper)) to.upper = std::min(to.upper, plus(from.upper, c.upper));
        }
        if (!happened[c.from_point]) {
          from.upper = std::min(from.upper, plus(to.upper, -c.lower));
          if (bounded(c.upper)) from.lower = std::max(from.lower, plus(to.lower, -c.upper));
        }
      }
    return all;
  }
};

struct Network {
  std::vector<TemporalConstraint> constraints;
  std::size_t size;
};

Network random_network(std::mt19937_64& random) {
  Network network{{}, 2 + random() % 10};
  Stn stn(network.size);
  const auto try_add = [&](TemporalConstraint c) {
    if (stn.add(c.from_point, c.to_point, c.lower, c.upper)) network.constraints.push_back(c);
  };
  for (TimePoint p = 1; p < network.size; ++p) try_add({0, p, kind, Duration{0}, no_bound});
  for (std::uint64_t i = random() % (4 * network.size); i > 0; --i) {
    const auto from = static_cast<TimePoint>(random() % network.size);
    const auto to = static_cast<TimePoint>(random() % network.size);
    const Duration lower{static_cast<int>(random() % 40) - 10};
    if (from != to)
      try_add({from, to, kind, lower, random() % 2 ? lower + Duration{random() % 20} : no_bound});
  }
  return network;
}

TEST(ExecutionWindows, LateEventMovesWhatFollowsAndNothingBreaks) {
  ExecutionWindows windows(4,
                           {{0, 1, kind, Duration{0}, no_bound},
                            {1, 2, kind, Duration{100}, Duration{100}},
                            {2, 3, kind, Duration{1}, Duration{50}},
                            {0, 3, kind, Duration{0}, Duration{300}}},
                           Time{1000});
  EXPECT_EQ(windows.window(3), (Window{Time{1101}, Time{1300}}));
  windows.happen(1, Time{1000});
  EXPECT_EQ(windows.window(3), (Window{Time{1101}, Time{1150}}));
  windows.happen(2, Time{1103});
  EXPECT_EQ(windows.window(3), (Window{Time{1104}, Time{1153}}));
  windows.undo_happen(2);
  EXPECT_EQ(windows.window(3), (Window{Time{1101}, Time{1150}}));
  windows.set_bounds(1, Duration{100}, no_bound);
  EXPECT_EQ(windows.window(3), (Window{Time{1101}, Time{1300}}));
  windows.drop(2);
  EXPECT_EQ(windows.window(3), (Window{Time{1000}, Time{1300}}));
}

TEST(ExecutionWindowsProperty, EveryOperationAgreesWithRelaxationFromScratch) {
  std::mt19937_64 random(5);
  for (int run = 0; run < 4000; ++run) {
    const Network network = random_network(random);
    ExecutionWindows windows(network.size, network.constraints, Time{0});
    Oracle oracle{network.constraints, std::vector<std::optional<Time>>(network.size),
                  std::vector<bool>(network.size)};
    oracle.happened[0] = Time{0};
    for (TimePoint p = 1; p < network.size; ++p) {
      const std::uint64_t action = random() % 5;
      const std::size_t chosen = network.constraints.empty() ? 0 : random() % network.constraints.size();
      if (action == 0) {
        windows.drop(p);
        oracle.dropped[p] = true;
      } else if (action == 1) {
        windows.happen(p, Time{static_cast<int>(random() % 200)});
        windows.undo_happen(p);
      } else if (action <= 3) {
        const Time at{static_cast<int>(random() % 200)};
        windows.happen(p, at);
        oracle.happened[p] = at;
      }
      TemporalConstraint& c = oracle.constraints[chosen];
      if (oracle.happened[c.from_point] && !oracle.happened[c.to_point] && !oracle.dropped[c.to_point]) {
        c.lower = Duration{static_cast<int>(random() % 50)};
        c.upper = random() % 2 ? no_bound : c.lower + Duration{random() % 30};
        windows.set_bounds(chosen, c.lower, c.upper);
      }
      const std::vector<Window> expected = oracle.windows();
      for (TimePoint q = 0; q < network.size; ++q)
        ASSERT_TRUE(oracle.dropped[q] || windows.window(q) == expected[q]) << "run " << run << " point " << q;
    }
  }
}

/// Asking for few windows, now and then, is what leaves most of them unknown.
TEST(ExecutionWindowsProperty, WindowsAskedForNowAndThenAgreeWithRelaxationFromScratch) {
  std::mt19937_64 random(7);
  for (int run = 0; run < 6000; ++run) {
    const Network network = random_network(random);
    ExecutionWindows windows(network.size, network.constraints, Time{0});
    Oracle oracle{network.constraints, std::vector<std::optional<Time>>(network.size),
                  std::vector<bool>(network.size)};
    oracle.happened[0] = Time{0};
    for (TimePoint p = 1; p < network.size; ++p) {
      const std::uint64_t action = random() % 8;
      const Time at{static_cast<int>(random() % 200)};
      if (action == 0) {
        windows.drop(p);
        oracle.dropped[p] = true;
      } else {
        windows.happen(p, at);
        const auto asked = static_cast<TimePoint>(random() % network.size);
        if (random() % 2 == 0) static_cast<void>(windows.window(asked));
        if (random() % 8 == 0) windows.settle();
        if (action == 1) {
          windows.undo_happen(p);
        } else {
          oracle.happened[p] = at;
        }
      }
      if (!network.constraints.empty()) {
        const std::size_t chosen = random() % network.constraints.size();
        TemporalConstraint& c = oracle.constraints[chosen];
        if (oracle.happened[c.from_point] && !oracle.happened[c.to_point] && !oracle.dropped[c.to_point]) {
          c.lower = Duration{static_cast<int>(random() % 50)};
          c.upper = random() % 2 ? no_bound : c.lower + Duration{random() % 30};
          windows.set_bounds(chosen, c.lower, c.upper);
        }
      }
      if (random() % 8 == 0) windows.settle();
      const std::vector<Window> expected = oracle.windows();
      for (std::uint64_t asked = random() % 3; asked > 0; --asked) {
        const auto q = static_cast<TimePoint>(random() % network.size);
        ASSERT_TRUE(oracle.dropped[q] || windows.window(q) == expected[q]) << "run " << run << " point " << q;
      }
    }
  }
}

TEST(ExecutionWindowsProperty, ReportsEveryKnownWindowThatMoved) {
  std::mt19937_64 random(6);
  for (int run = 0; run < 2000; ++run) {
    const Network network = random_network(random);
    ExecutionWindows windows(network.size, network.constraints, Time{0});
    for (TimePoint p = 1; p < network.size; ++p) {
      std::vector<Window> before(network.size);
      for (TimePoint q = 0; q < network.size; ++q) before[q] = windows.window(q);
      windows.happen(p, Time{static_cast<int>(random() % 200)});
      const auto told = [](const std::vector<LazyShortestPaths::Change>& changes, TimePoint point, Duration value) {
        return std::any_of(changes.begin(), changes.end(), [&](const LazyShortestPaths::Change& change) {
          return change.point == point && change.before == value;
        });
      };
      for (TimePoint q = 0; q < network.size; ++q) {
        if (q == p) continue;
        const Window after = windows.window(q);
        ASSERT_TRUE(after.upper == before[q].upper || told(windows.latest_changes(), q, before[q].upper));
        ASSERT_TRUE(after.lower == before[q].lower || told(windows.earliest_changes(), q, -before[q].lower));
      }
    }
  }
}

}  // namespace
}  // namespace roci::temporal
