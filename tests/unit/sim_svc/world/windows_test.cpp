#include "sim_svc/world/windows.hpp"

#include <gtest/gtest.h>

namespace roci::sim::world {

using temporal::seconds;
using temporal::Time;

namespace {

using Intervals = std::vector<std::pair<Time, Time>>;

Intervals shut(double from, double until) {
  Window window{"w", {{seconds(10), seconds(20)}, {seconds(30), seconds(40)}}};
  window.shut(seconds(from), seconds(until));
  return window.open;
}

TEST(Windows, AreShutForATime) {
  const Intervals whole{{seconds(10), seconds(20)}, {seconds(30), seconds(40)}};
  EXPECT_EQ(shut(12, 15), (Intervals{{seconds(10), seconds(12)}, {seconds(15), seconds(20)}, whole[1]}));
  EXPECT_EQ(shut(5, 12), (Intervals{{seconds(12), seconds(20)}, whole[1]})) << "a late rise";
  EXPECT_EQ(shut(15, 20), (Intervals{{seconds(10), seconds(15)}, whole[1]}));
  EXPECT_EQ(shut(15, 35), (Intervals{{seconds(10), seconds(15)}, {seconds(35), seconds(40)}}));
  EXPECT_EQ(shut(0, 99), Intervals{});
  EXPECT_EQ(shut(20, 30), whole);
}

}  // namespace
}  // namespace roci::sim::world
