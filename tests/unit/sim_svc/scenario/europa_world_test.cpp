// The world of missions/europa against what its planner foresees (model.yaml):
// other laws and other values, and not far off.
#include <gtest/gtest.h>

#include <filesystem>

#include "sim_svc/scenario/run_file.hpp"
#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::scenario {
namespace {

using temporal::seconds;
using temporal::Time;

// Is a command as model.yaml foresees it.
struct Foreseen {
  std::string component;
  std::string command;
  std::map<std::string, std::string> arguments;
  double seconds = 0;
  double watts = 0;
};

std::vector<Foreseen> mission_tasks() {
  std::vector<Foreseen> out{{"camera", "panorama", {}, 3600, 40},
                            {"camera", "find_sites", {}, 7200, 60},
                            {"arm", "prepare", {}, 3600, 150}};
  for (const std::string site : {"0", "1", "2"}) {
    out.push_back({"arm", "excavate", {{"site", site}}, 14 * 3600, 350});
    out.push_back({"camera", "find_targets", {{"site", site}}, 3600, 60});
    for (const std::string target : {"0", "1", "2"}) {
      if (target != "0") out.push_back({"arm", "discard", {}, 1800, 80});
      out.push_back({"arm", "collect", {{"site", site}, {"target", target}}, 5.5 * 3600, 250});
      out.push_back({"arm", "transport", {}, 3600, 100});
      out.push_back(
          {"laboratory", "analyze", {{"site", site}, {"target", target}, {"form", "raw"}}, 10800, 90});
      out.push_back({"radio", "prepare", {}, 1800, 80});
    }
  }
  return out;
}

RunSetup europa() { return load_run(ROCI_SOURCE_DIR "/missions/europa", "nominal"); }

// What was measured of all tasks of one kind, by the sum, as a share of what was foreseen.
struct Share {
  double seconds = 0, foreseen_s = 0, joules = 0, foreseen_j = 0;
};

std::map<std::string, Share> shares(std::uint64_t seed) {
  Flight run(europa().world, seed);
  std::map<std::string, Share> out;
  Time now{};
  int count = 0;
  for (const Foreseen& one : mission_tasks()) {
    const std::string activity = one.command + std::to_string(++count);
    run.command(now, execute(activity, one.component, one.command, one.arguments));
    for (int i = 0; i < 3000 && run.stage(activity) == services::owner::Stage::accepted; ++i)
      run.advance(now += seconds(60));
    EXPECT_EQ(run.code(activity), "done") << activity << ": " << run.last_ack(activity)->status.reason;
    const auto results = run.last_ack(activity)->status.results;
    Share& share = out[one.component + " " + one.command];
    share.seconds += temporal::to_seconds(results.duration.value_or(temporal::Duration{}));
    share.joules += results.energy_j.value_or(0);
    share.foreseen_s += one.seconds;
    share.foreseen_j += one.seconds * one.watts;
    now += seconds(900);
  }
  return out;
}

TEST(EuropaWorld, WhatIsForeseenIsWrongBySomeTenPercentAndNotByMore) {
  for (const std::uint64_t seed : {1, 2}) {
    for (const auto& [what, share] : shares(seed)) {
      const double s = share.seconds / share.foreseen_s, j = share.joules / share.foreseen_j;
      EXPECT_GT(s, 0.85) << what;
      EXPECT_LT(s, 1.15) << what;
      EXPECT_GT(j, 0.8) << what;
      EXPECT_LT(j, 1.2) << what;
      EXPECT_NE(s, 1) << what;
    }
  }
}

TEST(EuropaWorld, AtRestItDrawsTheHotelLoad) {
  Flight run(europa().world);
  run.advance(seconds(86400));
  EXPECT_NEAR((180e6 - last_number(run.said, "lander.battery")) / 86400, 20, 1);
}

TEST(EuropaWorld, EachZoneStaysInItsRangeWithColdSurroundings) {
  RunSetup setup = europa();
  setup.world.robots.at(0).thermal->surroundings_k = 85;
  Flight run(setup.world);
  run.advance(seconds(400000));
  EXPECT_GE(last_number(run.said, "lander.heat.arm"), 110);
  EXPECT_GE(last_number(run.said, "lander.heat.vault"), 240);
  EXPECT_GE(last_number(run.said, "lander.heat.antenna"), 120);
}

}  // namespace
}  // namespace roci::sim::scenario
