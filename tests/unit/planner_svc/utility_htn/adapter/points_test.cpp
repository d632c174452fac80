// Time points of a plan that never ends: numbered anew when their activities are gone, so that memory stays flat.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "core/temporal/plan_delta.hpp"
#include "planner_svc/utility_htn/adapter/plan_of.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"

namespace roci::planner::utility_htn::adapter {
namespace {

using namespace std::chrono_literals;
using cycle::Block, cycle::Link, cycle::Stage, cycle::task_id;
using temporal::FlexiblePlan, temporal::PlanActivity, temporal::Time, temporal::TimePoint;
using ::testing::IsEmpty;

// A lander that is asked for a view every hour, while one task runs as long as the mission does.
class LongRun {
 public:
  explicit LongRun(unsigned seed) : random_(seed) { cycle_.run(Time{0}); }

  void run_until(Time end) {
    for (; now_ < end; now_ += 60s) {
      if (now_ % 3600s == 0s) cycle_.request(testing::task_named(network_, "view"));
      execute();
      if (cycle_.run(now_).changed) send();
    }
  }

  std::uint32_t points() const { return told_.point_count; }
  temporal::timelines::Kept kept() const { return cycle_.timelines().kept(); }
  std::size_t activities() const { return told_.activities.size(); }
  std::uint32_t last_block() const { return cycle_.last_block(); }
  bool hotel_runs() const {
    return std::ranges::any_of(cycle_.blocks(), [](const Block& one) {
      return one.links.front().stage == Stage::running && one.links.size() == 1;
    });
  }

 private:
  static model::Network network() {
    model::Network out = testing::toy_network();
    model::Task& hotel = out.tasks[testing::task_named(out, "idle")];
    hotel.id = hotel.name = "hotel";
    hotel.duration = {40.0 * 86400};
    hotel.impacts.clear();
    out.timelines[testing::kBattery].initial = out.timelines[testing::kBattery].highest = 1e9;
    out.cycle = {60s, 5s, 120s, temporal::no_bound, 45 * 86400s};
    return out;
  }

  // Links begin when they may and take up to a fifth longer or shorter than foreseen.
  void execute() {
    std::uniform_real_distribution<double> share(0.8, 1.2);
    for (const Block& one : std::vector<Block>(cycle_.blocks()))
      for (std::size_t i = 0; i < one.links.size(); ++i) {
        const Link& link = one.links[i];
        const auto id = task_id(one.number, i);
        const bool ready = i == 0 || one.links[i - 1].stage == Stage::succeeded;
        if (link.stage == Stage::committed && link.planned <= now_ && ready) {
          cycle_.begun(id, now_);
          ends_[id] = now_ + Time{static_cast<std::int64_t>(
                                 share(random_) * static_cast<double>((link.end - link.start).count()))};
        } else if (link.stage == Stage::running && ends_.at(id) <= now_) {
          cycle_.ended(id, now_, true);
          ends_.erase(id);
        }
      }
  }

  // Each version is well formed, follows from the delta, and leaves what stays its points.
  void send() {
    points_.keep_only(cycle_.blocks(), false);
    const FlexiblePlan plan = plan_of(
        network_, chains_, cycle_, {"utility_htn", "lander", told_.version + 1, Time{0}, {}}, told_, points_);
    EXPECT_THAT(temporal::check(plan), IsEmpty());
    std::map<TimePoint, std::string> owner;
    for (const PlanActivity& one : plan.activities)
      for (const TimePoint point : {one.start_point, one.end_point})
        EXPECT_TRUE(owner.emplace(point, one.id).second) << one.id << " shares a point with " << owner[point];
    for (const PlanActivity& before : told_.activities)
      for (const PlanActivity& after : plan.activities)
        if (before.id == after.id) {
          EXPECT_EQ(before.start_point, after.start_point) << before.id;
        }
    FlexiblePlan changed = told_;
    EXPECT_EQ(temporal::apply(temporal::difference(told_, plan), changed), "");
    EXPECT_EQ(changed.activities.size(), plan.activities.size());
    told_ = plan;
  }

  std::mt19937 random_;
  model::Network network_ = network();
  flattening::Chains chains_ = flattening::flatten_all(network_);
  assessor::NetworkAssessor assessor_;
  std::unique_ptr<search::Scheduler> scheduler_ = search::make_scheduler("earliest");
  cycle::Cycle cycle_{network_, chains_, assessor_, *scheduler_, Time{0}};
  std::map<cycle::TaskId, Time> ends_;
  FlexiblePlan told_;
  Points points_;
  Time now_ = 60s;
};

TEST(LongRunMemory, IsFlatAfterTheFirstDayOfThirty) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    SCOPED_TRACE(seed);
    LongRun run(seed);
    run.run_until(86400s);
    ASSERT_TRUE(run.hotel_runs());
    std::uint32_t most_points = 0;
    std::size_t most_tasks = 0, most_events = 0, most_activities = 0;
    for (int hour = 24; hour < 48; ++hour) {
      run.run_until(hour * 3600s);
      most_points = std::max(most_points, run.points());
      most_tasks = std::max(most_tasks, run.kept().tasks);
      most_events = std::max(most_events, run.kept().events);
      most_activities = std::max(most_activities, run.activities());
    }
    const std::uint32_t blocks_of_two_days = run.last_block();
    run.run_until(30 * 86400s);
    EXPECT_GT(run.last_block(), 10 * blocks_of_two_days) << "the mission went on";
    EXPECT_TRUE(run.hotel_runs());
    EXPECT_LE(run.points(), most_points);
    EXPECT_LE(run.kept().tasks, most_tasks);
    EXPECT_LE(run.kept().events, most_events);
    EXPECT_LE(run.activities(), most_activities);
    EXPECT_LE(run.points(), 2 * (most_activities + 4));
  }
}

TEST(PointNumbers, AreGivenAgainOnlyWhenTheirBlockIsGone) {
  Points points;
  const auto of = [](std::uint32_t number) { return Block{number, 0, {Link{}, Link{}}}; };
  const auto first = points.of(task_id(1, 0));
  const auto second = points.of(task_id(2, 0));
  EXPECT_NE(first, second);
  points.keep_only({of(1), of(2)}, false);
  EXPECT_EQ(points.of(task_id(1, 0)), first);
  points.keep_only({of(2)}, false);
  EXPECT_EQ(points.of(task_id(2, 0)), second);
  EXPECT_EQ(points.of(task_id(3, 0)), first);
  EXPECT_EQ(points.count(), 6U);
  points.keep_only({of(3)}, false);
  EXPECT_EQ(points.count(), 4U);
}

TEST(PointNumbers, TheInitialActivityKeepsItsOwnUntilItIsOver) {
  Points points;
  const auto initial = points.of(Points::kInitial);
  points.keep_only({}, true);
  EXPECT_NE(points.of(task_id(1, 0)), initial);
  points.keep_only({}, false);
  EXPECT_EQ(points.count(), Points::kPast + 1);
}

}  // namespace
}  // namespace roci::planner::utility_htn::adapter
