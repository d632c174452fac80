// How long downlinks last: for the data that wait and go with them, as far as Earth's view, what is fixed, and the limits
// of a downlink and of a sol permit; and what gives way where a sol is overdrawn.
#include "planner_svc/utility_htn/cycle/sessions.hpp"

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
using ::testing::Contains, ::testing::ElementsAre, ::testing::IsEmpty, ::testing::Not, ::testing::Pair,
    ::testing::SizeIs;
using testing::task_named, testing::toy_network;

// `sample` has begun, and more waits for its downlink than the 20 s of the network carry.
class LongSessions : public DeliveryTest {
 protected:
  void begin() {
    start();
    cycle_->run(Time{0});
    cycle_->run(10s);
  }
  void wait_for_it(std::uint64_t bytes) {
    Existing trench = stored("trench", Tier::mandatory, bytes);
    trench.request = task_named(network_, "sample");
    delivery_->hear(trench);
    cycle_->doubt();
  }
  // `sample` is sent while Earth is in view.
  void earth_sets_at(Time end) {
    earth_ = static_cast<temporal::timelines::Index>(network_.timelines.size());
    network_.timelines.push_back({"earth", temporal::timelines::Kind::state, {"set", "risen"}});
    see_earth("earth_view", 30s, end);
    task("send_sample").constraints = {
        {.timeline = earth_, .phase = temporal::timelines::Phase::maintenance, .states = 2}};
  }
  void see_earth(const std::string& name, Time start, Time end) {
    model::Task& view = network_.tasks.emplace_back();
    view.id = view.name = name;
    view.fixed = true;
    view.preferred_start = start;
    view.duration = {temporal::to_seconds(end - start)};
    view.impacts = {{earth_, temporal::ImpactKind::assign, temporal::ImpactWhen::at_start, {1}},
                    {earth_, temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, {0}}};
  }
  // Digging and imaging take the time of the network, so that sending comes at 180 s.
  void image_until_now() {
    cycle_->withdraw(task_named(network_, "view"));
    const auto number = [&](const std::string& id) {
      return std::ranges::find(cycle_->blocks(), task_named(network_, id),
                               [&](const auto& one) { return chains_.chains[one.chain].task; })
          ->number;
    };
    cycle_->begun(cycle::task_id(number("earth_view"), 0), 30s);
    cycle_->begun(cycle::task_id(number("sample"), 0), 30s);
    cycle_->ended(cycle::task_id(number("sample"), 0), 130s, true);
    cycle_->begun(cycle::task_id(number("sample"), 1), 130s);
  }
  const cycle::Link& sending() const {
    for (const cycle::Block& one : cycle_->blocks())
      if (chains_.chains[one.chain].task == task_named(network_, "sample")) return one.links.back();
    throw std::logic_error("no sample is planned");
  }
  temporal::Duration session() const { return sending().end - sending().start; }
  Time sent_at() const { return sending().start; }

 private:
  temporal::timelines::Index earth_ = 0;
};

TEST_F(LongSessions, EndBeforeSomethingFixedThatNeedsTheSame) {
  const model::Impact takes{testing::kArm, temporal::ImpactKind::delta, temporal::ImpactWhen::during, {1}};
  task("send_sample").impacts.push_back(takes);
  model::Task uplink;
  uplink.id = uplink.name = "uplink";
  uplink.fixed = true;
  uplink.preferred_start = 230s;
  uplink.duration = {10};
  uplink.impacts = {takes};
  network_.tasks.push_back(uplink);
  begin();
  wait_for_it(600);
  EXPECT_THAT(planned(20s), Contains("uplink"));
  EXPECT_EQ(session(), 20s) << "60 s would run into the uplink";
  wait_for_it(450);
  cycle_->run(20s);
  EXPECT_EQ(session(), 45s);
}

TEST_F(LongSessions, EndBeforeWhatTheyNeedAllTheWhileDoes) {
  earth_sets_at(230s);
  begin();
  image_until_now();
  cycle_->run(140s);
  ASSERT_EQ(session(), 20s) << "from 180 s on, and Earth sets at 230 s";
  wait_for_it(600);
  EXPECT_EQ(delivery_->transmission(delivery_->requests_with_data(), cycle_->past().values), 60s);
  cycle_->run(145s);
  EXPECT_EQ(session(), 20s);
  wait_for_it(500);
  cycle_->run(151s);
  EXPECT_EQ(session(), 50s) << "which is committed";
  EXPECT_THAT(cycle_->timelines().conflicts(151s, temporal::no_bound), IsEmpty());
}

// It would be committed as long as that, run into the end of the view, and bring home nothing.
TEST_F(LongSessions, AreNotCommittedBeyondTheView) {
  earth_sets_at(230s);
  begin();
  image_until_now();
  wait_for_it(600);
  cycle_->run(151s);
  EXPECT_EQ(session(), 20s);
  EXPECT_THAT(cycle_->timelines().conflicts(151s, temporal::no_bound), IsEmpty());
}

TEST_F(LongSessions, AreInALaterViewThatLastsForAllOfThem) {
  earth_sets_at(230s);
  see_earth("later_view", 300s, 360s);
  begin();
  image_until_now();
  cycle_->run(140s);
  ASSERT_EQ(sent_at(), 180s);
  wait_for_it(600);
  cycle_->run(145s);
  EXPECT_EQ(session(), 60s);
  EXPECT_EQ(sent_at(), 300s);
  EXPECT_THAT(cycle_->timelines().conflicts(145s, temporal::no_bound), IsEmpty());
}

// A chain whose data go with no view is not broken off.
TEST_F(LongSessions, StayWhereNoViewLastsForAllOfThem) {
  earth_sets_at(230s);
  see_earth("later_view", 300s, 355s);
  begin();
  image_until_now();
  wait_for_it(600);
  cycle_->run(145s);
  EXPECT_EQ(session(), 20s);
  EXPECT_EQ(sent_at(), 180s);
}

TEST_F(LongSessions, AreNoLongerThanTheLimitOfADownlinkPermits) {
  add_parameter("downlink_limit_j", 120);
  begin();
  wait_for_it(600);
  cycle_->run(20s);
  EXPECT_EQ(session(), 20s) << "120 J at 5 W last for 24 s, in which no part of it is sent";
  wait_for_it(240);
  cycle_->run(20s);
  EXPECT_EQ(session(), 24s);
}

// The more urgent one goes, and the smaller one as far as there is room beside it.
TEST_F(LongSessions, LastForWhatGoesTogether) {
  add_parameter("downlink_limit_j", 225);
  begin();
  for (const auto& [id, tier, bytes] :
       {std::tuple{"a", Tier::mandatory, 260}, std::tuple{"b", Tier::decisional, 300},
        std::tuple{"c", Tier::mandatory, 100}}) {
    Existing product = stored(id, tier, static_cast<std::uint64_t>(bytes));
    product.request = task_named(network_, "sample");
    delivery_->hear(product);
  }
  cycle_->doubt();
  cycle_->run(20s);
  EXPECT_EQ(session(), 40s) << "b and c: 225 J at 5 W last for 45 s";
}

// What the service lets through is planned with, however large.
TEST_F(LongSessions, AProductOfTheGreatestSizeIsLeftOutAndNothingElseChanges) {
  begin();
  wait_for_it(1'000'000'000'000'000);
  EXPECT_THAT(planned(20s), Contains("sample"));
  EXPECT_THAT(schedule(20s).left_out, SizeIs(1));
  EXPECT_THAT(schedule(400s).left_out, SizeIs(1)) << "nor while a downlink runs";
}

TEST_F(LongSessions, AreNoLongerThanTheLimitOfTheirSolPermitsBesideOthers) {
  add_parameter("sol_limit_j", 250);
  begin();
  wait_for_it(310);
  EXPECT_THAT(planned(20s), Contains("view"));
  EXPECT_EQ(session(), 20s) << "the other one takes 100 J, and 30 s are left";
  wait_for_it(300);
  EXPECT_THAT(planned(20s), Contains("view"));
  EXPECT_EQ(session(), 30s);
}

TEST_F(LongSessions, TakeTheirRealTimeFromTheirSol) {
  add_parameter("sol_limit_j", 350);
  task("idle").impacts.clear();  // there is energy enough
  task("view").closes = 86400s;
  begin();
  cycle_->withdraw(task_named(network_, "view"));
  wait_for_it(600);
  cycle_->run(20s);
  ASSERT_EQ(session(), 60s);
  cycle_->request(task_named(network_, "view"));
  EXPECT_THAT(planned(30s), Not(Contains("view"))) << "50 J are left of the sol, in which it has to be done";
}

// So what gave way because of its sol comes in a later one.
TEST_F(LongSessions, WhatGaveWayToItsSolIsPlannedInALaterOne) {
  add_parameter("sol_limit_j", 350);
  add_parameter("sol_s", 400);
  task("idle").impacts.clear();
  begin();
  cycle_->withdraw(task_named(network_, "view"));
  wait_for_it(600);
  cycle_->run(20s);
  ASSERT_EQ(session(), 60s);
  cycle_->request(task_named(network_, "view"));
  EXPECT_THAT(planned(30s), Contains("view"));
  EXPECT_GE(cycle_->data().downlinks.back().start, 400s);
}

// What is late moves to a sol in which another downlink is planned.
TEST_F(LongSessions, GiveWayWhereTheirSolIsOverdrawn) {
  add_parameter("sol_limit_j", 150);
  add_parameter("sol_s", 200);
  task("idle").impacts.clear();
  task("view").decompositions.front().subtasks.erase(task("view").decompositions.front().subtasks.begin());
  task("view").opens = 205s;
  begin();
  ASSERT_THAT(planned(20s), Contains("view"));
  const cycle::Block& sample =
      *std::ranges::find(cycle_->blocks(), task_named(network_, "sample"),
                         [&](const auto& one) { return chains_.chains[one.chain].task; });
  const auto dig = cycle::task_id(sample.number, 0);
  cycle_->begun(dig, sample.links.front().start);
  cycle_->tried_again(dig, 90s);
  for (const Time now : {90s, 100s}) {
    cycle_->run(now);
    std::map<std::int64_t, double> joules;
    for (const search::PlannedDownlink& each : cycle_->data().downlinks)
      joules[each.start / 200s] += 5 * temporal::to_seconds(each.end - each.start);
    EXPECT_GT(joules[1], 0) << "the late one";
    for (const auto& [sol, sum] : joules) EXPECT_LE(sum, 150) << "sol " << sol;
  }
}

// A session that was made shorter when it is moved would be made longer again in the next cycle, and move again.
TEST_F(LongSessions, StayAsLongWhereTheyAreMoved) {
  task("idle").impacts.clear();
  begin();
  cycle_->withdraw(task_named(network_, "view"));
  Existing orphan = stored("of a chain that is gone", Tier::mandatory, 300);
  orphan.request = static_cast<model::TaskIndex>(network_.tasks.size());
  delivery_->hear(orphan);
  cycle_->doubt();
  cycle_->run(20s);
  ASSERT_EQ(session(), 30s);
  const cycle::Block& sample =
      *std::ranges::find(cycle_->blocks(), task_named(network_, "sample"),
                         [&](const auto& one) { return chains_.chains[one.chain].task; });
  const auto dig = cycle::task_id(sample.number, 0);
  cycle_->begun(dig, sample.links.front().start);
  cycle_->tried_again(dig, 90s);
  cycle_->run(90s);
  EXPECT_EQ(session(), 30s);
  EXPECT_FALSE(cycle_->run(100s).changed);
}

// `sample` and `view` have begun, and each sends for 20 s at 5 W: the one at 155 s, the other from 55 s on.
class FullSols : public DeliveryTest {
 protected:
  void begin(double sol_limit_j) {
    add_parameter("sol_limit_j", sol_limit_j);
    add_parameter("sol_s", 200);
    task("idle").impacts.clear();
    task("image").impacts.pop_back();  // no arm, so both begin at once
    ASSERT_THAT(planned(), ElementsAre("idle", "sample", "view"));
    for (const cycle::Block& one : cycle_->blocks())
      for (std::size_t i = 0; i + 1 < one.links.size() && one.links[i].start < 10s; ++i)
        cycle_->begun(cycle::task_id(one.number, i), one.links[i].start);
    cycle_->run(10s);
    for (const cycle::Block& one : cycle_->blocks()) ASSERT_TRUE(one.begun());
  }
  // A downlink that is over has taken 100 J of the first sol.
  void something_was_sent() {
    delivery_->executed(1, task_named(network_, "send_view"), 0s, 20s, cycle_->past().values);
    cycle_->doubt();
  }
  std::map<std::string, std::uint32_t> sols() const {
    std::map<std::string, std::uint32_t> out;
    for (const search::PlannedDownlink& one : cycle_->data().downlinks)
      out[network_.tasks[one.task].id] = delivery_->sol_of(one.start, cycle_->past().values);
    return out;
  }
  void expect_limits_kept() const {
    EXPECT_THAT(delivery_->overdrawn_sols(cycle_->data().downlinks, cycle_->past().values), IsEmpty());
    EXPECT_THAT(cycle_->timelines().conflicts(cycle_->timelines().past(), temporal::no_bound), IsEmpty());
  }
};

// Nothing that has not begun could give way, and the second sol lasts for one downlink alone.
TEST_F(FullSols, WhatIsLateGoesToASolThatLastsForIt) {
  begin(150);
  ASSERT_THAT(sols(), ElementsAre(Pair("send_sample", 0), Pair("send_view", 1)));
  const cycle::Block& sample =
      *std::ranges::find(cycle_->blocks(), task_named(network_, "sample"),
                         [&](const auto& one) { return chains_.chains[one.chain].task; });
  cycle_->tried_again(cycle::task_id(sample.number, 0), 90s);  // it digs until 190 s, and images until 240 s
  cycle_->run(90s);
  EXPECT_THAT(sols(), ElementsAre(Pair("send_sample", 2), Pair("send_view", 1)));
  expect_limits_kept();
}

TEST_F(FullSols, WhatHasBegunGoesToALaterOneWhereItsOwnIsOverdrawn) {
  begin(150);
  something_was_sent();
  cycle_->run(20s);
  EXPECT_THAT(sols(), ElementsAre(Pair("send_sample", 2), Pair("send_view", 1)));
  expect_limits_kept();
}

TEST_F(FullSols, WhatHasNoLaterOneIsBrokenOffWhereItIsWorthLeast) {
  network_.cycle.plan_end = 200s;
  task("idle").duration = {100};
  begin(250);
  ASSERT_THAT(sols(), ElementsAre(Pair("send_sample", 0), Pair("send_view", 0)));
  something_was_sent();
  const cycle::Report report = cycle_->run(20s);
  EXPECT_THAT(sols(), ElementsAre(Pair("send_sample", 0)));
  EXPECT_THAT(report.notes,
              Contains(::testing::HasSubstr("view is broken off: downlinks of its sol take more")));
  expect_limits_kept();
}

// The network makes a downlink longer than any sol lasts for: what has begun goes on all the same.
TEST_F(FullSols, WhatNoSolLastsForGoesOnAsTheNetworkSays) {
  begin(250);
  const auto limit = static_cast<model::ParameterIndex>(network_.parameters.size() - 2);
  ASSERT_EQ(network_.parameters[limit].name, "sol_limit_j");
  cycle_->set_value(limit, 99);
  cycle_->run(20s);
  EXPECT_THAT(sols(), ElementsAre(Pair("send_sample", 0), Pair("send_view", 0)));
}

}  // namespace
}  // namespace roci::planner::utility_htn::delivery
