#include "bench/europa/cycles/sized_network.hpp"

#include <gtest/gtest.h>

namespace roci::bench::europa {
namespace {

const std::filesystem::path kMission = ROCI_SOURCE_DIR "/missions/europa";

std::size_t requests(const planner::utility_htn::model::Network& network, const std::string& prefix) {
  return static_cast<std::size_t>(std::ranges::count_if(
      network.tasks, [&](const auto& task) { return !task.is_template && task.id.starts_with(prefix); }));
}

TEST(SizedNetwork, GrowsInSitesTargetsAndAllThatPaysForThem) {
  const auto mission = sized_network(kMission, 3, 3), twice = sized_network(kMission, 6, 4);
  EXPECT_EQ(twice.subway.sites.size(), 6U);
  EXPECT_EQ(twice.subway.sites.back().targets.size(), 4U);
  EXPECT_EQ(requests(twice, "sample_"), 24U);
  EXPECT_EQ(requests(twice, "site_block_"), 6U);
  EXPECT_EQ(requests(twice, "earth_view_"), 2 * requests(mission, "earth_view_"));
  EXPECT_EQ(requests(mission, "p_uplink_"), 24U);
  EXPECT_EQ(requests(twice, "p_uplink_"), 52U);
  EXPECT_EQ(twice.cycle.plan_end, 2 * mission.cycle.plan_end);
  EXPECT_NEAR(twice.timelines[twice.budget].initial, 2 * mission.timelines[mission.budget].initial, 1);
}

TEST(SizedNetwork, RefusesATextThatItDoesNotKnow) {
  EXPECT_THROW(sized_network(ROCI_SOURCE_DIR "/missions/planetary", 5, 5), std::runtime_error);
}

}  // namespace
}  // namespace roci::bench::europa
