// The utility-driven engine and the executive of flight against a world of tasks: whole flights,
// each strategy, surprises.
#include "bench/europa/task_flight.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"

namespace roci::bench::europa {
namespace {

using namespace std::chrono_literals;
using planner::utility_htn::adapter::UtilityEngine;
using planner::utility_htn::testing::task_named;
using planner::utility_htn::testing::toy_network;
using ::testing::ElementsAre, ::testing::IsEmpty;

namespace model = planner::utility_htn::model;

/// The toy network with commands, so that what it does can take longer and fail.
model::Network commanded_network() {
  model::Network out = toy_network();
  out.timelines.front().initial = out.timelines.front().highest = 2000;
  for (model::Task& task : out.tasks) {
    if (!task.primitive() || task.id == "idle") continue;
    task.commands.push_back(
        {.owner = "sim_svc", .robot = {}, .subsystem = task.id, .command_name = "do", .arguments = {}});
    task.control.retries = 1;
    task.products = {{"data of " + task.id, model::Tier::mandatory, {1000}, {}}};
  }
  return out;
}

Flown flown(const model::Network& network, Strategy strategy, const Fates& fates, Costs costs = {}) {
  planner::utility_htn::cycle::Settings settings;
  if (strategy != Strategy::replanning)
    settings = {.repairs = false, .optimizes = false, .schedules_again = false};
  UtilityEngine engine({"utility_htn", "lander", "", ""}, network, settings);
  return fly({network, engine, fates, strategy, costs, 20000s});
}

const Fates kAsPlanned = [](const std::string&, std::uint32_t) { return Fate{}; };

Fates failing_once(const std::string& task, Resolution failure) {
  return [=](const std::string& name, std::uint32_t execution) {
    return Fate{1, 1, name == task && execution == 0 ? failure : Resolution::none};
  };
}

TEST(TaskFlight, FliesTheWholeNetworkWhereNothingGoesWrong) {
  const model::Network network = commanded_network();
  const Flown out = flown(network, Strategy::replanning, kAsPlanned);
  EXPECT_THAT(out.faults, IsEmpty());
  EXPECT_EQ(out.utility, (temporal::RankVector{12.1}));
  EXPECT_NEAR(out.spent, 200 + 50 + 100 + 50 + 100 + 300, 1e-3);
  EXPECT_EQ(out.ended_by, "nothing left");
  EXPECT_EQ(out.failures, 0U);
}

TEST(TaskFlight, WithoutRecoveryTheFirstFailureEndsIt) {
  const model::Network network = commanded_network();
  const Flown out = flown(network, Strategy::as_planned, failing_once("dig", Resolution::flexible));
  EXPECT_EQ(out.ended_by, "failure");
  EXPECT_LT(out.utility, (temporal::RankVector{12}));
}

TEST(TaskFlight, TheExecutiveRetriesWhatItCanAndNothingIsPlannedAnew) {
  const model::Network network = commanded_network();
  const Flown out = flown(network, Strategy::flexible_execution, failing_once("dig", Resolution::flexible));
  EXPECT_THAT(out.faults, IsEmpty());
  EXPECT_EQ(out.utility, (temporal::RankVector{12.1}));
  EXPECT_EQ(out.retried, 1U);
  EXPECT_EQ(out.by_ground, 0U);
}

TEST(TaskFlight, TheGroundResolvesEverythingAtItsPrice) {
  const model::Network network = commanded_network();
  const Costs costs{0, 40, 600s};
  const Flown out = flown(network, Strategy::ground, failing_once("image", Resolution::flexible), costs);
  EXPECT_THAT(out.faults, IsEmpty());
  EXPECT_EQ(out.by_ground, 1U);
  EXPECT_GE(out.spent, 800 + 40);
  EXPECT_EQ(out.ended_by, "nothing left");
}

TEST(TaskFlight, WaitingForTheGroundDrawsNothingButItsPrice) {
  const model::Network network = commanded_network();
  const Fates fates = failing_once("image", Resolution::flexible);
  const Flown brief = flown(network, Strategy::ground, fates, {0, 40, 100s});
  const Flown lasting = flown(network, Strategy::ground, fates, {0, 40, 200s});
  EXPECT_NEAR(brief.energy.recovering, lasting.energy.recovering, 1e-6);
  const Flown free = flown(network, Strategy::ground, fates, {0, 0, 100s});
  EXPECT_NEAR(brief.energy.recovering - free.energy.recovering, 40, 1e-6);
  EXPECT_GT(free.energy.recovering, 0) << "the attempt that failed";
}

TEST(TaskFlight, TellsWhereItsEnergyWentAndWhatItDid) {
  const model::Network network = commanded_network();
  const Flown out = flown(network, Strategy::flexible_execution, failing_once("dig", Resolution::flexible));
  EXPECT_NEAR(out.energy.completed + out.energy.recovering + out.energy.broken_off + out.energy.fixed,
              out.spent, 1e-6);
  std::vector<std::string> dug;
  for (const Execution& one : out.executions)
    if (one.task == "dig") dug.push_back(one.result);
  EXPECT_THAT(dug, ElementsAre("failed", "done"));
}

// R100: the executive acts at each event, and most of its events need no planning.
TEST(TaskFlight, TellsWhatEachStepOfEngineAndExecutiveTook) {
  const model::Network network = commanded_network();
  UtilityEngine engine({"utility_htn", "lander", "", ""}, network, {});
  double clock = 0;
  Flight flight{.network = network, .engine = engine, .fates = kAsPlanned, .until = 20000s};
  flight.processor_time = [&] { return clock += 1; };
  const Flown out = fly(flight);
  const auto cycles = std::ranges::count_if(out.steps, &EngineStep::cycle);
  const auto searches = std::ranges::count_if(out.steps, [](const auto& step) { return step.explored > 0; });
  EXPECT_GT(cycles, 0);
  EXPECT_LT(cycles, static_cast<std::ptrdiff_t>(out.steps.size())) << "between cycles it only listens";
  EXPECT_LT(searches, static_cast<std::ptrdiff_t>(out.events.size()));
  EXPECT_THAT(out.events, ::testing::Each(1.0));
  EXPECT_THAT(out.steps, ::testing::Each(::testing::Field(&EngineStep::seconds, 1.0)));
}

TEST(TaskFlight, SeesWhatIsProjectedAndWhenATaskCouldStart) {
  const model::Network network = commanded_network();
  UtilityEngine engine({"utility_htn", "lander", "", ""}, network, {});
  Flight flight{.network = network, .engine = engine, .fates = kAsPlanned, .until = 20000s};
  flight.look_at = 60s;
  flight.look_for = {"image"};
  const Flown out = fly(flight);
  ASSERT_TRUE(out.seen.has_value());
  EXPECT_GE(out.seen->now, 60s);
  ASSERT_FALSE(out.seen->projection.empty());
  EXPECT_EQ(out.seen->projection.front().time, out.seen->now);
  EXPECT_NEAR(out.seen->projection.back().value, 2000 - out.spent, 1e-6) << "as it then went";
  ASSERT_FALSE(out.seen->valid.at("image").empty());
  for (const auto& [task, intervals] : out.seen->valid)
    for (const auto& one : intervals) EXPECT_GE(one.earliest, out.seen->now + network.cycle.commit_window);
}

TEST(TaskFlight, EqualFlightsDecideAlike) {
  const model::Network network = commanded_network();
  const Fates fates = failing_once("dig", Resolution::replanning);
  const Flown one = flown(network, Strategy::replanning, fates);
  EXPECT_EQ(one.decisions, flown(network, Strategy::replanning, fates).decisions);
  EXPECT_NE(one.decisions, flown(network, Strategy::replanning, kAsPlanned).decisions);
}

TEST(TaskFlight, WhatFlexibleExecutionCannotResolveIsPlannedAnew) {
  const model::Network network = commanded_network();
  const Flown out =
      flown(network, Strategy::replanning, failing_once("dig", Resolution::replanning), {25, 40, 600s});
  EXPECT_THAT(out.faults, IsEmpty());
  EXPECT_EQ(out.replanned, 1U);
  EXPECT_EQ(out.retried, 0U);
  std::set<std::uint32_t> blocks;
  for (const Execution& one : out.executions)
    if (one.task == "dig") blocks.insert(one.block);
  EXPECT_EQ(blocks.size(), 2U) << "the executive has not tried the same activity again";
  EXPECT_GE(out.utility, (temporal::RankVector{10})) << "the sample is taken all the same";
}

TEST(TaskFlight, WhereEnergyRunsOutTheFlightEnds) {
  model::Network network = commanded_network();
  network.timelines.front().initial = 360;
  const Flown out = flown(network, Strategy::replanning, [](const std::string&, std::uint32_t) {
    return Fate{1, 1.5, Resolution::none};
  });
  EXPECT_THAT(out.faults, IsEmpty());
  EXPECT_LE(out.spent, 360 + 1e-3);
}

// Whatever happens, the executive refuses no version, no more is spent than there is, and utility counts once.
TEST(TaskFlight, RandomWorldsEndWithoutARefusedVersion) {
  const model::Network network = commanded_network();
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    for (const Strategy strategy : {Strategy::ground, Strategy::flexible_execution, Strategy::replanning}) {
      const Fates fates = [&](const std::string& task, std::uint32_t execution) {
        std::seed_seq mixed{seed, static_cast<std::uint32_t>(task_named(network, task)), execution};
        std::mt19937 random(mixed);
        std::normal_distribution<> noise(1, 0.1);
        const double draw = std::uniform_real_distribution<>(0, 1)(random);
        const Resolution failure = draw < 0.08   ? Resolution::flexible
                                   : draw < 0.16 ? Resolution::replanning
                                   : draw < 0.22 ? Resolution::ground
                                                 : Resolution::none;
        return Fate{std::max(0.5, noise(random)), std::max(0.5, noise(random)), failure};
      };
      const Flown out = flown(network, strategy, fates, {5, 40, 300s});
      EXPECT_THAT(out.faults, IsEmpty()) << seed;
      EXPECT_LE(out.utility[0], 12.1 + 1e-9) << seed;
      EXPECT_LE(out.spent, 2000 + 1e-3) << seed;
    }
  }
}

}  // namespace
}  // namespace roci::bench::europa
