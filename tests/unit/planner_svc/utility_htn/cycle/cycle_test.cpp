// The planning cycle by itself: its order, its windows, what it does when something is late, fails or is dearer.
#include "planner_svc/utility_htn/cycle/cycle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <set>

#include "planner_svc/utility_htn/assessor/assessor.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/cycle_fixture.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"

namespace roci::planner::utility_htn::cycle {
namespace {

using namespace std::chrono_literals;
using temporal::Duration, temporal::Time;
using ::testing::Contains, ::testing::ElementsAre, ::testing::HasSubstr, ::testing::IsEmpty, ::testing::Not;
using testing::task_named;

TEST_F(CycleTest, SchedulesAllThatFitsBehindTheCommitWindow) {
  Cycle cycle = make();
  const Report report = cycle.run(Time{0});
  EXPECT_THAT(requests(cycle), ElementsAre("idle", "sample", "view"));
  EXPECT_THAT(report.done, Contains(Activity::schedule));
  for (const Block& one : cycle.blocks())
    for (const Link& link : one.links) EXPECT_GE(link.start, 30s) << "nothing is placed in the commit window";
  EXPECT_THAT(cycle.timelines().conflicts(Time{0}, temporal::no_bound), IsEmpty());
}

TEST_F(CycleTest, CommitsWhatStartsBeforeTheEndOfTheWindowAndFirst) {
  Cycle cycle = make();
  cycle.run(Time{0});
  const Report report = cycle.run(10s);
  ASSERT_THAT(report.done, Not(IsEmpty()));
  EXPECT_EQ(report.done.front(), Activity::commit);
  for (const Block& one : cycle.blocks())
    for (const Link& link : one.links) EXPECT_EQ(link.stage == Stage::committed, link.start < 40s);
}

TEST_F(CycleTest, NamesItsPartsInTheirOrderAndConsolidationWhereItFoldsSomething) {
  Cycle cycle = make();
  std::set<Activity> seen;
  for (Time now{0}; now < 1500s; now += 10s) {
    const std::size_t before = cycle.timelines().kept().events;
    const Report report = cycle.run(now);
    EXPECT_TRUE(std::ranges::is_sorted(report.done)) << now.count();
    EXPECT_EQ(std::ranges::adjacent_find(report.done), report.done.end());
    if (std::ranges::find(report.done, Activity::schedule) == report.done.end() &&
        cycle.timelines().kept().events < before) {
      EXPECT_THAT(report.done, Contains(Activity::consolidate));
    }
    seen.insert(report.done.begin(), report.done.end());
    for (const Block& one : std::vector<Block>(cycle.blocks()))
      for (std::size_t i = 0; i < one.links.size(); ++i) {
        const Link& link = one.links[i];
        const bool ready = i == 0 || one.links[i - 1].stage == Stage::succeeded;
        if (link.stage == Stage::committed && link.planned <= now && ready)
          cycle.begun(task_id(one.number, i), now);
        else if (link.stage == Stage::running && link.end <= now)
          cycle.ended(task_id(one.number, i), now, true);
      }
  }
  EXPECT_THAT(seen, ::testing::IsSupersetOf({Activity::commit, Activity::consolidate, Activity::schedule}));
  EXPECT_STREQ(to_string(Activity::optimize), "optimize");
}

TEST_F(CycleTest, WhereNothingHasChangedNothingIsSearched) {
  Cycle cycle = make();
  cycle.run(Time{0});
  cycle.run(10s);
  const Report quiet = cycle.run(20s);
  EXPECT_EQ(quiet.explored, 0U);
  EXPECT_FALSE(quiet.changed);
}

TEST_F(CycleTest, OnlyWhatPrefersToStartWithinTheSchedulingWindowIsScheduled) {
  network_.cycle.scheduling_window = 100s;
  network_.tasks[task_named(network_, "idle")].preferred_start = 110s;
  Cycle cycle = make();
  cycle.run(Time{0});
  EXPECT_THAT(requests(cycle), Not(Contains("idle")));
  EXPECT_EQ(cycle.run(10s).explored, 0U) << "the window ends at 110 s";
  cycle.run(11s);
  EXPECT_THAT(requests(cycle), Contains("idle"));
  EXPECT_EQ(cycle.run(12s).explored, 0U) << "it is tried once";
}

TEST_F(CycleTest, WhatIsOverdueIsExpectedLaterByAsMuchAgainAndMovesThePlanAFewTimes) {
  Cycle cycle = make();
  const Block first = sample_in(cycle);
  const TaskId task = task_id(first.number, 0);
  cycle.begun(task, first.links.front().start);
  const Time due = first.links.front().end;
  const Duration interval = network_.cycle.process_interval;
  int searches = 0;
  for (Time now = due + interval; now < due + 64 * interval; now += interval) {
    searches += cycle.run(now).explored > 0 ? 1 : 0;
    const Link& late = block_of_request(cycle, "sample").links.front();
    EXPECT_GE(late.end, now) << "it has not ended";
    EXPECT_LE(late.end - due, 2 * (now - due) + interval);
  }
  EXPECT_LE(searches, 8) << "one each time that the delay has doubled, and not 63";
}

TEST_F(CycleTest, ATaskThatIsTriedAgainTakesItsWholeDurationOnceMore) {
  Cycle cycle = make();
  const Block first = sample_in(cycle);
  const TaskId task = task_id(first.number, 0);
  const Link planned = first.links.front();
  cycle.begun(task, planned.start);
  cycle.tried_again(task, planned.end);
  const Link& again = block_of_request(cycle, "sample").links.front();
  EXPECT_EQ(again.start, planned.start);
  EXPECT_EQ(again.end, planned.end + (planned.end - planned.start));
}

TEST_F(CycleTest, AFailureIsTriedAgainAndThenWithdrawn) {
  Cycle cycle = make();
  Time now{0};
  int tries = 0;
  std::vector<std::string> notes;
  for (; now < 3000s; now += 10s) {
    const Report report = cycle.run(now);
    notes.insert(notes.end(), report.notes.begin(), report.notes.end());
    for (const Block& one : std::vector<Block>(cycle.blocks())) {
      for (std::size_t i = 0; i < one.links.size(); ++i) {
        const Link& link = one.links[i];
        if (link.stage != Stage::committed || link.start > now) continue;
        if (i > 0 && one.links[i - 1].stage != Stage::succeeded) continue;
        const bool fails = network_.tasks[link.task].id == "dig";
        tries += fails ? 1 : 0;
        cycle.begun(task_id(one.number, i), now);
        cycle.ended(task_id(one.number, i), now + 1s, !fails, "stuck");
      }
    }
  }
  EXPECT_EQ(tries, 3);
  EXPECT_THAT(notes, Contains(HasSubstr("dig failed: stuck")));
  EXPECT_THAT(notes, Contains("sample is withdrawn: it failed 3 times"));
  EXPECT_THAT(cycle.blocks(), IsEmpty());
}

TEST_F(CycleTest, AContingencyAsksForATemplate) {
  model::Task probe = network_.tasks[task_named(network_, "image")];
  probe.id = probe.name = "probe";
  probe.utility = {{1}};
  network_.tasks.push_back(probe);
  network_.tasks[task_named(network_, "dig")].contingency =
      model::Contingency{{task_named(network_, "probe")}, {task_named(network_, "sample")}};
  Cycle cycle = make();
  cycle.run(Time{0});
  const Block& sample = block_of_request(cycle, "sample");
  cycle.run(sample.links.front().start - 10s);
  const TaskId dig = task_id(sample.number, 0);
  cycle.begun(dig, sample.links.front().start);
  cycle.ended(dig, sample.links.front().start + 5s, false);
  cycle.run(sample.links.front().start + 10s);
  EXPECT_THAT(requests(cycle), Contains("probe"));
  for (int i = 0; i < 200; ++i) cycle.run(Time{2000s} + i * 10s);
  EXPECT_THAT(requests(cycle), Not(Contains("sample")));
}

TEST_F(CycleTest, LessEnergyThanForeseenMakesRoomForTheBetterOne) {
  Cycle cycle = make();
  cycle.run(Time{0});
  ASSERT_THAT(requests(cycle), ElementsAre("idle", "sample", "view"));
  cycle.observe(testing::kBattery, 5s, 500);  // 350 J for the sample, 150 J for the view, 300 J for idling
  const Report report = cycle.run(10s);
  EXPECT_THAT(requests(cycle), Contains("sample"));
  EXPECT_THAT(report.notes,
              Contains(HasSubstr("'view/plain' is not planned, since it costs 150 of 'battery'")));
  EXPECT_THAT(cycle.timelines().conflicts(40s, temporal::no_bound), IsEmpty());
}

// All is scheduled anew when a value changes, batch by batch: the sample comes before what mends the lander.
TEST_F(CycleTest, WhatIsLostToTheOrderOfBatchesIsNamedSo) {
  network_.timelines[testing::kHealth].initial = 1;
  model::Task& idle = network_.tasks[task_named(network_, "idle")];
  idle.impacts.push_back({testing::kHealth, temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, {0}});
  idle.batch = 1;
  Cycle cycle = make();
  cycle.run(Time{0});
  ASSERT_THAT(requests(cycle), ElementsAre("idle", "view"));
  cycle.request(task_named(network_, "image"));
  cycle.run(Time{0});
  ASSERT_THAT(requests(cycle), Contains("sample"));
  EXPECT_EQ(cycle.set_value(0, 120), "");
  const Report report = cycle.run(Time{0});
  EXPECT_THAT(requests(cycle), Not(Contains("sample")));
  EXPECT_THAT(report.notes,
              Contains(HasSubstr("'sample/plain' would fit into the plan from 330 s on: its batch was "
                                 "planned before what now makes it possible")));
}

TEST_F(CycleTest, AValueOutOfItsRangeIsRefusedInNumbersThatOneCanRead) {
  Cycle cycle = make();
  const std::string refused = cycle.set_value(0, 1e30);
  EXPECT_THAT(refused, AllOf(HasSubstr(" = 1e+30 is not between "), Not(HasSubstr("000000"))));
}

// R98: it waits for the arm that another image holds, as the executive waits with it; no place behind that is searched.
TEST_F(CycleTest, WithoutRepairsWhatFollowsALateLinkIsPushedAndNoPlaceIsSearchedFor) {
  for (const bool repairs : {false, true}) {
    Cycle cycle = make({.repairs = repairs, .optimizes = false, .schedules_again = repairs});
    const Block sample = sample_in(cycle);
    const Link other = block_of_request(cycle, "view").links.front();
    ASSERT_GE(other.start, sample.links[1].end);
    cycle.begun(task_id(sample.number, 0), sample.links[0].start + (other.start - sample.links[1].start) + 5s);
    cycle.run(20s);
    const Block& late = block_of_request(cycle, "sample");
    ASSERT_EQ(late.links[0].end, other.start + 5s);
    if (repairs)
      EXPECT_GT(late.links[1].start, late.links[0].end);
    else
      EXPECT_EQ(late.links[1].start, late.links[0].end);
  }
}

TEST_F(CycleTest, WhatHasBegunIsFinishedLaterWhenItsFirstLinkTakesLonger) {
  Cycle cycle = make();
  cycle.run(Time{0});
  const Block sample = block_of_request(cycle, "sample");
  Time now = sample.links.front().start;
  cycle.run(now);
  cycle.begun(task_id(sample.number, 0), now);
  for (; now < sample.links.front().end + 200s; now += 10s) cycle.run(now);
  const Block& late = block_of_request(cycle, "sample");
  EXPECT_EQ(late.number, sample.number);
  for (std::size_t i = 1; i < late.links.size(); ++i)
    if (late.links[i].stage == Stage::planned) {
      EXPECT_GE(late.links[i].start, now);
    }
}

// The sample's image takes as long as its digging.
TEST_F(CycleTest, ANewDurationMovesTheRestOfWhatHasBegun) {
  network_.tasks[task_named(network_, "image")].duration = {0, 0, 1};
  Cycle cycle = make();
  const Block first = sample_in(cycle);
  cycle.begun(task_id(first.number, 0), first.links.front().start);
  EXPECT_EQ(cycle.set_value(0, 200), "");
  cycle.run(20s);
  const Block& rest = block_of_request(cycle, "sample");
  EXPECT_EQ(rest.links[1].end - rest.links[1].start, 200s);
  EXPECT_GE(rest.links[2].start, rest.links[1].end);
}

// Digging and imaging claim the arm. The view is committed behind the sample's digging, which does not end.
TEST_F(CycleTest, WhatIsCommittedIsExpectedBehindWhatHoldsItsClaim) {
  network_.cycle.commit_window = 300s;
  Cycle cycle = make();
  cycle.run(Time{0});
  const Block sample = block_of_request(cycle, "sample"), view = block_of_request(cycle, "view");
  cycle.run(10s);
  cycle.begun(task_id(sample.number, 0), sample.links[0].start);
  const Time late = view.links[0].start + 20s;
  for (Time now = 20s; now <= late; now += 10s) cycle.run(now);
  const Link& digging = block_of_request(cycle, "sample").links[0];
  const Link& imaging = block_of_request(cycle, "view").links[0];
  ASSERT_EQ(imaging.stage, Stage::committed);
  EXPECT_GE(digging.end, late);
  EXPECT_GE(imaging.start, digging.end);
  EXPECT_EQ(imaging.planned, view.links[0].start) << "what is committed stands as it was told";
}

// The view closes the site, which digging opens in the end, and neither claims the arm.
class ClosingTest : public CycleTest {
 protected:
  // Closing needs the site in one of the states, and a time from `opens` on.
  void view_closes(std::uint64_t states, Time opens) {
    for (const char* id : {"dig", "image"})
      std::erase_if(network_.tasks[task_named(network_, id)].impacts,
                    [](const model::Impact& impact) { return impact.timeline == testing::kArm; });
    model::Task close = network_.tasks[task_named(network_, "image")];
    close.id = close.name = "close";
    close.opens = opens;
    close.impacts = {{testing::kSite, temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, {0}}};
    close.constraints = {{.timeline = testing::kSite, .states = states}};
    network_.tasks[task_named(network_, "view")].decompositions.front().subtasks.front().task =
        static_cast<model::TaskIndex>(network_.tasks.size());
    network_.tasks.push_back(close);
    network_.cycle.commit_window = 300s;
  }
};

TEST_F(ClosingTest, WhatIsCommittedIsExpectedBehindWhatSetsItsStateBefore) {
  view_closes(0b10, 500s);
  Cycle cycle = make();
  cycle.run(Time{0});
  const Block sample = block_of_request(cycle, "sample"), view = block_of_request(cycle, "view");
  cycle.run(10s);
  cycle.begun(task_id(sample.number, 0), sample.links[0].start);
  ASSERT_LE(sample.links[0].end, view.links[0].start);
  for (Time now = 20s; now <= view.links[0].start; now += 10s) cycle.run(now);
  const Link& digging = block_of_request(cycle, "sample").links[0];
  const Link& closing = block_of_request(cycle, "view").links[0];
  ASSERT_EQ(closing.stage, Stage::committed);
  ASSERT_GT(digging.end, view.links[0].start);
  EXPECT_EQ(closing.start, digging.end);
  EXPECT_EQ(cycle.timelines().value(testing::kSite, closing.end), 0) << "the site is closed in the end";
  EXPECT_EQ(closing.planned, view.links[0].start) << "what is committed stands as it was told";
}

// Digging does not end, and the view is asked for when it should have: the site is closed yet.
TEST_F(ClosingTest, WhatIsCommittedStartsInTimeWhereWhatItNeedsIsTakenAwayLater) {
  view_closes(0b01, Time{0});
  network_.parameters[1].prior = 0;  // digging takes no energy, however long
  Cycle cycle = make();
  for (const char* id : {"view", "idle"}) cycle.withdraw(task_named(network_, id));
  cycle.run(Time{0});
  const Block sample = block_of_request(cycle, "sample");
  cycle.run(10s);
  cycle.begun(task_id(sample.number, 0), sample.links[0].start);
  Time now = 20s;
  for (; block_of_request(cycle, "sample").links[0].end < now + 400s; now += 10s) cycle.run(now);
  cycle.request(task_named(network_, "view"));
  cycle.run(now);
  const Block view = block_of_request(cycle, "view");
  ASSERT_LT(view.links[0].start, block_of_request(cycle, "sample").links[0].end);
  for (; now < view.links[0].start; now += 10s) cycle.run(now);
  const Link& closing = block_of_request(cycle, "view").links[0];
  ASSERT_EQ(closing.stage, Stage::committed);
  ASSERT_GT(block_of_request(cycle, "sample").links[0].end, closing.start);
  EXPECT_EQ(closing.start, view.links[0].start);
}

// Condemns one chain from some time on, as a signature does a sample.
class Condemning final : public assessor::Assessor {
 public:
  std::uint32_t condemned = 1U << 31U;
  temporal::RankVector predicted(std::uint32_t chain, const assessor::Context& context) const override {
    return chain == condemned ? temporal::RankVector{-1} : usual_.predicted(chain, context);
  }
  temporal::RankVector most(std::uint32_t chain, const assessor::Context& context) const override {
    return usual_.most(chain, context);
  }
  bool contextual(std::uint32_t, const assessor::Context&) const override { return true; }

 private:
  assessor::NetworkAssessor usual_;
};

TEST_F(CycleTest, WhatBreaksARuleOfTheMissionByNowIsTakenOut) {
  Condemning judge;
  chains_ = flattening::flatten_all(network_);
  Cycle cycle(network_, chains_, judge, *scheduler_, Time{0}, {});
  cycle.run(Time{0});
  ASSERT_THAT(requests(cycle), Contains("view"));
  judge.condemned = block_of_request(cycle, "view").chain;
  cycle.doubt();
  const Report report = cycle.run(10s);
  EXPECT_THAT(requests(cycle), Not(Contains("view")));
  EXPECT_THAT(report.notes, Contains(HasSubstr("it breaks a rule of the mission")));
}

// `idle` draws 1 W for 300 s, as a hotel load does.
TEST_F(CycleTest, WhereTheBudgetDoesNotLastTheMissionEndsBefore) {
  Cycle cycle = make();
  cycle.run(Time{0});
  const Block load = block_of_request(cycle, "idle");
  const Time start = load.links.front().start;
  cycle.run(start);
  cycle.begun(task_id(load.number, 0), start);
  cycle.observe(testing::kBattery, start, 200);
  const Report report = cycle.run(start + 10s);
  EXPECT_THAT(report.notes, Contains(HasSubstr("does not last")));
  const Time end = block_of_request(cycle, "idle").links.front().end;
  EXPECT_EQ(end, start + 10s + 95s) << "half of the 190 J that are left then";
  for (const Block& one : cycle.blocks())
    if (!one.begun()) {
      EXPECT_LE(one.links.back().end, end);
    }
  // It was said to end there, and does not.
  for (Time now = start + 20s; now < end + 60s; now += 10s) cycle.run(now);
  EXPECT_GT(block_of_request(cycle, "idle").links.front().end, end + 50s);
  EXPECT_NO_THROW(cycle.ended(task_id(load.number, 0), end + 60s, true));
  cycle.run(end + 60s);
  EXPECT_THAT(cycle.past().done, Contains(chains_.chains[load.chain].task));
}

// What the load has drawn since the newest report is not reported yet: a budget that lasts by the report lasts for
// whoever judges the plan.
TEST_F(CycleTest, ABudgetThatLastsByItsNewestReportLasts) {
  Cycle cycle = make();
  cycle.run(Time{0});
  const Block load = block_of_request(cycle, "idle");
  const Time start = load.links.front().start;
  cycle.run(start);
  cycle.begun(task_id(load.number, 0), start);
  cycle.observe(testing::kBattery, start + 5s, 290);
  EXPECT_THAT(cycle.run(start + 10s).notes, Not(Contains(HasSubstr("does not last")))) << "290 s are left";
  cycle.observe(testing::kBattery, start + 15s, 280);
  EXPECT_THAT(cycle.run(start + 19s).notes, Contains(HasSubstr("does not last"))) << "281 s are left";
}

// A command may say that it has succeeded although nothing has come of it; of a state only changes are reported.
TEST_F(CycleTest, WhatACommandWasToBringAboutAndNobodyReportsHasNotComeAbout) {
  network_.timelines[testing::kSite].reported = true;
  network_.tasks[task_named(network_, "dig")].commands = {{}};
  for (const bool comes_about : {false, true}) {
    Cycle cycle = make();
    cycle.observe(testing::kSite, Time{0}, 0);
    const Block first = sample_in(cycle);
    const Time end = first.links.front().end;
    cycle.begun(task_id(first.number, 0), first.links.front().start);
    cycle.ended(task_id(first.number, 0), end, true);
    cycle.run(end + 5s);
    EXPECT_EQ(cycle.timelines().value(testing::kSite, end + 5s), 1) << "the report may be on its way";
    if (comes_about) cycle.observe(testing::kSite, end + 6s, 1);
    cycle.run(end + 20s);
    EXPECT_EQ(cycle.timelines().value(testing::kSite, end + 20s), comes_about ? 1 : 0);
  }
}

// Of a state only changes are reported, so no second report corrects the first.
TEST_F(CycleTest, AReportThatIsHeardAfterItsCycleCountsUnlessANewerOneIsKnown) {
  Cycle cycle = make();
  cycle.run(Time{0});
  cycle.run(10s);
  cycle.observe(testing::kHealth, 9s, 1);
  EXPECT_EQ(cycle.timelines().value(testing::kHealth, 10s), 1);
  cycle.observe(testing::kHealth, 8s, 0);
  EXPECT_EQ(cycle.timelines().value(testing::kHealth, 10s), 1) << "it is older";
  cycle.run(20s);
  EXPECT_EQ(cycle.timelines().value(testing::kHealth, 20s), 1);
}

// An executive that was started again tells what the ground had said before tasks moved the timeline.
TEST_F(CycleTest, AnOldWordOfTheGroundChangesNothingThatATaskHasMadeSince) {
  Cycle cycle = make();
  const Block first = sample_in(cycle);
  const Time end = first.links.front().end;
  cycle.begun(task_id(first.number, 0), first.links.front().start);
  cycle.ended(task_id(first.number, 0), end, true);
  cycle.run(end + 10s);
  cycle.observe(testing::kSite, Time{0}, 0);
  EXPECT_EQ(cycle.timelines().value(testing::kSite, end + 10s), 1);

  Cycle again = make();
  again.resume(cycle.past(), cycle.blocks(), cycle.last_block(), end + 10s);
  again.run(end + 20s);
  again.observe(testing::kSite, end + 5s, 0);
  EXPECT_EQ(again.timelines().value(testing::kSite, end + 20s), 1) << "nor after the planner was";
  again.observe(testing::kSite, end + 15s, 0);
  EXPECT_EQ(again.timelines().value(testing::kSite, end + 20s), 0) << "a later one does";
}

// A view of Earth does not end with the battery; a plan without it would take what is in view for what stays so.
TEST_F(CycleTest, WhatComesFromOutsideOutlastsTheEarlyEnd) {
  model::Task sky;
  sky.id = sky.name = "sky";
  sky.fixed = true;
  sky.preferred_start = 100s;
  sky.duration = {400};
  network_.tasks.push_back(sky);
  Cycle cycle = make();
  cycle.run(Time{0});
  const Block load = block_of_request(cycle, "idle");
  const Time start = load.links.front().start;
  cycle.run(start);
  cycle.begun(task_id(load.number, 0), start);
  cycle.observe(testing::kBattery, start, 200);
  const Report report = cycle.run(start + 10s);
  ASSERT_THAT(report.notes, Contains(HasSubstr("does not last")));
  EXPECT_THAT(requests(cycle), Contains("sky"));
  cycle.doubt();
  cycle.run(start + 20s);
  EXPECT_THAT(requests(cycle), Contains("sky"));
}

// What was left for being there is planned with in the same way when that end has come: half of it, and so on.
TEST_F(CycleTest, WhatIsLeftOfTheBudgetAtThatEndIsPlannedWith) {
  Cycle cycle = make();
  cycle.run(Time{0});
  const TaskId load = task_id(block_of_request(cycle, "idle").number, 0);
  const Time start = block_of_request(cycle, "idle").links.front().start;
  cycle.run(start);
  cycle.begun(load, start);
  cycle.observe(testing::kBattery, start, 200);
  cycle.run(start + 10s);
  const Time end = block_of_request(cycle, "idle").links.front().end;
  cycle.observe(testing::kBattery, end + 5s, 80);
  cycle.run(end + 5s);
  EXPECT_EQ(block_of_request(cycle, "idle").links.front().end, end + 5s + 40s);
  cycle.ended(load, end + 10s, true);  // it is on the timelines still
  EXPECT_EQ(block_of_request(cycle, "idle").links.front().stage, Stage::succeeded);
}

TEST_F(CycleTest, AValueOutOfItsRangeIsRefused) {
  Cycle cycle = make();
  EXPECT_THAT(cycle.set_value(0, 1000), HasSubstr("dig_s = 1000"));
  EXPECT_EQ(cycle.past().values.front(), 100);
  EXPECT_EQ(cycle.set_value(0, 200), "");
  cycle.run(Time{0});
  const Link dig = block_of_request(cycle, "sample").links.front();
  EXPECT_EQ(dig.end - dig.start, 200s);
}

// Executes what is committed, with random durations, failures and battery levels; whatever happens, what was committed
// keeps its planned start, nothing is placed in the commit window, and no id comes twice.
TEST_F(CycleTest, RandomWorldsNeverMoveWhatIsCommitted) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(seed);
    const auto chance = [&](double p) { return std::uniform_real_distribution<>(0, 1)(random) < p; };
    Cycle cycle = make();
    std::map<TaskId, Time> committed, ends;
    double battery = 1000;
    for (Time now{0}; now < 2000s; now += 10s) {
      const std::uint32_t last = cycle.last_block();
      if (chance(0.2)) cycle.observe(testing::kBattery, now, battery = std::max(0.0, battery - 20));
      cycle.run(now);
      for (const Block& one : std::vector<Block>(cycle.blocks())) {
        for (std::size_t i = 0; i < one.links.size(); ++i) {
          const Link& link = one.links[i];
          const TaskId id = task_id(one.number, i);
          const bool bound = link.stage == Stage::committed || link.stage == Stage::running;
          EXPECT_TRUE(one.number <= last || link.planned >= now + 30s) << seed;
          EXPECT_TRUE(!bound || committed.try_emplace(id, link.planned).first->second == link.planned)
              << seed;
          EXPECT_TRUE(link.stage != Stage::planned || !committed.contains(id)) << seed;
          const bool ready = i == 0 || one.links[i - 1].stage == Stage::succeeded;
          if (link.stage == Stage::committed && link.planned <= now && ready && chance(0.8)) {
            cycle.begun(id, now);
            ends[id] = now + (chance(0.3) ? 3 : 1) * (link.end - link.start);
          } else if (link.stage == Stage::running && now >= ends[id]) {
            cycle.ended(id, now, chance(0.8));
          }
        }
      }
    }
  }
}

TEST_F(CycleTest, GoesOnWhereAnotherStood) {
  Cycle first = make();
  first.run(Time{0});
  first.run(10s);
  Cycle second = make();
  second.resume(first.past(), first.blocks(), first.last_block(), 10s);
  EXPECT_EQ(second.blocks(), first.blocks());
  second.run(20s);
  EXPECT_EQ(requests(second), requests(first));
  for (const Block& one : second.blocks()) EXPECT_LE(one.number, second.last_block());
}

}  // namespace
}  // namespace roci::planner::utility_htn::cycle
