// One plan is right; each damage to it is refused with the reason that an expert would name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/planner_svc/utility_htn/checking/small_mission.hpp"

namespace roci::planner::utility_htn::checking {
namespace {

using temporal::seconds;
using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(DamagedPlans, TheRightPlanHasNoFault) { EXPECT_THAT(SmallMission().faults(), IsEmpty()); }

struct Damage {
  const char* name;
  void (*damage)(SmallMission&);
  const char* reason;
};

class DamagedPlansWith : public testing::TestWithParam<Damage> {};

TEST_P(DamagedPlansWith, IsRefusedWithTheReason) {
  SmallMission mission;
  GetParam().damage(mission);
  EXPECT_THAT(mission.faults(), Contains(HasSubstr(GetParam().reason)));
}

const Damage kDamages[] = {
    {"UnknownTask", [](SmallMission& m) { m.step(20).task = 99; },
     "step 20 is not a primitive task of the network"},
    {"SameNumber", [](SmallMission& m) { m.step(20).id = 10; }, "two steps have the number 10"},
    {"StepMissing", [](SmallMission& m) { m.block(task::sample_0_1).steps.pop_back(); },
     "request 'sample_0_1': its steps are no decomposition"},
    {"OrderOfSteps", [](SmallMission& m) { std::swap(m.step(15).task, m.step(16).task); },
     "request 'sample_0_1': its steps are no decomposition"},
    {"GapTooLong",
     [](SmallMission& m) {
       m.network.tasks[task::sample_0_0].decompositions[0].subtasks[1].shortest_gap = seconds(1);
     },
     "request 'sample_0_0': its steps are no decomposition"},
    {"DecompositionNotNow",
     [](SmallMission& m) {
       m.observations = {{timeline::excavated, seconds(20), 1}};
     },
     "request 'sample_0_0': its steps are no decomposition"},
    {"RequestTwice",
     [](SmallMission& m) {
       m.plan.push_back(m.block(task::uplink));
       m.plan.back().steps[0].id = 21;
     },
     "request 'uplink' is planned twice"},
    {"RequestClosed", [](SmallMission& m) { m.closed = {task::uplink}; },
     "request 'uplink' is planned although it is closed"},
    {"InTheCommitWindow", [](SmallMission& m) { m.step(10).start = seconds(59); },
     "task 'excavate_0' at 59 s starts before the end of the commit window, 60 s, and is not committed"},
    {"FixedTime", [](SmallMission& m) { m.step(20).start = seconds(301); },
     "task 'uplink' at 301 s does not start at its fixed time, 300 s"},
    {"WindowNotOpen", [](SmallMission& m) { m.network.tasks[task::uplink].opens = seconds(301); },
     "task 'uplink' at 300 s starts before its window opens at 301 s"},
    {"WindowClosed", [](SmallMission& m) { m.network.tasks[task::uplink].closes = seconds(304); },
     "task 'uplink' at 300 s ends after its window closes at 304 s"},
    {"AfterTheEnd", [](SmallMission& m) { m.network.cycle.plan_end = seconds(304); },
     "task 'uplink' at 300 s ends after the end of the plan, 304 s"},
    {"CommittedMissing",
     [](SmallMission& m) {
       std::erase_if(m.plan, [](const Block& b) { return b.request == task::panorama; });
     },
     "committed task 'panorama' at 40 s is missing from the new version"},
    {"CommittedMoved", [](SmallMission& m) { m.step(2).start = seconds(45); },
     "committed task 'panorama' at 40 s was moved to 45 s"},
    {"CommitmentTakenBack", [](SmallMission& m) { m.step(2).committed = false; },
     "committed task 'panorama' at 40 s is no longer committed"},
    {"CommittedChanged", [](SmallMission& m) { m.step(2).task = task::uplink; },
     "committed task 'panorama' at 40 s has become another task"},
    {"Precondition", [](SmallMission& m) { m.step(11).start = seconds(109); },
     "task 'collect' at 109 s: its precondition on 'excavated_0' is broken at 109 s, where the value is no "
     "and not yes"},
    {"MaintenanceCondition",
     [](SmallMission& m) {
       m.observations = {{timeline::phase, seconds(20), 0}};
     },
     "task 'uplink' at 300 s: its maintenance condition on 'phase' is broken at 300 s, where the value is "
     "landing and not surface"},
    {"Postcondition",
     [](SmallMission& m) {
       m.observations = {{timeline::memory, seconds(20), 65}};
     },
     "task 'analyze' at 130 s: its postcondition on 'memory' is broken at 160 s, where the value is 105 and "
     "not -inf to 100"},
    {"TwoTasksOneArm", [](SmallMission& m) { m.step(14).start = seconds(120); },
     "timeline 'arm' leaves its range at 120 s: its value is 2, the range 0 to 1"},
    // 100 J are left after 2 s of hotel load, and excavating takes all of it.
    {"BatteryEmpty",
     [](SmallMission& m) {
       m.observations = {{timeline::battery, seconds(20), 140}};
     },
     "timeline 'battery' leaves its range at 110 s"},
    {"Budget", [](SmallMission& m) { m.budget = 259; },
     "the plan costs 260, more than the 259 that are left of the budget"},
    {"SentBeforeItIs", [](SmallMission& m) { m.product("raw_b").window = 0; },
     "Mandatory product 'raw_b' goes with 'evening', before it is created"},
    {"SizeUnlikeTheNetwork", [](SmallMission& m) { m.product("raw_a").bytes = 300; },
     "product 'raw' of task 'analyze' at 130 s has another size than in the network"},
    {"TierUnlikeTheNetwork", [](SmallMission& m) { m.product("summary_a").tier = model::Tier::mandatory; },
     "product 'summary' of task 'analyze' at 130 s has another tier than in the network"},
    {"CreationUnlikeThePlan", [](SmallMission& m) { m.product("raw_a").created = seconds(150); },
     "product 'raw' of task 'analyze' at 130 s is not created when that ends"},
    {"ProductForgotten", [](SmallMission& m) { m.downlinks.products.erase(m.downlinks.products.begin()); },
     "product 'raw' of task 'analyze' at 130 s stands in the downlinks 0 times"},
    {"ProductTwice", [](SmallMission& m) { m.downlinks.products.push_back(m.product("photo")); },
     "product 'photo' stands in the downlinks twice"},
    {"NoDownlink", [](SmallMission& m) { m.product("raw_a").window.reset(); },
     "task 'analyze' at 130 s is planned although its product 'raw' is not sent"},
    {"NotNamed", [](SmallMission& m) { m.product("photo").window.reset(); },
     "Residual product 'photo' is not sent, and nothing says why"},
    {"ResidualDisplaces",
     [](SmallMission& m) {
       m.product("photo").bytes = 500;
       m.downlinks.products.push_back({.id = "map", .bytes = 150, .created = seconds(161), .reported = true});
       m.downlinks.windows.erase(m.downlinks.windows.begin() + 1);
       m.product("raw_b").window.reset();
       m.product("summary_b").window.reset();
     },
     "Mandatory product 'map' is not sent although 'evening' has room for it but for Residual products"},
    {"DecisionalLate", [](SmallMission& m) { m.product("summary_a").window = 1; },
     "Decisional product 'summary_a' does not go with the first window after its creation, 'evening', and "
     "nothing says why"},
    {"EarthOutOfView", [](SmallMission& m) { m.downlinks.windows[1].bytes_per_s = 44; },
     "downlink 'morning' with 450 bytes would go on when Earth is no longer in view"},
    {"RadioTooHot", [](SmallMission& m) { m.downlinks.windows[1].heat_limit_s = 4; },
     "downlink 'morning' with 450 bytes would overheat the radio"},
    {"EnergyOfOneDownlink", [](SmallMission& m) { m.downlinks.windows[1].energy_limit_j = 89; },
     "downlink 'morning' with 450 bytes takes more than the energy limit of one downlink"},
    {"EnergyOfTheSol", [](SmallMission& m) { m.downlinks.sol_energy_j[0] = 239; },
     "the downlinks of sol 0 take 240 J of the 239 J that they may"},
    {"NegativeSite",
     [](SmallMission& m) {
       m.observations = {{timeline::signature_0_2, seconds(20), 1}};
     },
     "sample 'sample_0_0': a signature of site 'site_0' is negative, which ends sampling there"},
    {"SampledAlready",
     [](SmallMission& m) {
       m.observations = {{timeline::signature_0_0, seconds(20), 2}};
     },
     "sample 'sample_0_0': that target is sampled or closed already"},
    {"TooManySamples", [](SmallMission& m) { m.network.subway.most_samples = 1; },
     "sample 'sample_0_1': site 'site_0' would have more than 1 samples"},
    {"OrderOfTargets",
     [](SmallMission& m) { m.network.subway.sites[0].targets[2].visual = {.constant = 0.6}; },
     "sample 'sample_0_1': target 'sample_0_2' has the greater value and goes first"},
    {"OrderOfSites", [](SmallMission& m) { m.network.subway.sites[1].value = {.constant = 0.95}; },
     "sample 'sample_0_0': site 'site_1' has the greater value and goes first"},
    {"SiteBegun",
     [](SmallMission& m) {
       m.observations = {{timeline::signature_1_0, seconds(20), 2}};
     },
     "sample 'sample_0_0': site 'site_1' is begun and goes first"},
};

INSTANTIATE_TEST_SUITE_P(All, DamagedPlansWith, testing::ValuesIn(kDamages),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(DamagedPlans, AConflictOfWhatIsCommittedIsNotThePlansFault) {
  SmallMission mission;
  std::erase_if(mission.plan, [](const Block& block) { return block.request == task::uplink; });
  mission.observations = {
      {timeline::phase, seconds(20), 0}};  // the panorama, which is committed, needs another
  EXPECT_THAT(mission.faults(), IsEmpty());
}

TEST(DamagedPlans, WhatIsReportedIsNoFault) {
  SmallMission mission;
  mission.product("photo").bytes = 3000;
  mission.product("photo").window.reset();
  mission.product("photo").reported = true;
  EXPECT_THAT(mission.faults(), IsEmpty());
}

TEST(DamagedPlans, AClosedTargetIsPassed) {
  SmallMission mission;
  mission.network.subway.sites[0].targets[2].visual = {.constant = 0.9};
  mission.closed = {task::sample_0_2};
  EXPECT_THAT(mission.faults(), IsEmpty());
}

// Its first step digs what nobody can dig again.
TEST(DamagedPlans, ASiteThatNothingLeadsToIsPassed) {
  SmallMission mission;
  mission.network.subway.sites[1].value = {.constant = 0.95};
  EXPECT_THAT(mission.faults(), Not(IsEmpty()));
  mission.network.timelines.push_back({"lid", temporal::timelines::Kind::state, {"shut", "open"}});
  const auto lid = static_cast<temporal::timelines::Index>(mission.network.timelines.size() - 1);
  for (const model::Target& target : mission.network.subway.sites[1].targets)
    for (model::Decomposition& way : mission.network.tasks[target.task].decompositions)
      way.when.push_back({.timeline = lid, .states = 2});
  EXPECT_THAT(mission.faults(), Not(IsEmpty())) << "somebody may open it";
  mission.network.tasks[task::excavate].impacts.push_back(
      {lid, temporal::ImpactKind::assign, temporal::ImpactWhen::at_start, {0}});
  EXPECT_THAT(mission.faults(), IsEmpty()) << "tasks only shut it";
}

// Digging opens the lid, and what dug was broken off.
TEST(DamagedPlans, ASiteWhoseOpeningWasBrokenOffIsPassed) {
  SmallMission mission;
  mission.network.subway.sites[1].value = {.constant = 0.95};
  mission.network.timelines.push_back({"lid", temporal::timelines::Kind::state, {"shut", "open"}});
  const auto lid = static_cast<temporal::timelines::Index>(mission.network.timelines.size() - 1);
  for (const model::Target& target : mission.network.subway.sites[1].targets)
    for (model::Decomposition& way : mission.network.tasks[target.task].decompositions)
      way.when.push_back({.timeline = lid, .states = 2});
  model::Task open;
  open.id = open.name = "open_lid";
  open.impacts = {{lid, temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, {1}}};
  mission.broken_off = {static_cast<model::TaskIndex>(mission.network.tasks.size())};
  mission.network.tasks.push_back(open);
  EXPECT_THAT(mission.faults(), IsEmpty());
  mission.broken_off.clear();
  EXPECT_THAT(mission.faults(), Contains(HasSubstr("site 'site_1' has the greater value and goes first")))
      << "somebody may open it";
}

TEST(DamagedPlans, ATaskOfNoDurationAsksBeforeAndActsThen) {
  SmallMission mission;
  model::Task& uplink = mission.network.tasks[task::uplink];
  using temporal::timelines::Phase;
  uplink.duration = {};
  uplink.impacts = {{timeline::phase, temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, {0}}};
  uplink.constraints = {{.timeline = timeline::phase, .phase = Phase::pre, .states = 2},
                        {.timeline = timeline::phase, .phase = Phase::post, .states = 1}};
  EXPECT_THAT(mission.faults(), IsEmpty());
  uplink.constraints[0].states = 1;
  EXPECT_THAT(mission.faults(), Contains(HasSubstr("its precondition on 'phase' is broken")));
  uplink.constraints = {{.timeline = timeline::phase, .phase = Phase::post, .states = 2}};
  EXPECT_THAT(mission.faults(), Contains(HasSubstr("its postcondition on 'phase' is broken")));
}

// Two downlinks of 10 s at 2 W.
TEST(DamagedPlans, DownlinksKeepTheirLimitsOfEnergy) {
  SmallMission mission;
  mission.network.parameters = {{"rate_bytes_per_s", 100}, {"downlink_limit_j", 25}, {"sol_limit_j", 45}};
  mission.network.tasks[task::downlink].impacts.push_back(
      {timeline::battery, temporal::ImpactKind::rate, temporal::ImpactWhen::during, {.constant = -2}});
  const auto faults = [&](double one, double sol) {
    mission.values = {100, one, sol};
    return mission.faults();
  };
  EXPECT_THAT(faults(25, 45), IsEmpty());
  EXPECT_THAT(faults(15, 45), Contains(HasSubstr("J of the 15 J that one may")));
  EXPECT_THAT(faults(25, 35), Contains(HasSubstr("take 40 J of the 35 J that they may")));
  mission.network.parameters.push_back({"sol_s", 200});
  mission.values = {100, 25, 35, 200};
  EXPECT_THAT(mission.faults(), IsEmpty()) << "each has a sol of its own";
  mission.network.parameters.pop_back();
  for (const std::uint64_t first : {10U, 14U}) mission.step(first).committed = true;
  const auto of_limits = AnyOf(HasSubstr("that one may"), HasSubstr("that they may"));
  EXPECT_THAT(faults(15, 35), Not(Contains(of_limits))) << "what has begun goes on where no sol lasts for it";
  EXPECT_THAT(faults(25, 15), Not(Contains(of_limits))) << "what has begun goes on where no sol lasts for it";
  EXPECT_THAT(faults(25, 35), Contains(HasSubstr("take 40 J of the 35 J that they may")));
  mission.step(16).duration = seconds(13);
  EXPECT_THAT(faults(25, 60), Contains(HasSubstr("takes 26 J of the 25 J that one may")));
  EXPECT_THAT(faults(30, 45), Contains(HasSubstr("take 46 J of the 45 J that they may")));
}

TEST(DamagedPlans, WhatWasExecutedKeepsItsRealTimes) {
  SmallMission mission;
  mission.step(2).duration = seconds(15);  // it takes longer than the network says
  mission.observations = {{timeline::battery, seconds(20), 900}};
  EXPECT_THAT(mission.faults(), IsEmpty());
}

}  // namespace
}  // namespace roci::planner::utility_htn::checking
