// Blocks as a flexible plan and back.
#include "planner_svc/utility_htn/adapter/plan_of.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"

namespace roci::planner::utility_htn::adapter {
namespace {

using namespace std::chrono_literals;
using cycle::Stage, cycle::task_id;
using temporal::CommitState, temporal::FlexiblePlan, temporal::PlanActivity, temporal::Time;
using ::testing::ElementsAre, ::testing::IsEmpty;

class PlanOf : public ::testing::Test {
 protected:
  FlexiblePlan plan(std::uint32_t version) {
    FlexiblePlan out =
        plan_of(network_, chains_, cycle_, {"utility_htn", "lander", version, Time{0}, {"ground/mission"}},
                told_, points_);
    told_ = out;
    return out;
  }

  const PlanActivity& named(const FlexiblePlan& plan, const std::string& name) const {
    for (const PlanActivity& one : plan.activities)
      if (one.name == name) return one;
    throw std::logic_error("no activity " + name);
  }

  model::Network network_ = testing::toy_network();
  flattening::Chains chains_ = flattening::flatten(network_);
  assessor::NetworkAssessor assessor_;
  std::unique_ptr<search::Scheduler> scheduler_ = search::make_scheduler("earliest");
  cycle::Cycle cycle_{network_, chains_, assessor_, *scheduler_, Time{0}};
  FlexiblePlan told_;
  Points points_;
};

TEST_F(PlanOf, IsWellFormedAndHoldsWhatTheExecutiveNeeds) {
  cycle_.run(Time{0});
  const FlexiblePlan whole = plan(1);
  EXPECT_THAT(temporal::check(whole), IsEmpty());
  const PlanActivity& dig = named(whole, "dig");
  EXPECT_EQ(dig.duration_lower, 100s);
  EXPECT_EQ(temporal::describe(dig.pre), "health = works and arm <= 0") << "who is late may still hold it";
  EXPECT_EQ(temporal::describe(named(whole, "send_sample").skip_if).substr(0, 19), "not activity.image#")
      << "nothing is sent where no image was taken";
  EXPECT_EQ(dig.lateness, temporal::LatenessPolicy::push);
  EXPECT_EQ(dig.failure, temporal::FailureScope::of_activity);
  EXPECT_THAT(dig.goals_served, ElementsAre("ground/mission"));
  EXPECT_EQ(dig.commit, CommitState::planned);
}

TEST_F(PlanOf, ComesBackAsTheBlocksOfWhichItWasMade) {
  cycle_.run(Time{0});
  cycle_.run(10s);
  const Recovered again = recover(network_, chains_, plan(1));
  EXPECT_EQ(again.blocks, cycle_.blocks());
  EXPECT_EQ(again.past, cycle_.past());
  EXPECT_EQ(again.last_block, cycle_.last_block());
}

TEST_F(PlanOf, RemembersWhatIsDoneWithdrawnAndLearned) {
  cycle_.run(Time{0});
  ASSERT_EQ(cycle_.set_value(0, 120), "");
  Time now{0};
  while (cycle_.past().done.size() < 2 && now < 3000s) {
    now += 10s;
    cycle_.run(now);
    for (const cycle::Block& one : std::vector<cycle::Block>(cycle_.blocks()))
      for (std::size_t i = 0; i < one.links.size(); ++i) {
        const cycle::Link& link = one.links[i];
        const bool ready = i == 0 || one.links[i - 1].stage == Stage::succeeded;
        if (link.stage == Stage::committed && link.planned <= now && ready)
          cycle_.begun(task_id(one.number, i), now);
        else if (link.stage == Stage::running && link.end <= now)
          cycle_.ended(task_id(one.number, i), now, true);
      }
  }
  ASSERT_GE(cycle_.past().done.size(), 2U);
  cycle_.withdraw(testing::task_named(network_, "idle"));
  cycle::Past failed = cycle_.past();
  failed.failures = {{testing::task_named(network_, "sample"), 2},
                     {testing::task_named(network_, "view"), 3}};
  cycle_.resume(failed, {}, cycle_.last_block(), now);
  EXPECT_EQ(recover(network_, chains_, plan(2)).past, cycle_.past());
}

TEST_F(PlanOf, WhatIsCommittedStandsAsItWasTold) {
  cycle_.run(Time{0});
  cycle_.run(10s);
  const FlexiblePlan first = plan(1);
  ASSERT_EQ(cycle_.set_value(0, 300), "");
  cycle_.run(20s);
  const FlexiblePlan second = plan(2);
  std::size_t kept = 0;
  for (const PlanActivity& before : first.activities) {
    if (before.commit != CommitState::committed) continue;
    for (const PlanActivity& after : second.activities)
      if (after.id == before.id) {
        EXPECT_EQ(after, before);
        ++kept;
      }
  }
  EXPECT_GT(kept, 0U);
}

TEST_F(PlanOf, APlanOfAnotherNetworkIsRefused) {
  cycle_.run(Time{0});
  FlexiblePlan foreign = plan(1);
  for (temporal::Token& token : foreign.tokens)
    if (token.start_point != temporal::origin_point) token.held = temporal::state("elsewhere", {"3"});
  EXPECT_THROW(recover(network_, chains_, foreign), std::invalid_argument);
}

TEST_F(PlanOf, ANewPlanBeginsWithTheValuesThatNobodyReports) {
  const PlanActivity initial =
      initial_activity(network_, cycle_.past(), {"utility_htn", "lander", 7, Time{0}, {}});
  EXPECT_EQ(initial.id, "network#7");
  EXPECT_TRUE(initial.owner.empty());
  ASSERT_EQ(initial.impacts.size(), 2U);
  EXPECT_EQ(initial.impacts.front().timeline, "site");
  EXPECT_EQ(initial.impacts.front().amount, temporal::state("closed"));
}

TEST(ActivityIds, GoThereAndBack) {
  EXPECT_EQ(task_of("collect_1_2#12.3"), task_id(12, 3));
  for (const char* foreign :
       {"", "collect", "collect#", "collect#1", "collect#1.", "collect#.1", "a#1.2x", "network#7"})
    EXPECT_EQ(task_of(foreign), std::nullopt) << foreign;
}

TEST(TimelineValues, GoThereAndBack) {
  const temporal::timelines::Definition place{
      "nav", temporal::timelines::Kind::state, {"idle-at(wp-1)", "true", "on"}};
  for (const double number : {0.0, 1.0, 2.0}) EXPECT_EQ(number_of(place, value_of(place, number)), number);
  EXPECT_EQ(number_of(place, temporal::state("elsewhere")), std::nullopt);
  const temporal::timelines::Definition battery{"battery"};
  EXPECT_EQ(number_of(battery, temporal::Value{12.5}), 12.5);
  EXPECT_EQ(number_of(battery, temporal::Value{std::numeric_limits<double>::quiet_NaN()}), std::nullopt);
}

}  // namespace
}  // namespace roci::planner::utility_htn::adapter
