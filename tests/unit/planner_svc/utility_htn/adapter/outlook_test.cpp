// What the engine tells of its plan beside the plan: the downlink schedule, utility by rank, energy,
// the subway map (R110–R115, R127).
#include "planner_svc/utility_htn/adapter/outlook.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/planner_svc/utility_htn/adapter/outlook_fixture.hpp"

namespace roci::planner::utility_htn::adapter {
namespace {

using engine::ChainStage, engine::DataTier, engine::SignatureOutcome, engine::StepInputs;
using temporal::ActivityState, temporal::Time;
using ::testing::DoubleNear, ::testing::ElementsAre, ::testing::Field, ::testing::HasSubstr,
    ::testing::IsEmpty, ::testing::Not, ::testing::SizeIs;

TEST_F(OutlookTest, TheScheduleNamesActivitiesOfThePlanAndPlannedDataByTheNetwork) {
  start();
  ASSERT_TRUE(schedule_.limited);
  EXPECT_THAT(schedule_.ranks, ElementsAre(Field(&engine::UtilityRank::name, "science")));
  EXPECT_THAT(schedule_.ranks.front().meaning, HasSubstr("picture"));
  ASSERT_THAT(schedule_.downlinks, Not(IsEmpty()));
  std::uint64_t bytes = 0;
  for (const engine::ScheduledDownlink& one : schedule_.downlinks) {
    const auto planned = std::ranges::find(plan_.activities, one.activity, &temporal::PlanActivity::id);
    ASSERT_NE(planned, plan_.activities.end()) << one.activity;
    EXPECT_EQ(one.end - one.start, temporal::seconds(300));
    EXPECT_EQ(one.takes, temporal::seconds(static_cast<double>(one.bytes) / 10));
    for (const engine::ScheduledProduct& data : one.products) {
      EXPECT_FALSE(data.exists);
      EXPECT_THAT(data.id, HasSubstr("/picture"));
      bytes += data.bytes;
    }
  }
  EXPECT_EQ(bytes,
            1000U * static_cast<std::uint64_t>(std::ranges::count_if(
                        plan_.activities, [](const auto& one) { return one.name.starts_with("image_"); })));
}

TEST_F(OutlookTest, DataThatExistGoUnderTheirOwnIdAndByTier) {
  start();
  engine::DataProduct late = picture("dp-2", "nobody#1.0");
  engine::DataProduct first = picture("dp-1", "nobody#1.0");
  late.tier = DataTier::mandatory;
  late.utility = {0.9};
  first.tier = DataTier::decisional;
  first.utility = {0.1};
  StepInputs inputs;
  inputs.products = {late, first};
  now_ += temporal::seconds(60);
  step(std::move(inputs));
  const engine::ScheduledDownlink& next = schedule_.downlinks.front();
  std::vector<std::string> going;
  for (const engine::ScheduledProduct& one : next.products)
    if (one.exists) going.push_back(one.id);
  EXPECT_THAT(going, ElementsAre("dp-1", "dp-2"));
  EXPECT_EQ(next.products.front().tier, DataTier::decisional);
}

TEST_F(OutlookTest, WhatHasNoRoomIsLeftOutWithItsReason) {
  start();
  engine::DataProduct huge = picture("huge", "nobody#1.0");
  huge.bytes = 3001;
  now_ += temporal::seconds(60);
  hear(huge);
  ASSERT_THAT(schedule_.left_out, SizeIs(1));
  EXPECT_EQ(schedule_.left_out.front().data.id, "huge");
  EXPECT_EQ(schedule_.left_out.front().data.bytes, 3001U);
  EXPECT_TRUE(schedule_.left_out.front().data.exists);
  EXPECT_THAT(schedule_.left_out.front().why, Not(IsEmpty()));
}

TEST_F(OutlookTest, WithoutARateNothingIsScheduled) {
  model::Network network = imaging_lander();
  std::ranges::find(network.parameters, "rate_bytes_per_s", &model::Parameter::name)->name = "another_rate";
  start(std::move(network));
  EXPECT_FALSE(schedule_.limited);
  EXPECT_THAT(schedule_.downlinks, IsEmpty());
  EXPECT_THAT(schedule_.ranks, SizeIs(1));
}

TEST_F(OutlookTest, ACycleInWhichNothingHasChangedTellsNothing) {
  model::Network network = imaging_lander();
  for (model::Task& task : network.tasks) task.opens = std::max(task.opens, temporal::seconds(3600));
  start(std::move(network));
  const int told = told_;
  EXPECT_EQ(told, 2);
  for (int cycle = 0; cycle < 5; ++cycle) advance_to(now_ + temporal::seconds(60));
  EXPECT_EQ(told_, told);
  hear(picture("dp-1", "nobody#1.0"));  // between two cycles
  advance_to(now_ + temporal::seconds(60));
  EXPECT_EQ(told_, told + 2);
}

TEST_F(OutlookTest, NewDataAreToldWhereThePlanIsNeverMadeBetter) {
  model::Network network = imaging_lander();
  for (model::Task& task : network.tasks) task.opens = std::max(task.opens, temporal::seconds(3600));
  start(std::move(network), {.optimizes = false});
  now_ += temporal::seconds(60);
  hear(picture("dp-1", "nobody#1.0"));
  EXPECT_EQ(outlook_.products.front().data.id, "dp-1");
}

TEST_F(OutlookTest, DataWithoutAWorthOfTheirOwnTakeThatOfTheirProduct) {
  start();
  const std::string image = activity("image_near");
  now_ += temporal::seconds(60);
  hear(picture("dp-1", image));
  const auto told = std::ranges::find(outlook_.products, "dp-1",
                                      [](const engine::ProductOutlook& one) { return one.data.id; });
  ASSERT_NE(told, outlook_.products.end());
  EXPECT_EQ(told->request, "sample_near");
  EXPECT_EQ(told->predicted, (temporal::RankVector{0.3}));
  EXPECT_EQ(told->executed, (temporal::RankVector{0.3}));
  EXPECT_EQ(chain("sample_near").executed, (temporal::RankVector{0.3}));
  EXPECT_THAT(outlook_.received.scores(), IsEmpty());
  engine::DataProduct home = picture("dp-1", image);
  home.utility = {0.7};
  home.fate = engine::DataFate::received;
  now_ += temporal::seconds(60);
  hear(home);
  EXPECT_EQ(outlook_.received, (temporal::RankVector{0.7}));
}

// The owner tells of data before the executive tells that the task is over, and a cycle may lie between.
TEST_F(OutlookTest, DataThatAreThereAreNotPromisedAnyMore) {
  start();
  const std::string image = activity("image_near");
  for (const char* const task : {"dig_near", "image_near"}) {
    const auto begins = std::ranges::find(outlook_.energy, activity(task), &engine::EnergyPoint::activity);
    ASSERT_NE(begins, outlook_.energy.end()) << task;
    const Time end = begins->at;
    const Time begin = end - (std::string(task) == "dig_near" ? temporal::seconds(900) : temporal::seconds(120));
    advance_to(begin);
    execute(activity(task), ActivityState::running, begin, std::nullopt);
    if (activity(task) == image) break;
    now_ = end;
    execute(activity(task), ActivityState::succeeded, begin, end);
  }
  const auto promised = [&] {
    std::size_t out = 0;
    for (const engine::ScheduledDownlink& one : schedule_.downlinks)
      out += static_cast<std::size_t>(std::ranges::count(one.products, "sample_near/image_near/picture",
                                                         &engine::ScheduledProduct::id));
    return out;
  };
  ASSERT_EQ(promised(), 1U);
  now_ += temporal::seconds(60);
  hear(picture("dp-1", image));
  EXPECT_EQ(promised(), 0U);
}

TEST_F(OutlookTest, ChainsTellWhatTheyCostAndHowTheyStandAndStayWhenTheyHaveEnded) {
  start();
  EXPECT_EQ(chain("view").stage, ChainStage::planned);
  EXPECT_EQ(chain("view").predicted, (temporal::RankVector{0.1}));
  EXPECT_NEAR(chain("view").cost_j, 120 * 40 + 300 * 100, 1e-6);
  for (const char* const task : {"look", "send_view"}) {
    const std::string id = activity(task);
    advance_to(std::max(now_, chain("view").start) + temporal::seconds(60));
    execute(id, ActivityState::running, now_, std::nullopt);
    EXPECT_EQ(chain("view").request, "view");
    now_ += temporal::seconds(60);
    execute(id, ActivityState::succeeded, now_ - temporal::seconds(60), now_);
  }
  advance_to(now_ + temporal::seconds(60));
  EXPECT_EQ(chain("view").stage, ChainStage::done);
  EXPECT_EQ(chain("view").predicted, (temporal::RankVector{0.1})) << "as before it began";
}

TEST_F(OutlookTest, EnergyIsForeseenAtTheEndOfEachTaskWithMoreAndLessThanPredicted) {
  start();
  EXPECT_EQ(outlook_.budget, "lander.battery");
  EXPECT_EQ(outlook_.capacity_j, 600000);
  ASSERT_GT(outlook_.energy.size(), 3U);
  EXPECT_EQ(outlook_.energy.front().at, now_);
  EXPECT_EQ(outlook_.energy.front().predicted_j, 600000);
  std::size_t ends = 0;
  for (const engine::EnergyPoint& point : outlook_.energy) ends += point.activity.empty() ? 0 : 1;
  EXPECT_EQ(ends, 9U) << "each of the nine tasks";
  EXPECT_GT(outlook_.energy.size(), ends + 1) << "and starts behind a gap";
  for (std::size_t i = 1; i < outlook_.energy.size(); ++i) {
    const engine::EnergyPoint& point = outlook_.energy[i];
    const double spent = 600000 - point.predicted_j;
    EXPECT_GT(point.at, outlook_.energy[i - 1].at);
    if (point.activity.empty()) {
      EXPECT_EQ(point.predicted_j, outlook_.energy[i - 1].predicted_j) << "nothing is spent between tasks";
    }
    EXPECT_THAT(point.worst_j, DoubleNear(600000 - 1.1 * spent, 1e-6));
    EXPECT_THAT(point.best_j, DoubleNear(600000 - 0.9 * spent, 1e-6));
  }
  double cost = 0;
  for (const engine::ChainOutlook& one : outlook_.chains) cost += one.cost_j;
  EXPECT_NEAR(outlook_.energy.back().predicted_j, 600000 - cost, 1e-3);
}

// Predicts the same of every chain.
class OneWorth final : public assessor::Assessor {
 public:
  temporal::RankVector predicted(std::uint32_t, const assessor::Context&) const override { return {worth}; }
  temporal::RankVector most(std::uint32_t, const assessor::Context&) const override { return {worth}; }
  bool contextual(std::uint32_t, const assessor::Context&) const override { return false; }
  double worth = 0.25;
};

TEST(OutlookOfChains, KeepsWhatWasPredictedBeforeTheyBegan) {
  const model::Network network = imaging_lander();
  const flattening::Chains chains = flattening::flatten_all(network);
  OneWorth assessor;
  const auto scheduler = search::make_scheduler("nearest");
  cycle::Cycle cycle(network, chains, assessor, *scheduler, Time{0});
  const delivery::Delivery delivery(network);
  const Situation situation{network, chains, assessor, cycle, delivery, Time{0}};
  Outlooks outlooks;
  cycle.run(Time{0});
  ASSERT_THAT(cycle.blocks(), SizeIs(::testing::Gt(1U)));
  for (const engine::ChainOutlook& one : outlooks.make(situation).chains)
    EXPECT_EQ(one.predicted, (temporal::RankVector{0.25}));
  const cycle::Block first = cycle.blocks().front();
  cycle.begun(cycle::task_id(first.number, 0), first.links.front().start);
  assessor.worth = 0.5;
  for (const engine::ChainOutlook& one : outlooks.make(situation).chains)
    EXPECT_EQ(one.predicted, (temporal::RankVector{one.block == first.number ? 0.25 : 0.5})) << one.request;
}

TEST(OutlookOfTheSubwayMap, SitesGoByChanceAndTargetsTellTheirOutcomes) {
  const model::Network network = reading::load_network(ROCI_SOURCE_DIR "/missions/europa/network-rsm1.yaml");
  const flattening::Chains chains = flattening::flatten_all(network);
  const assessor::NetworkAssessor assessor;
  const auto scheduler = search::make_scheduler("earliest");
  cycle::Cycle cycle(network, chains, assessor, *scheduler, Time{0});
  const delivery::Delivery delivery(network);
  Outlooks outlooks;
  const model::Site& second = network.subway.sites.at(1);
  cycle.observe(second.targets.at(0).signature, temporal::seconds(1), 2);
  const engine::MissionOutlook told =
      outlooks.make({network, chains, assessor, cycle, delivery, temporal::seconds(2)});
  ASSERT_THAT(told.sites, SizeIs(network.subway.sites.size()));
  for (std::size_t i = 1; i < told.sites.size(); ++i)
    EXPECT_GE(told.sites[i - 1].chance, told.sites[i].chance);
  const auto line = std::ranges::find(told.sites, second.name, &engine::SubwaySite::name);
  ASSERT_NE(line, told.sites.end());
  EXPECT_GT(line->chance, line->by_vision) << "one sample was positive";
  EXPECT_EQ(line->targets.at(0).outcome, SignatureOutcome::positive);
  EXPECT_EQ(line->targets.at(1).outcome, SignatureOutcome::unknown);
  EXPECT_NEAR(line->targets.at(1).estimated, line->targets.at(1).visual * line->chance, 1e-12);
  EXPECT_TRUE(std::ranges::any_of(
      line->targets, [&](const engine::SubwayTarget& target) { return target.task == told.next_target; }))
      << "a site that is begun goes on: " << told.next_target;
  EXPECT_EQ(told.most_samples, network.subway.most_samples);
}

}  // namespace
}  // namespace roci::planner::utility_htn::adapter
