// The planner that knows a flight beforehand: against all choices of small networks,
// and against flights in the same world.
#include "bench/europa/prescient.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "bench/europa/experiment.hpp"
#include "planner_svc/utility_htn/flattening/chain.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"

namespace roci::bench::europa {
namespace {

using namespace std::chrono_literals;
using planner::utility_htn::model::Network, planner::utility_htn::model::Task;

const Network& base_domain() {
  static const Network network = planner::utility_htn::reading::load_network(
      std::filesystem::path(ROCI_SOURCE_DIR "/missions/europa/network.yaml"));
  return network;
}

Setting base_setting() { return read_setting(ROCI_SOURCE_DIR "/bench/europa/experiments.yaml"); }

/// Requests r0, r1, … without any structure but a shared last task: each is worth and costs what is given.
Network knapsack(const std::vector<std::pair<double, double>>& worth_and_cost, double shared) {
  Network out;
  out.ranks = {"science"};
  out.batches = {"all"};
  out.cycle.plan_end = 10000s;
  out.timelines.emplace_back();
  out.timelines.front() = {.name = "battery",
                           .kind = temporal::timelines::Kind::cumulative_rate,
                           .initial = 100,
                           .lowest = 0,
                           .highest = 100};
  const auto primitive = [&](const std::string& id, double worth, double cost) {
    Task task;
    task.id = id;
    task.is_template = true;
    task.duration = {1};
    task.utility = {{worth}};
    task.commands.push_back(
        {.owner = "sim_svc", .robot = {}, .subsystem = id, .command_name = "do", .arguments = {}});
    task.impacts = {{0, temporal::ImpactKind::rate, temporal::ImpactWhen::during, {-cost}}};
    out.tasks.push_back(task);
    return static_cast<planner::utility_htn::model::TaskIndex>(out.tasks.size() - 1);
  };
  const auto last = primitive("last", 0, shared);
  for (std::size_t i = 0; i < worth_and_cost.size(); ++i) {
    const auto own = primitive("own" + std::to_string(i), worth_and_cost[i].first, worth_and_cost[i].second);
    Task parent;
    parent.id = "r" + std::to_string(i);
    parent.decompositions = {{"only", {}, {{own}, {last}}}};
    out.tasks.push_back(parent);
  }
  return out;
}

Fates drawn(std::uint64_t seed) {
  return [seed](const std::string& task, std::uint32_t execution) {
    return fate({seed, 0, 0.3, planner::utility_htn::strategies::split(0.4, 0.3, 0.6)}, task, execution);
  };
}

TEST(Prescient, ASuccessPaysForTheFailuresBeforeIt) {
  const Network network = knapsack({{1, 10}}, 0);
  const std::map<std::uint32_t, Fate> fates{{0, {1, 1.1, Resolution::none}},
                                            {1, {1, 0.9, Resolution::flexible}},
                                            {2, {1, 1.2, Resolution::replanning}},
                                            {3, {1, 0.8, Resolution::ground}},  // of what replanning resolved
                                            {4, {1, 1.0, Resolution::ground}}};
  const Foreknowledge known{network,
                            [&](const std::string&, std::uint32_t execution) { return fates.at(execution); },
                            {3, 50, 60s}};
  const auto all = successes(known, network.tasks[1], 4);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_NEAR(all[0].energy, 11, 1e-9);
  EXPECT_NEAR(all[0].recovery, 0, 1e-9);
  EXPECT_NEAR(all[1].energy, 9, 1e-9);
  EXPECT_NEAR(all[1].recovery, 9, 1e-9);
  EXPECT_NEAR(all[2].energy, 8, 1e-9);
  EXPECT_NEAR(all[2].recovery, 12 + 3, 1e-9);
  EXPECT_NEAR(all[3].recovery, 10 + 50, 1e-9);
  EXPECT_NEAR(all[3].seconds, 62, 1e-9);
}

TEST(Prescient, ChoosesBestAmongAllSubsets) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::vector<std::pair<double, double>> items;
    for (std::uint32_t i = 0; i < 9; ++i) {
      const auto number = [&](std::uint32_t which) {
        return fate({.seed = seed}, "item", 10 * i + which).energy;
      };
      items.emplace_back(10 * number(0) - 7, 40 * number(1) - 20);
    }
    const Network network = knapsack(items, 5);
    const Foreknowledge known{network, drawn(seed), {3, 8, 0s}, {}, 100};
    double best = 0;
    for (std::uint32_t subset = 0; subset < 1U << items.size(); ++subset) {
      double utility = 0, cost = 0;
      std::size_t count = 0;
      for (std::size_t i = 0; i < items.size(); ++i) {
        if ((subset >> i & 1U) == 0) continue;
        const Success own = successes(known, network.tasks[2 * i + 1], 1).front();
        const Success shared = successes(known, network.tasks[0], ++count).back();
        utility += items[i].first;
        cost += own.energy + own.recovery + shared.energy + shared.recovery;
      }
      if (cost < known.budget) best = std::max(best, utility);
    }
    const Prescience found = prescient(known);
    EXPECT_TRUE(found.proven);
    EXPECT_NEAR(found.utility, best, 1e-6) << seed;
    EXPECT_LT(found.energy + found.recovery + found.fixed, 100) << seed;
  }
}

// No flight in the same world beats it, whatever the strategy; what nothing disturbs it does all.
TEST(Prescient, NoFlightBringsMore) {
  const Setting setting = base_setting();
  const Experiment experiment(base_domain(), setting);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Prescience known = experiment.prescient(0.1, seed);
    EXPECT_TRUE(known.proven);
    for (const Strategy strategy : {Strategy::ground, Strategy::flexible_execution, Strategy::replanning})
      EXPECT_LE(experiment.flown(strategy, 0.1, seed).utility[0], known.utility + 1e-9) << seed;
    EXPECT_LE(experiment.prescient(0.1, seed, 40e6).utility, known.utility + 1e-9);
  }
}

TEST(Prescient, WithoutFailuresItDoesWhatTheFlightDoes) {
  Setting setting = base_setting();
  setting.noise = 0;
  setting.failures = {};
  setting.discovery_share = 0;
  const Experiment experiment(base_domain(), setting);
  const Prescience known = experiment.prescient(0, 1);
  EXPECT_NEAR(known.utility, experiment.without_failures(0).utility[0], 1e-9);
  EXPECT_NEAR(known.recovery, 0, 1e-6);
}

// A collection whose chain broke off afterwards is no sample: the site keeps its three.
TEST(BaseDomain, ACollectionThatCameToNothingUsesUpNoSample) {
  const Setting setting = base_setting();
  const Network& network = base_domain();
  planner::utility_htn::adapter::UtilityEngine engine({"utility_htn", "lander", "", ""}, network,
                                                      {.downlinks = false});
  Flight flight{.network = network, .engine = engine, .fates = {}, .until = network.cycle.plan_end};
  flight.fates = [](const std::string& task, std::uint32_t execution) {
    const bool fails = task.starts_with("science_analyze_raw_0_") && !task.ends_with("2") && execution == 0;
    return Fate{1, 0.7, fails ? Resolution::replanning : Resolution::none};
  };
  const Flown out = fly(flight);
  std::map<char, int> samples;  // by site
  for (const Reached& one : out.course)
    if (one.chain.starts_with("sample_")) ++samples[one.chain[7]];
  EXPECT_EQ(samples, (std::map<char, int>{{'0', 3}, {'1', 3}, {'2', 3}}));
  EXPECT_EQ(out.replanned, 2U);
}

/// Each of these fails once so that the engine plans anew; everything else goes as the network has it.
class BaseDomainWith : public ::testing::TestWithParam<const char*> {};

TEST_P(BaseDomainWith, OneFailureCostsNoMoreThanASampleOfCompressedData) {
  Setting setting = base_setting();
  setting.only_failure = {GetParam(), Resolution::replanning};
  setting.without.insert("discovery");
  const Experiment experiment(base_domain(), setting);
  const Flown out = experiment.flown(Strategy::replanning, 0, 1);
  EXPECT_THAT(out.faults, ::testing::IsEmpty());
  EXPECT_EQ(out.replanned, 1U);
  EXPECT_GE(out.utility[0], 8.55 - 0.4 - 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Failing, BaseDomainWith,
                         ::testing::Values("excavate_site_1", "collect_sample_1_0", "transport_sample",
                                           "downlink_raw"));

}  // namespace
}  // namespace roci::bench::europa
