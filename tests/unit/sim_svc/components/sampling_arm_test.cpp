// What the sampling arm digs, collects and hands over, and what goes wrong with it.
#include "sim_svc/components/sampling_arm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/sim_svc/sampler.hpp"

namespace roci::sim::components {
namespace {

using services::owner::Stage;
using temporal::seconds;
using temporal::State;
using testing::HasSubstr;
using world::ComponentFault;
using world::ComponentMishap;
using world::HollowSuccess;
using world::TrenchCollapse;

const std::map<std::string, std::string> kSite{{"site", "0"}};
const std::map<std::string, std::string> kTarget{{"site", "0"}, {"target", "0"}};

double depth(const SamplerFlight& run, const std::string& site) {
  return last_number(run.said, "lander.arm.depth_" + site);
}

// A sampler whose arm is prepared.
SamplerFlight prepared(const Sampler& sampler = {}, std::uint64_t seed = 1) {
  SamplerFlight run(sampler, seed);
  EXPECT_EQ(run.arm("prepare"), "done");
  return run;
}

TEST(SamplingArm, TellsOfItsSitesAndItsSampleFromTheBeginning) {
  const SamplerFlight run;
  EXPECT_EQ(run.state("lander.site.0"), (State{"untouched", {}}));
  EXPECT_EQ(run.state("lander.site.1"), (State{"untouched", {}}));
  EXPECT_EQ(run.state("lander.sample"), (State{"none", {}}));
  EXPECT_EQ(run.state("lander.arm"), (State{"rests", {}}));
  EXPECT_EQ(depth(run, "0"), 0);
}

TEST(SamplingArm, BringsASampleFromTheIceToTheLaboratory) {
  SamplerFlight run = prepared();
  EXPECT_EQ(run.state("lander.arm"), (State{"ready", {}}));
  EXPECT_EQ(run.arm("excavate", kSite), "done");
  EXPECT_NEAR(run.seconds_taken(), 10000, 1e-3);
  EXPECT_NEAR(run.joules_taken(), 10000 * (100 / 0.5 + 60), 1) << "the cutter at its efficiency, and the arm";
  EXPECT_EQ(run.last_ack(run.newest)->status.results.values.at("depth_m"), temporal::Value{0.1});
  EXPECT_EQ(run.state("lander.site.0"), (State{"excavated", {}}));
  EXPECT_EQ(run.state("lander.site.1"), (State{"untouched", {}}));
  run.start("arm", "collect", kTarget);
  EXPECT_EQ(run.state("lander.arm"), (State{"collecting", {"0", "0"}}));
  run.pass(18001);
  EXPECT_EQ(run.code(run.newest), "done");
  EXPECT_NEAR(run.joules_taken(), 18000 * 170, 1);
  EXPECT_EQ(run.state("lander.sample"), (State{"held", {"0", "0"}}));
  EXPECT_EQ(run.arm("transport"), "done");
  EXPECT_EQ(run.state("lander.sample"), (State{"delivered", {"0", "0"}}));
  EXPECT_EQ(run.arm("collect", {{"site", "0"}, {"target", "1"}}), "done") << "the tool is free";
  EXPECT_EQ(run.arm("transport"), "done");
  EXPECT_EQ(run.state("lander.sample"), (State{"delivered", {"0", "1"}}));
  EXPECT_EQ(run.arm("discard"), "done");
  EXPECT_EQ(run.state("lander.sample"), (State{"none", {}}));
}

TEST(SamplingArm, RefusesWhatMakesNoSense) {
  SamplerFlight run;
  EXPECT_EQ(run.arm("excavate", kSite), "not-prepared");
  run.arm("prepare");
  EXPECT_EQ(run.arm("excavate", {{"site", "7"}}), "unknown-site");
  EXPECT_EQ(run.arm("collect", kTarget), "not-excavated");
  EXPECT_EQ(run.arm("transport"), "no-sample");
  run.arm("excavate", kSite);
  EXPECT_EQ(run.arm("collect", {{"site", "0"}, {"target", "9"}}), "unknown-target");
  run.arm("collect", kTarget);
  EXPECT_EQ(run.arm("collect", {{"site", "0"}, {"target", "1"}}), "not-empty");
  EXPECT_EQ(run.state("lander.sample"), (State{"held", {"0", "0"}}));
}

TEST(SamplingArm, PreparedAnewItHasAnEmptyTool) {
  SamplerFlight run = prepared();
  run.arm("excavate", kSite);
  run.arm("collect", kTarget);
  EXPECT_EQ(run.arm("prepare"), "done");
  EXPECT_EQ(run.state("lander.sample"), (State{"none", {}}));
  EXPECT_EQ(run.arm("collect", {{"site", "0"}, {"target", "1"}}), "done");
  EXPECT_EQ(run.arm("transport"), "done");
  EXPECT_EQ(run.arm("prepare"), "done");
  EXPECT_EQ(run.state("lander.sample"), (State{"delivered", {"0", "1"}})) << "the inlet is not the tool";
}

TEST(SamplingArm, MovesItsJointsToWhereItWorks) {
  Sampler sampler;
  sampler.arm.sites["0"].joints = {0, 0.5, -1, 0, 0};
  sampler.arm.joint_speed_rad_s = 0.01;
  SamplerFlight run = prepared(sampler);
  run.start("arm", "excavate", kSite);
  run.pass(50);
  EXPECT_NEAR(last_number(run.said, "lander.arm.q2"), -0.5, 0.11);
  EXPECT_EQ(depth(run, "0"), 0);
  run.pass(10051);
  EXPECT_EQ(run.code(run.newest), "done");
  EXPECT_NEAR(run.seconds_taken(), 10000 + 100, 1e-3) << "1 rad at 0.01 rad/s first";
  EXPECT_EQ(last_number(run.said, "lander.arm.q1"), 0.5);
  run.arm("discard");
  EXPECT_EQ(last_number(run.said, "lander.arm.q1"), 0);
}

TEST(SamplingArm, AStoppedExcavationStaysDugAndGoesOnFromThere) {
  SamplerFlight run = prepared();
  const std::string first = run.start("arm", "excavate", kSite);
  EXPECT_EQ(run.state("lander.arm"), (State{"digging", {"0"}}));
  run.pass(2500);
  run.command(run.now, execute("halt", "arm", "stop"));
  EXPECT_EQ(run.stage(first), Stage::cancelled);
  EXPECT_NEAR(depth(run, "0"), 0.025, 1e-3);
  EXPECT_EQ(run.state("lander.site.0"), (State{"untouched", {}})) << "a trench that is begun is none yet";
  EXPECT_EQ(run.state("lander.arm"), (State{"ready", {}}));
  EXPECT_EQ(run.arm("excavate", kSite), "done");
  EXPECT_NEAR(run.seconds_taken(), 7500, 1e-3);
  EXPECT_EQ(run.arm("excavate", kSite), "done");
  EXPECT_EQ(run.seconds_taken(), 0) << "it has its depth already";
}

TEST(SamplingArm, HarderIceIsDugAndSampledMoreSlowly) {
  Sampler sampler;
  sampler.arm.sites["0"].ice.specific_energy_j_m3 *= 1.5;
  SamplerFlight run = prepared(sampler);
  EXPECT_EQ(run.arm("excavate", kSite), "done");
  EXPECT_NEAR(run.seconds_taken(), 15000, 1e-3);
  run.arm("collect", kTarget);
  EXPECT_NEAR(run.seconds_taken(), 1.5 * 18000, 1e-3);
}

TEST(SamplingArm, WhereTheIceGivesWayNoMoreItGivesUpAndKeepsTheDepth) {
  Sampler sampler;
  sampler.arm.sites["0"].ice.deepest_m = 0.04;
  SamplerFlight run = prepared(sampler);
  EXPECT_EQ(run.arm("excavate", kSite), "too-hard");
  EXPECT_NEAR(run.seconds_taken(), 4000 + 1800, 1e-3);
  EXPECT_NEAR(depth(run, "0"), 0.04, 1e-9);
  EXPECT_EQ(run.state("lander.site.0"), (State{"untouched", {}}));
  EXPECT_EQ(run.arm("excavate", kSite), "too-hard");
  EXPECT_NEAR(run.seconds_taken(), 1800, 1e-3) << "it tries again, from there";
  EXPECT_EQ(run.arm("excavate", {{"site", "1"}}), "done") << "other sites are other ice";
}

TEST(SamplingArm, ACutterThatJamsLeavesWhatIsDugAndIsTriedAgain) {
  Sampler sampler;
  sampler.arm.sites["0"].jams_per_h = 1;
  SamplerFlight run = prepared(sampler, 5);
  double dug = 0, total = 0;
  int jams = 0;
  for (std::string code = "stuck"; code == "stuck" && jams < 30; ++jams) {
    code = run.arm("excavate", kSite);
    EXPECT_GE(depth(run, "0"), dug);
    dug = depth(run, "0");
    total += run.seconds_taken();
  }
  EXPECT_GT(jams, 1);
  EXPECT_EQ(run.state("lander.site.0"), (State{"excavated", {}}));
  EXPECT_NEAR(total, 10000, 0.1) << "no cutting is lost";
}

TEST(SamplingArm, ACollapsedTrenchIsDugAgain) {
  SamplerFlight run = prepared();
  run.arm("excavate", kSite);
  run.disturb(run.now, ComponentMishap{"lander", TrenchCollapse{"0", 0.3}});
  EXPECT_EQ(run.state("lander.site.0"), (State{"untouched", {}})) << "its depth is lost";
  EXPECT_EQ(run.arm("collect", kTarget), "not-excavated");
  EXPECT_EQ(run.arm("excavate", kSite), "done");
  EXPECT_NEAR(run.seconds_taken(), 7000, 1e-3);
}

TEST(SamplingArm, ATrenchThatCollapsesUnderTheCutterTakesLonger) {
  SamplerFlight run = prepared();
  run.start("arm", "excavate", kSite);
  run.pass(6000);
  run.disturb(run.now, ComponentMishap{"lander", TrenchCollapse{"0", 0.5}});
  run.disturb(run.now, ComponentMishap{"lander", TrenchCollapse{"1", 0}});
  run.pass(20000);
  EXPECT_EQ(run.code(run.newest), "done");
  EXPECT_NEAR(run.seconds_taken(), 6000 + 7000, 1e-3);
}

TEST(SamplingArm, ACutterJamsAfterAsMuchCuttingWhateverCollapses) {
  Sampler sampler;
  sampler.arm.sites["0"].jams_per_h = 1;
  int jams = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SamplerFlight calm = prepared(sampler, seed);
    if (calm.arm("excavate", kSite) != "stuck" || calm.seconds_taken() < 500) continue;
    SamplerFlight shaken = prepared(sampler, seed);
    shaken.start("arm", "excavate", kSite);
    shaken.pass(300);
    shaken.disturb(shaken.now, ComponentMishap{"lander", TrenchCollapse{"0", 0.5}});
    shaken.pass(20000);
    EXPECT_EQ(shaken.code(shaken.newest), "stuck");
    EXPECT_NEAR(shaken.seconds_taken(), calm.seconds_taken(), 1e-3) << "seed " << seed;
    ++jams;
  }
  EXPECT_GT(jams, 0);
}

TEST(SamplingArm, ACollapseNeedsASiteThatIsThere) {
  const SamplingArm arm(Sampler().arm, world::RandomStream(1, "arm"));
  EXPECT_EQ(arm.spared_from(TrenchCollapse{"0", 0}), "");
  EXPECT_THAT(arm.spared_from(TrenchCollapse{"5", 0}).value(), HasSubstr("no site '5'; known: 0, 1"));
  EXPECT_EQ(arm.spared_from(world::SlotBlock{"0"}), std::nullopt);
}

TEST(SamplingArm, AHollowSuccessIsToldAndChangesNothing) {
  SamplerFlight run = prepared();
  const auto hollow = [&](const std::string& command) {
    run.disturb(run.now, HollowSuccess{"lander", "arm", command});
  };
  hollow("excavate");
  EXPECT_EQ(run.arm("excavate", kSite), "done");
  EXPECT_EQ(run.last_ack(run.newest)->status.results.values.at("depth_m"), temporal::Value{0.1})
      << "as it believes";
  EXPECT_EQ(run.state("lander.site.0"), (State{"untouched", {}}));
  EXPECT_EQ(depth(run, "0"), 0);
  EXPECT_EQ(run.arm("excavate", kSite), "done");
  EXPECT_EQ(run.state("lander.site.0"), (State{"excavated", {}})) << "it was the next one alone";
  hollow("collect");
  EXPECT_EQ(run.arm("collect", kTarget), "done");
  EXPECT_EQ(run.arm("transport"), "no-sample");
  EXPECT_EQ(run.arm("collect", kTarget), "done");
  hollow("transport");
  EXPECT_EQ(run.arm("transport"), "done");
  EXPECT_EQ(run.state("lander.sample"), (State{"held", {"0", "0"}}));
}

TEST(SamplingArm, BreaksDownSlowsDownAndSticksByFaults) {
  SamplerFlight run = prepared();
  run.start("arm", "excavate", kSite);
  run.disturb(run.now + seconds(1000), ComponentFault{"lander", "arm", run.now + seconds(3000), 0.5});
  run.now += seconds(1000);
  run.pass(20000);
  EXPECT_NEAR(run.seconds_taken(), 11000, 1e-3) << "2000 s at half the pace cost 1000 s";
  run.disturb(run.now, ComponentFault{"lander", "arm", run.now + seconds(5000), 0});
  run.arm("discard");
  EXPECT_NEAR(run.seconds_taken(), 1500 + 4999, 1e-3);
  const std::string broken = run.start("arm", "discard");
  run.disturb(run.now + seconds(10), ComponentFault{"lander", "arm", run.now + seconds(60), {}});
  EXPECT_EQ(run.code(broken), "fault");
  EXPECT_EQ(run.state("lander.arm"), (State{"ready", {}}));
}

TEST(SamplingArm, NoiseAndTheFactorMakeTasksLongerOrShorter) {
  Sampler sampler;
  sampler.arm.duration_noise = sampler.arm.power_noise = 0.1;
  const auto taken = [&](std::uint64_t seed) {
    SamplerFlight run = prepared(sampler, seed);
    run.arm("discard");
    return std::pair(run.seconds_taken(), run.joules_taken() / run.seconds_taken());
  };
  EXPECT_EQ(taken(1), taken(1));
  EXPECT_NE(taken(1).first, taken(2).first);
  EXPECT_NE(taken(1).second, taken(2).second);
  Sampler quick;
  quick.arm.duration_factor = 0.8;
  SamplerFlight run = prepared(quick);
  run.arm("discard");
  EXPECT_NEAR(run.seconds_taken(), 0.8 * 1500, 1e-3);
}

TEST(SamplingArm, OutlivesTheProcessThatSpeaksForIt) {
  SamplerFlight run = prepared();
  run.arm("excavate", kSite);
  run.arm("collect", kTarget);
  run.start("arm", "excavate", {{"site", "1"}});
  run.pass(5000);
  world::World again(Sampler().build(), 1);
  again.restore(run.world.memory());
  const world::Outputs said = again.advance(run.now);
  EXPECT_EQ(last_value(said, "lander.site.0"), temporal::state("excavated"));
  EXPECT_EQ(last_value(said, "lander.sample"), temporal::state("held", {"0", "0"}));
  EXPECT_EQ(last_value(said, "lander.arm"), temporal::state("ready")) << "the digging is broken off there";
  EXPECT_NEAR(last_number(said, "lander.arm.depth_1"), 0.05, 1e-3);
}

// Newton's law by small steps: how long the heater at full power needs from 150 K to 220 K.
double integrated_warming_s() {
  double kelvin = 150, s = 0;
  for (; kelvin < 220; s += 0.01) kelvin += 0.01 * (200 - 0.5 * (kelvin - 100)) / 20000;
  return s;
}

TEST(SamplingArm, WarmsItsZoneFirstAndLeavesWasteHeatInIt) {
  Sampler sampler;
  sampler.make_cold();
  SamplerFlight run(sampler);
  run.start("arm", "prepare");
  EXPECT_EQ(run.state("lander.arm"), (State{"preparing", {}}));
  run.pass(60000);
  EXPECT_EQ(run.code(run.newest), "done");
  EXPECT_NEAR(run.seconds_taken(), integrated_warming_s() + 1200, 1);
  EXPECT_GT(run.joules_taken(), 200 * integrated_warming_s() + 1200 * 60)
      << "the heater counts as the task's";
  EXPECT_NEAR(last_number(run.said, "lander.heat.arm"), 150, 1.1) << "nobody holds it warm any more";
  run.start("arm", "discard");
  run.pass(integrated_warming_s() + 100);
  const double before = run.world.memory().robots.at("lander").energy_j.value();
  run.pass(500);
  const double used = before - run.world.memory().robots.at("lander").energy_j.value();
  // Of the arm's 60 W 18 W stay in the zone, which loses 60 W at 220 K; the laboratory's loses 25 W at 150 K.
  EXPECT_NEAR(used, 500 * (60 + 60 - 0.3 * 60 + 25), 50);
}

TEST(SamplingArm, WhereTheHeaterIsTooWeakItRefuses) {
  Sampler sampler;
  sampler.make_cold();
  sampler.thermal->zones[0].heater_w = 50;  // 60 W hold 220 K
  SamplerFlight run(sampler);
  EXPECT_EQ(run.arm("prepare"), "too-cold");
  EXPECT_EQ(run.state("lander.arm"), (State{"rests", {}}));
}

TEST(SamplingArm, AStoppedTaskHoldsItsZoneNoLonger) {
  Sampler sampler;
  sampler.make_cold();
  SamplerFlight run(sampler);
  run.start("arm", "prepare");
  run.pass(3000);
  EXPECT_GT(last_number(run.said, "lander.heat.arm"), 160);
  run.command(run.now, execute("halt", "arm", "stop"));
  run.pass(400000);
  EXPECT_NEAR(last_number(run.said, "lander.heat.arm"), 150, 1.1);
}

// One world is advanced all at once, one minute by minute.
TEST(SamplingArm, DoesNotDependOnHowTimeIsSliced) {
  Sampler sampler;
  sampler.arm.sites["0"].ice.layer_noise = 0.3;
  sampler.arm.sites["0"].joints = {1, 0, 0, 0, 0};
  sampler.arm.duration_noise = 0.1;
  sampler.make_cold();
  SamplerFlight whole = prepared(sampler), sliced = prepared(sampler);
  whole.start("arm", "excavate", kSite);
  sliced.start("arm", "excavate", kSite);
  whole.pass(60000);
  for (int i = 0; i < 6000; ++i) sliced.pass(10);
  EXPECT_EQ(whole.time_of(whole.newest), sliced.time_of(sliced.newest));
  EXPECT_NEAR(whole.joules_taken(), sliced.joules_taken(), 1e-3);
}

}  // namespace
}  // namespace roci::sim::components
