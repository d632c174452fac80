// Any sequence of calls on timelines: what cannot be is refused by an exception that the header names,
// and nothing else changes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <vector>

#include "core/temporal/timelines/timelines.hpp"
#include "tests/fuzz/rounds.hpp"

namespace roci::fuzz {
namespace {

using temporal::Duration, temporal::ImpactKind, temporal::ImpactWhen, temporal::Time;
using temporal::timelines::Conflict, temporal::timelines::Definition, temporal::timelines::Extent,
    temporal::timelines::Footprint, temporal::timelines::Index, temporal::timelines::Kept,
    temporal::timelines::Kind, temporal::timelines::kLastTime, temporal::timelines::Phase,
    temporal::timelines::TaskId, temporal::timelines::Timelines, temporal::timelines::Vertex;

constexpr Index kLines = 5;

std::vector<Definition> lines() {
  return {{.name = "arm", .kind = Kind::atomic},
          {.name = "phase", .kind = Kind::state, .states = {"a", "b", "c"}},
          {.name = "power", .kind = Kind::claimable, .highest = 10},
          {.name = "stored", .kind = Kind::cumulative, .lowest = -5, .highest = 1e15},
          {.name = "battery", .kind = Kind::cumulative_rate, .initial = 100, .lowest = 0}};
}

class Caller {
 public:
  explicit Caller(std::uint64_t seed)
      : random_(seed), timelines_(lines(), Extent{.most_impacts = 60, .block = 1 + seed % 9}) {}

  /// Makes one call. Returns whether it was taken.
  bool call() {
    const Kept before = timelines_.kept();
    try {
      act();
      return true;
    } catch (const std::invalid_argument&) {
    } catch (const std::length_error&) {
    } catch (const std::out_of_range&) {
    } catch (const std::logic_error&) {
    }
    EXPECT_EQ(timelines_.kept(), before) << "what is refused changes nothing";
    return false;
  }

 private:
  int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  std::int64_t time() {
    constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
    constexpr std::int64_t kEdges[]{kMost, -kMost - 1, kLastTime.count(), -kLastTime.count(), 0, -1};
    if (between(1, 30) == 1) return kEdges[between(0, 5)];
    return between(1, 10) == 1 ? std::int64_t{1'000'000} * between(0, 1'000'000) : between(0, 300);
  }
  double number() {
    constexpr double kOdd[]{std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity(),
                            -1e15,
                            1e15,
                            1e-12,
                            1e300,
                            -1e9,
                            1e9};
    return between(1, 12) == 1 ? kOdd[between(0, 7)] : between(-4, 8) / 2.0;
  }
  Index line() { return static_cast<Index>(between(1, 40) == 1 ? kLines : between(0, kLines - 1)); }
  Footprint footprint() {
    Footprint footprint{Duration{between(1, 8) == 1 ? 0 : time()}, {}, {}};
    for (int i = between(0, 3); i > 0; --i)
      footprint.impacts.push_back({line(), static_cast<ImpactKind>(between(0, 2)),
                                   static_cast<ImpactWhen>(between(0, 2)),
                                   between(0, 1) == 1 ? 1 : number()});
    for (int i = between(0, 2); i > 0; --i)
      footprint.constraints.push_back({line(), static_cast<Phase>(between(0, 2)), number(), number() + 3,
                                       static_cast<std::uint64_t>(between(0, 8))});
    return footprint;
  }
  TaskId task() { return static_cast<TaskId>(between(0, 30)); }

  void act() {
    switch (between(0, 9)) {
      case 0:
      case 1:
      case 2:
        return timelines_.place(task(), footprint(), Time{time()});
      case 3:
        return timelines_.move(task(), Time{time()}, Time{time()});
      case 4:
        return timelines_.remove(task());
      case 5:
        if (between(0, 4) == 0) static_cast<void>(timelines_.observe(line(), Time{time()}, number()));
        return;
      case 6:
        if (between(0, 9) == 0) timelines_.consolidate(timelines_.past() + Duration{between(-5, 60)});
        return;
      case 7:
        mark_ = timelines_.mark();
        return;
      case 8:
        return timelines_.undo(mark_);
      default:
        return look();
    }
  }

  void look() {
    const Time from{time()};
    const Time to{time()};
    for (const Conflict& it : timelines_.conflicts(from, to)) EXPECT_LE(it.from, it.to);
    const Index line = this->line();
    EXPECT_TRUE(std::isfinite(timelines_.value(line, from)));
    for (const Vertex& corner : timelines_.trajectory(line, from, to))
      EXPECT_TRUE(std::isfinite(corner.value));
    const Footprint footprint = this->footprint();
    const auto valid = timelines_.valid_starts(footprint, {from, to});
    for (std::size_t i = 0; i < valid.size(); ++i) {
      EXPECT_LE(valid[i].earliest, valid[i].latest);
      EXPECT_GE(valid[i].earliest, std::max(from, timelines_.past()));
      EXPECT_LE(valid[i].latest, to);
      const Time nearest = i > 0 ? valid[i - 1].latest + Duration{1} : Time::min();
      EXPECT_GT(valid[i].earliest, nearest);
    }
    const auto first = timelines_.first_valid_start(footprint, {from, to});
    EXPECT_EQ(first, valid.empty() ? std::nullopt : std::optional(valid.front().earliest));
  }

  std::mt19937_64 random_;
  Timelines timelines_;
  std::size_t mark_ = 0;
};

TEST(TimelineFuzz, AnyCallsAreTakenOrRefused) {
  int taken = 0;
  const int worlds = rounds(60);
  for (int seed = 0; seed < worlds && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Caller caller(static_cast<std::uint64_t>(seed));
    for (int i = 0; i < 1000; ++i) taken += caller.call() ? 1 : 0;
  }
  EXPECT_GT(taken, worlds * 300);
}

}  // namespace
}  // namespace roci::fuzz
