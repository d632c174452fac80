// The planning cycle of a mission with two sites, of which one is given up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner_svc/utility_htn/assessor/subway_assessor.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/cycle_fixture.hpp"

namespace roci::planner::utility_htn::cycle {
namespace {

using namespace std::chrono_literals;
using temporal::Time;
using ::testing::Contains, ::testing::ElementsAre, ::testing::IsEmpty, ::testing::Not;
using testing::task_named, testing::toy_network;

// Two sites that are opened before they are sampled, the better one first.
class TwoSites : public CycleTest {
 protected:
  TwoSites() {
    network_ = toy_network();
    network_.ranks = {"mission", "science"};
    for (model::Task& task : network_.tasks) task.is_template = true;
    for (const int site : {0, 1}) {
      const std::string name = std::to_string(site);
      const auto opened = static_cast<temporal::timelines::Index>(network_.timelines.size());
      network_.timelines.push_back({"site_" + name, temporal::timelines::Kind::state, {"closed", "open"}});
      network_.timelines.push_back(
          {"signature_" + name, temporal::timelines::Kind::state, {"unknown", "negative", "positive"}});
      add("open_" + name)
          .impacts.push_back({opened, temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, {1}});
      add("sample_" + name).constraints = {{.timeline = opened, .states = 2}};
      network_.subway.sites.push_back(
          {"site_" + name,
           {site == 0 ? 0.9 : 0.5},
           {{static_cast<model::TaskIndex>(network_.tasks.size() - 1), opened + 1, {1}}}});
    }
    chains_ = flattening::flatten_all(network_);
    map_ = std::make_unique<assessor::SubwayAssessor>(network_, chains_);
  }

  model::Task& add(const std::string& id) {
    model::Task& out = network_.tasks.emplace_back(network_.tasks[task_named(network_, "image")]);
    out.id = out.name = id;
    out.is_template = false;
    out.utility = {{0}, {1}};
    return out;
  }
  Cycle make_with_map() const { return {network_, chains_, *map_, *scheduler_, Time{0}, {}}; }

  // Lets all that is committed run at its time until then; the task of that name fails each time.
  void fly(Cycle& cycle, Time& now, Time until, const std::string& failing) {
    for (; now < until; now += 10s) {
      const Report report = cycle.run(now);
      notes_.insert(notes_.end(), report.notes.begin(), report.notes.end());
      for (const std::string& note : report.notes)
        if (note.find("withdrawn") != std::string::npos) when_given_up_ = requests(cycle);
      for (const Block& one : std::vector<Block>(cycle.blocks())) {
        const Link& link = one.links.front();
        if (link.stage != Stage::committed || link.start > now) continue;
        const std::string& id = network_.tasks[link.task].id;
        cycle.begun(task_id(one.number, 0), now);
        cycle.ended(task_id(one.number, 0), now + 1s, id != failing);
        if (id != failing) done_.push_back(id);
        if (id.starts_with("open") && id != failing) cycle.observe(id.ends_with("0") ? 4 : 6, now + 1s, 1);
      }
    }
  }

  std::unique_ptr<assessor::Assessor> map_;
  std::vector<std::string> notes_, done_;
  std::vector<std::string> when_given_up_;  // what is placed by the cycle that gives something up
};

TEST_F(TwoSites, ASiteThatIsGivenUpDoesNotHoldUpTheOthers) {
  Cycle cycle = make_with_map();
  Time now{0};
  fly(cycle, now, 1000s, "open_0");
  EXPECT_THAT(notes_, Contains("open_0 is withdrawn: it failed 3 times"));
  EXPECT_THAT(when_given_up_, Contains("open_1")) << "at once";
  EXPECT_THAT(done_, ElementsAre("open_1", "sample_1"));
  EXPECT_THAT(cycle.closed(now), Contains(task_named(network_, "sample_0")));
}

// A sample waits until something is mended: what the map leads to behind it must not stay where
// it was planned, before it.
TEST_F(TwoSites, WhatTheMapLedToThroughSomethingThatRepairTookOutGoesWithIt) {
  model::Task& mend = add("mend");
  mend.opens = 600s;
  mend.impacts.push_back({testing::kHealth, temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, {0}});
  network_.tasks[task_named(network_, "sample_0")].constraints.push_back(
      {.timeline = testing::kHealth, .states = 1});
  chains_ = flattening::flatten_all(network_);
  map_ = std::make_unique<assessor::SubwayAssessor>(network_, chains_);
  Cycle cycle = make_with_map();
  cycle.run(Time{0});
  const auto start_of = [&](const std::string& id) {
    return block_of_request(cycle, id).links.front().start;
  };
  ASSERT_LT(start_of("sample_1"), 600s);
  cycle.observe(testing::kHealth, 5s, 1);
  const Report report = cycle.run(10s);
  EXPECT_THAT(report.done, Contains(Activity::repair));
  EXPECT_THAT(report.notes, Contains("open_1 is taken out: it breaks a rule of the mission"));
  EXPECT_GE(start_of("sample_0"), 650s);
  for (const std::string& id : requests(cycle)) {
    if (!id.ends_with("_1")) continue;
    EXPECT_GT(start_of(id), start_of("sample_0")) << id;
  }
}

// The three failures count however many processes of the planner see them.
TEST_F(TwoSites, WhatHasFailedIsCountedOverARestart) {
  Cycle first = make_with_map();
  Time now{0};
  while (first.past().failures.empty() && now < 1000s) fly(first, now, now + 10s, "open_0");
  ASSERT_THAT(first.past().failures, ElementsAre(::testing::Pair(task_named(network_, "open_0"), 1U)));
  Cycle second = make_with_map();
  second.resume(first.past(), first.blocks(), first.last_block(), now);
  fly(second, now, now + 1000s, "open_0");
  EXPECT_THAT(notes_, Contains("open_0 is withdrawn: it failed 3 times"));
  EXPECT_EQ(std::ranges::count(notes_, "open_0 failed"), 3);
}

TEST_F(TwoSites, WhatWasGivenUpStaysSoUntilSomebodyAsks) {
  Cycle first = make_with_map();
  Time now{0};
  fly(first, now, 1000s, "open_0");
  Cycle second = make_with_map();
  second.resume(first.past(), first.blocks(), first.last_block(), now);
  EXPECT_THAT(second.waiting(), Not(Contains(task_named(network_, "open_0"))));
  second.request(task_named(network_, "open_0"));
  EXPECT_THAT(second.past().withdrawn, IsEmpty());
  fly(second, now, 2000s, "");
  EXPECT_THAT(done_, ElementsAre("open_1", "sample_1", "open_0", "sample_0"));
}

}  // namespace
}  // namespace roci::planner::utility_htn::cycle
