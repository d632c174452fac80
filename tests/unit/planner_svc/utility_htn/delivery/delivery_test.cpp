// Downlinks as the planning cycle asks for them: data without a downlink are not generated,
// tiers go in their order, limits are kept.
#include "planner_svc/utility_htn/delivery/delivery.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <tuple>

#include "planner_svc/utility_htn/cycle/cycle.hpp"
#include "planner_svc/utility_htn/delivery/first_fit.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"
#include "tests/unit/planner_svc/utility_htn/delivery/delivery_fixture.hpp"

namespace roci::planner::utility_htn::delivery {
namespace {

using namespace std::chrono_literals;
using model::Tier;
using temporal::Time;
using ::testing::Contains, ::testing::ElementsAre, ::testing::IsEmpty, ::testing::Not, ::testing::SizeIs;
using testing::task_named, testing::toy_network;

TEST_F(DeliveryTest, WhatADownlinkCanCarryIsPlanned) {
  EXPECT_THAT(planned(), ElementsAre("idle", "sample", "view"));
  EXPECT_GT(delivery_->counts().first_fit, 0U);
  const Schedule plan = schedule();
  ASSERT_THAT(plan.downlinks, SizeIs(2));
  EXPECT_THAT(plan.left_out, IsEmpty());
  std::uint64_t bytes = 0;
  for (const Downlink& one : plan.downlinks) bytes += one.bytes;
  EXPECT_EQ(bytes, 150U);
}

TEST_F(DeliveryTest, DataForWhichNoDownlinkHasRoomAreNotGenerated) {
  task("dig").products.front().bytes = {201};
  EXPECT_THAT(planned(), ElementsAre("idle", "view"));
}

TEST_F(DeliveryTest, WithoutARateAllDataGetHome) {
  network_.parameters.pop_back();
  task("dig").products.front().bytes = {1e9};
  EXPECT_THAT(planned(), ElementsAre("idle", "sample", "view"));
}

TEST_F(DeliveryTest, ResidualDataAreNoReasonNotToPlan) {
  task("dig").products = {{"summary", Tier::decisional, {100}, {1}}, {"raw", Tier::residual, {1000}, {1}}};
  EXPECT_THAT(planned(), ElementsAre("idle", "sample", "view"));
  const Schedule plan = schedule();
  ASSERT_THAT(plan.left_out, SizeIs(1));
  EXPECT_EQ(plan.left_out.front().product, "sample/dig/raw");
  EXPECT_THAT(plan.left_out.front().why, Not(IsEmpty()));
}

// 200 bytes in 20 s. What was sent has left the store and taken its time all the same.
TEST_F(DeliveryTest, ADownlinkThatRunsHasOnlyWhatIsLeftOfItsTime) {
  task("dig").products.clear();
  start();
  delivery_->hear(stored("first", Tier::mandatory, 120));
  delivery_->hear(stored("second", Tier::mandatory, 80));
  planned();
  const search::PlannedData all = cycle_->data();
  search::PlannedData one{{}, {all.downlinks.front()}, 0, 0};
  const Time begun = one.downlinks.front().start;
  const auto sent = [&](Time now) {
    return delivery_->schedule(one, cycle_->past().values, now).downlinks.front().products;
  };
  EXPECT_THAT(sent(begun), ElementsAre("first", "second"));
  EXPECT_THAT(sent(begun + 10s), ElementsAre("first", "second")) << "it is in the middle of the first";
  Existing first = stored("first", Tier::mandatory, 120);
  first.fate = Fate::sent;
  delivery_->hear(first, begun + 12s);
  Existing more = stored("more", Tier::mandatory, 120);
  more.data.created = begun + 13s;
  delivery_->hear(more);
  EXPECT_THAT(sent(begun + 13s), ElementsAre("second"));
}

TEST_F(DeliveryTest, WhatIsBeingSentKeepsItsRoomThoughItTakesLongerThanIsLeft) {
  task("dig").products.clear();
  start();
  delivery_->hear(stored("first", Tier::mandatory, 120));
  delivery_->hear(stored("second", Tier::mandatory, 80));
  delivery_->hear(stored("left over", Tier::residual, 60));
  planned();
  const search::PlannedData one{{}, {cycle_->data().downlinks.front()}, 0, 0};
  const Time begun = one.downlinks.front().start;
  delivery_->told({{one.downlinks.front().id, {"first", "second"}}});
  Existing first = stored("first", Tier::mandatory, 120);
  first.fate = Fate::sent;
  delivery_->hear(first, begun + 13s);  // 70 bytes are left, 80 are being sent
  const Schedule plan = delivery_->schedule(one, cycle_->past().values, begun + 14s);
  EXPECT_THAT(plan.downlinks.front().products, ElementsAre("second"));
  EXPECT_EQ(plan.downlinks.front().bytes, 80U);
  EXPECT_EQ(plan.downlinks.front().takes, 8s);
  ASSERT_THAT(plan.left_out, SizeIs(1));
  EXPECT_EQ(plan.left_out.front().product, "left over");
  EXPECT_TRUE(plan.products.at("second").exists);
}

// The same for a planner that was started while the radio sends: what was sent before, and when,
// it hears from who keeps the data.
TEST_F(DeliveryTest, APlannerThatIsStartedWithinADownlinkKnowsWhatIsBeingSent) {
  task("dig").products.clear();
  start();
  planned();
  const search::PlannedData one{{}, {cycle_->data().downlinks.front()}, 0, 0};
  const Time begun = one.downlinks.front().start;
  delivery_->hear(stored("too large", Tier::mandatory, 500, 9));
  delivery_->hear(stored("second", Tier::mandatory, 80));
  delivery_->hear(stored("left over", Tier::residual, 60));
  Existing first = stored("first", Tier::mandatory, 120);
  first.fate = Fate::sent;
  delivery_->hear(first, begun + 13s);  // 70 bytes are left, 80 are being sent
  const Schedule plan = delivery_->schedule(one, cycle_->past().values, begun + 14s);
  EXPECT_THAT(plan.downlinks.front().products, ElementsAre("second"));
  EXPECT_EQ(plan.downlinks.front().takes, 8s);
  std::vector<std::string> left_out;
  for (const Unsent& each : plan.left_out) left_out.push_back(each.product);
  EXPECT_THAT(left_out, ::testing::UnorderedElementsAre("too large", "left over"));
}

TEST_F(DeliveryTest, TiersGoInTheirOrderWhenThereIsTooLittleRoom) {
  network_.parameters.back().prior = 5;  // 100 bytes in each of the two downlinks
  task("dig").products.clear();
  start();
  delivery_->hear(stored("left over", Tier::residual, 60, 9));
  delivery_->hear(stored("until the end", Tier::mandatory, 60, 5));
  delivery_->hear(stored("for a decision", Tier::decisional, 60));
  delivery_->hear(stored("at once", Tier::critical, 40));
  EXPECT_THAT(planned(), ElementsAre("idle", "sample", "view"));
  const Schedule plan = schedule();
  ASSERT_THAT(plan.downlinks, SizeIs(2));
  EXPECT_THAT(plan.downlinks[0].products, ::testing::UnorderedElementsAre("at once", "for a decision"));
  EXPECT_THAT(plan.downlinks[1].products, ElementsAre("until the end"));
  ASSERT_THAT(plan.left_out, SizeIs(1));
  EXPECT_EQ(plan.left_out.front().product, "left over");
}

TEST_F(DeliveryTest, WhatIsOnEarthOrGoneTakesNoRoom) {
  task("dig").products.front().bytes = {200};
  start();
  for (const Fate fate : {Fate::sent, Fate::received, Fate::discarded, Fate::left_behind, Fate::lost}) {
    Existing gone = stored("gone " + std::to_string(static_cast<int>(fate)), Tier::critical, 200);
    gone.fate = fate;
    delivery_->hear(gone);
  }
  EXPECT_THAT(planned(), Contains("sample"));
}

TEST_F(DeliveryTest, TheRequestOfDataIsKnownWhenItsChainHasLeftThePlan) {
  start();
  Existing image = stored("image", Tier::mandatory, 10);
  EXPECT_TRUE(delivery_->hear(image));
  image.fate = Fate::received;
  image.request = static_cast<model::TaskIndex>(network_.tasks.size());
  EXPECT_TRUE(delivery_->hear(image));
  EXPECT_EQ(delivery_->existing().front().request, task_named(network_, "view"));
  EXPECT_EQ(delivery_->products().front().request, task_named(network_, "view"));
  EXPECT_EQ(delivery_->existing().front().fate, Fate::received);
  EXPECT_FALSE(delivery_->hear(image));
}

TEST_F(DeliveryTest, DataThatWaitKeepTheirRoomBesideNewOnes) {
  task("dig").products = {{"trench", Tier::mandatory, {200}, {0.5}}};
  start();
  delivery_->hear(stored("first", Tier::mandatory, 200));
  delivery_->hear(stored("second", Tier::mandatory, 200));
  EXPECT_THAT(planned(), Not(Contains("sample"))) << "two downlinks carry what waits";
}

// R127: downlinks are brought up to date with what they are to carry.
TEST_F(DeliveryTest, ADownlinkLastsAsLongAsTheDataThatAreThere) {
  start();
  cycle_->run(Time{0});
  cycle_->run(10s);
  const auto sending = [&] {
    for (const cycle::Block& one : cycle_->blocks())
      if (chains_.chains[one.chain].task == task_named(network_, "sample")) return one.links.back();
    throw std::logic_error("no sample is planned");
  };
  ASSERT_EQ(sending().end - sending().start, 20s);
  Existing trench = stored("trench", Tier::mandatory, 600);
  trench.request = task_named(network_, "sample");
  delivery_->hear(trench);
  cycle_->doubt();
  cycle_->run(20s);
  EXPECT_EQ(sending().end - sending().start, 60s) << "10 bytes go in each second";
  EXPECT_EQ(downlink(schedule(20s), "send_sample").products, std::vector<std::string>{"trench"});
  Existing orphan = stored("of a chain that is gone", Tier::mandatory, 100);
  orphan.request = static_cast<model::TaskIndex>(network_.tasks.size());
  delivery_->hear(orphan);
  cycle_->doubt();
  cycle_->run(30s);
  EXPECT_EQ(sending().end - sending().start, 70s) << "it takes along what nobody else does";
  trench.fate = orphan.fate = Fate::sent;
  delivery_->hear(trench);
  delivery_->hear(orphan);
  cycle_->run(40s);
  EXPECT_EQ(sending().end - sending().start, 20s);
}

// Where a sol has no energy left for a downlink, the next one has.
TEST_F(DeliveryTest, WhatItsSolHasNoEnergyForIsSentInALaterOne) {
  add_parameter("sol_limit_j", 150);
  add_parameter("sol_s", 300);
  task("idle").impacts.clear();
  EXPECT_THAT(planned(), ElementsAre("idle", "sample", "view"));
  std::set<std::uint32_t> sols;
  for (const search::PlannedDownlink& one : cycle_->data().downlinks)
    sols.insert(delivery_->sol_of(one.start, cycle_->past().values));
  EXPECT_THAT(sols, ElementsAre(0, 1));
}

// What needs something that gave way to a limit does not stay without it.
TEST_F(DeliveryTest, WhatGaveWayToALimitTakesAlongWhatNeedsIt) {
  add_parameter("sol_limit_j", 150);
  add_parameter("sol_s", 400);
  task("sample").opens = 100s;
  task("image").constraints = {{.timeline = testing::kSite, .states = 2}};  // which digging opens
  ASSERT_THAT(planned(), ElementsAre("idle", "sample", "view"));
  const auto downlinks = cycle_->data().downlinks;
  ASSERT_LT(downlinks[0].start, 400s);
  ASSERT_GE(downlinks[1].start, 400s);
  delivery_->executed(1, task_named(network_, "send_view"), 0s, 20s, cycle_->past().values);
  cycle_->run(10s);  // commits `idle`
  EXPECT_THAT(cycle_->timelines().conflicts(Time{0}, temporal::no_bound), IsEmpty());
  EXPECT_THAT(delivery_->overdrawn_sols(cycle_->data().downlinks, cycle_->past().values), IsEmpty());
}

TEST_F(DeliveryTest, TheLimitOfADownlinkIsNeverExceeded) {
  add_parameter("downlink_limit_j", 99);  // each takes 100 J
  EXPECT_THAT(planned(), ElementsAre("idle"));
  EXPECT_GT(delivery_->counts().limits, 0U);
}

TEST_F(DeliveryTest, TheLimitOfASolIsNeverExceeded) {
  add_parameter("sol_limit_j", 199);
  EXPECT_THAT(planned(), ElementsAre("idle", "sample")) << "the better of the two";
}

TEST_F(DeliveryTest, WhatWasExecutedInASolCountsForItsLimit) {
  add_parameter("sol_limit_j", 200);
  start();
  const auto send = task_named(network_, "send_view");
  delivery_->executed(1, send, Time{0}, 10s, cycle_->past().values);
  delivery_->executed(1, send, Time{0}, 10s, cycle_->past().values);
  EXPECT_THAT(planned(), ElementsAre("idle", "sample"));
}

TEST_F(DeliveryTest, AnotherProcessIsToldWhatIsNoLongerInThePlan) {
  add_parameter("sol_limit_j", 200);
  add_parameter("sol_s", 100);
  start();
  const auto send = task_named(network_, "send_view");
  const model::Values& values = cycle_->past().values;
  for (const auto& [activity, at] : {std::pair(1U, 10s), {2U, 40s}, {3U, 110s}})
    delivery_->executed(activity, send, at, at + 10s, values);
  const auto is_second = [](temporal::timelines::TaskId activity) { return activity == 2; };
  using Joules = std::map<std::uint32_t, double>;
  EXPECT_EQ(delivery_->spent(is_second, 50s, values), (Joules{{0, 50}, {1, 50}}));
  EXPECT_EQ(delivery_->spent(is_second, 150s, values), (Joules{{1, 50}})) << "the first sol is over";
  Delivery anew(network_);
  anew.resume(delivery_->spent(is_second, 50s, values));
  anew.executed(2, send, 40s, 50s, values);
  EXPECT_EQ(anew.longest(send, 60s, {}, values), delivery_->longest(send, 60s, {}, values));
  EXPECT_EQ(anew.spent(is_second, 50s, values), delivery_->spent(is_second, 50s, values));
}

TEST_F(DeliveryTest, RandomPlansKeepBothLimits) {
  std::mt19937 random(17);
  for (int round = 0; round < 40; ++round) {
    network_ = toy_network();
    for (const char* id : {"send_sample", "send_view"}) {
      task(id).downlinks = true;
      task(id).duration = {static_cast<double>(5 + random() % 40)};
    }
    const double one = 50 + random() % 150, all = 80 + random() % 250, sol = 40 + random() % 300;
    add_parameter("rate_bytes_per_s", 10);
    add_parameter("downlink_limit_j", one);
    add_parameter("sol_limit_j", all);
    add_parameter("sol_s", sol);
    task("image").products = {{"image", Tier::decisional, {static_cast<double>(random() % 300)}, {1}}};
    start();
    planned();
    std::map<std::int64_t, double> joules;
    for (const search::PlannedDownlink& each : cycle_->data().downlinks) {
      const double takes = 5 * temporal::to_seconds(each.end - each.start);
      EXPECT_LE(takes, one);
      joules[static_cast<std::int64_t>(temporal::to_seconds(each.start) / sol)] += takes;
    }
    for (const auto& [number, sum] : joules) EXPECT_LE(sum, all) << "sol " << number << ", round " << round;
    EXPECT_THAT(schedule().left_out, IsEmpty());
    EXPECT_THAT(schedule().late, IsEmpty());
  }
}

TEST_F(DeliveryTest, FirstFitFindsNothingThatTheManagerRefuses) {
  std::mt19937 random(127);
  int found = 0;
  for (int round = 0; round < 2000; ++round) {
    std::vector<downlink::Window> windows;
    for (std::uint32_t w = 0; w < 1 + random() % 4; ++w) {
      const Time start = temporal::seconds(100.0 * w);
      windows.push_back(
          {"w" + std::to_string(w), start, start + temporal::seconds(1.0 + random() % 50), 2.0, 1.0});
    }
    std::vector<model::DataProduct> products;
    for (std::uint32_t p = 0; p < 1 + random() % 8; ++p)
      products.push_back({"p" + std::to_string(p),
                          static_cast<Tier>(random() % 3),
                          random() % 60,
                          temporal::seconds(static_cast<double>(random() % 350)),
                          {1}});
    if (!first_fit({}, products, windows)) continue;
    ++found;
    EXPECT_TRUE(downlink::Manager().admits({}, windows, {}, products)) << "round " << round;
  }
  EXPECT_GT(found, 100);
}

TEST_F(DeliveryTest, ExistingProductsAreToldWithWhatTheyAreWorth) {
  start();
  EXPECT_TRUE(delivery_->hear(stored("image", Tier::decisional, 60, 0.7)));
  EXPECT_FALSE(delivery_->hear(stored("image", Tier::decisional, 60, 0.7))) << "nothing new";
  ASSERT_THAT(delivery_->products(), SizeIs(1));
  EXPECT_EQ(delivery_->products().front().utility, temporal::RankVector{0.7});
  EXPECT_EQ(delivery_->received(), temporal::RankVector{}) << "it counts when it is on Earth";
  Existing home = stored("image", Tier::decisional, 60, 0.7);
  home.fate = Fate::received;
  EXPECT_TRUE(delivery_->hear(home));
  EXPECT_EQ(delivery_->received(), temporal::RankVector{0.7});
  EXPECT_THAT(delivery_->products(), SizeIs(1));
}

TEST_F(DeliveryTest, ScoresThatAreNoneCountNothing) {
  start();
  Existing odd = stored("odd", Tier::mandatory, 60);
  odd.data.utility = temporal::RankVector{-1, std::numeric_limits<double>::quiet_NaN(), 0.5};
  delivery_->hear(odd);
  EXPECT_EQ(delivery_->products().front().utility, (temporal::RankVector{0, 0, 0.5}));
  EXPECT_NO_THROW(planned());
}

}  // namespace
}  // namespace roci::planner::utility_htn::delivery
