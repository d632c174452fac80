// A schedule and an outlook on the wire: bounded, and what has no room is counted.
#include <gtest/gtest.h>

#include <string>

#include "planner_svc/limits.hpp"
#include "planner_svc/outlook_wire_service.hpp"
#include "services/transport/payload_limit.hpp"
#include "services/transport/type_support.hpp"

namespace roci::planner {
namespace {

TEST(OutlookOnTheWire, HoldsWhatTheEngineTold) {
  engine::DownlinkSchedule schedule;
  schedule.limited = true;
  schedule.ranks = {{"science", "everything"}};
  schedule.downlinks.push_back({"send#1.0",
                                temporal::seconds(10),
                                temporal::seconds(40),
                                300,
                                temporal::seconds(30),
                                1.5,
                                {{"dp", true, 300, engine::DataTier::decisional}}});
  schedule.left_out = {{{"raw", false, 9, engine::DataTier::residual}, "no room"}};
  const v1::DownlinkSchedule told = to_wire(schedule);
  ASSERT_EQ(told.downlinks().size(), 1U);
  EXPECT_EQ(told.downlinks()[0].end_us(), 40'000'000);
  EXPECT_EQ(told.downlinks()[0].takes_us(), 30'000'000);
  ASSERT_EQ(told.downlinks()[0].products().size(), 1U);
  EXPECT_EQ(told.downlinks()[0].products()[0].tier(), v1::TIER_DECISIONAL);
  EXPECT_TRUE(told.downlinks()[0].products()[0].exists());
  ASSERT_EQ(told.left_out().size(), 1U);
  EXPECT_EQ(told.left_out()[0].why(), "no room");
  EXPECT_EQ(told.omitted(), 0U);
}

TEST(OutlookOnTheWire, CountsWhatHasNoRoom) {
  engine::DownlinkSchedule schedule;
  constexpr std::size_t kMany = 20'000;
  schedule.left_out.assign(
      kMany, {{std::string(1'000, 'x'), true, 1, engine::DataTier::mandatory}, std::string(10'000, 'y')});
  const v1::DownlinkSchedule told = to_wire(schedule);
  EXPECT_GT(told.omitted(), 0U);
  EXPECT_EQ(told.left_out().size() + told.omitted(), kMany);
  EXPECT_EQ(told.left_out().front().why().size(), kReasonBytes);
  EXPECT_LT(services::transport::serialize(told).size(),
            services::transport::bytes(services::transport::PayloadLimit::batch));
  engine::MissionOutlook outlook;
  outlook.products.resize(100'000);
  for (engine::ProductOutlook& one : outlook.products) {
    one.data.id = std::string(100, 'p');
    one.predicted = one.executed = temporal::RankVector(std::vector<double>(16, 1.0));
  }
  const v1::MissionOutlook bounded = to_wire(outlook);
  EXPECT_EQ(bounded.products().size() + bounded.omitted(), 100'000U);
  EXPECT_GT(bounded.omitted(), 0U);
  EXPECT_LT(services::transport::serialize(bounded).size(),
            services::transport::bytes(services::transport::PayloadLimit::batch));
}

}  // namespace
}  // namespace roci::planner
