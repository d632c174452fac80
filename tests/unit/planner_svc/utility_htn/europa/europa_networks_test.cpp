// What the paper says of the lander's tasks, held against the files of missions/europa (R87–R91, R107).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/cli/first_plan.hpp"
#include "planner_svc/utility_htn/flattening/chain.hpp"
#include "planner_svc/utility_htn/model/describe.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"

namespace roci::planner::utility_htn {
namespace {

using flattening::Chain, flattening::Chains;
using model::Network, model::Task;
using testing::Contains;

const std::filesystem::path kMission = ROCI_SOURCE_DIR "/missions/europa";

class Europa {
 public:
  explicit Europa(const std::string& file)
      : network(reading::load_network(kMission / file)),
        chains(flattening::flatten(network)),
        values(model::priors(network)) {}

  const Chain& chain(const std::string& name) const {
    const auto found = std::ranges::find(chains.chains, name, &Chain::name);
    if (found == chains.chains.end()) throw std::out_of_range("no chain " + name);
    return *found;
  }
  double cost(const std::string& name) const { return flattening::cost(network, chain(name), values); }
  temporal::RankVector utility(const std::string& name) const {
    return flattening::utility(network, chain(name), values);
  }
  std::vector<std::string> ids(const std::string& name) const {
    std::vector<std::string> out;
    for (const auto& link : chain(name).links) out.push_back(network.tasks[link.task].id);
    return out;
  }
  const Task& task(const std::string& id) const {
    const auto found = std::ranges::find(network.tasks, id, &Task::id);
    if (found == network.tasks.end()) throw std::out_of_range("no task " + id);
    return *found;
  }
  double task_cost(const std::string& id) const { return model::cost(network, task(id), values); }
  std::size_t count(const std::string& pattern) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        network.tasks, [&](const Task& task) { return std::regex_match(task.id, std::regex(pattern)); }));
  }

  Network network;
  Chains chains;
  model::Values values;
};

// Labels of figure 8 leave out what MEXEC adds as the instance's number: here form, site and target,
// and whether it plans behind a sample.
std::vector<std::string> labels(const std::vector<std::string>& ids) {
  static const std::regex instance("(_raw|_compressed)?(_[0-9]_[0-9])?$");
  std::vector<std::string> out;
  for (const std::string& id : ids)
    out.push_back(id.starts_with("collect_sample") ? id
                  : id == "mexec_plan_process_sample"
                      ? "mexec_plan_process"
                      : std::regex_replace(id, instance, "", std::regex_constants::format_first_only));
  return out;
}

TEST(EuropaNetworks, AllAreUsableWithoutAWarning) {
  for (const char* file : {"network.yaml", "network-bsm1.yaml", "network-rsm1.yaml",
                           "network-one-target.yaml", "network-autonomous.yaml"}) {
    mission::Findings findings;
    EXPECT_TRUE(reading::load_network(kMission / file, findings)) << file;
    for (const auto& finding : findings.all()) ADD_FAILURE() << finding.text();
  }
}

TEST(EuropaNetworks, TheGroundSendsTheNetworkOfOneTargetAsItStandsInItsFile) {
  const Network sent = reading::load_network(kMission / "one-target.htn");
  const Network written = Europa("network-one-target.yaml").network,
                before = Europa("network-rsm1.yaml").network;
  EXPECT_TRUE(sent == written) << "pack network-one-target.yaml anew";
  EXPECT_EQ(sent.subway.most_samples, 1U);
  EXPECT_GT(sent.version, before.version);
  Network back = sent;  // nothing else is different
  back.version = before.version;
  back.subway.most_samples = before.subway.most_samples;
  EXPECT_TRUE(back == before);
}

// R109.
TEST(EuropaNetworks, TheFlagIsYesFromTheBeginningWhereTheNetworkSaysSo) {
  for (const auto& [file, initial] :
       {std::pair("network-rsm1.yaml", "no"), std::pair("network-autonomous.yaml", "yes")}) {
    const Network network = Europa(file).network;
    const auto flag =
        std::ranges::find(network.timelines, "fully_autonomous", &temporal::timelines::Definition::name);
    ASSERT_NE(flag, network.timelines.end());
    EXPECT_EQ(flag->states.at(static_cast<std::size_t>(flag->initial)), initial) << file;
  }
}

TEST(EuropaNetworks, EveryParameterSaysWhereItComesFrom) {
  for (const char* file : {"network.yaml", "network-bsm1.yaml", "network-rsm1.yaml"})
    for (const auto& parameter : Europa(file).network.parameters)
      EXPECT_GT(parameter.source.size(), 5U) << parameter.name;
}

// R88.
TEST(EuropaNetworks, TheFifteenPrimitivesStandThereByName) {
  const Europa rsm("network-rsm1.yaml");
  std::set<std::string> names;
  for (const Task& task : rsm.network.tasks)
    if (task.primitive()) names.insert(task.name);
  for (const char* name : {"Mono Panorama", "Find Excavation Sites", "Start Seismometer", "Stop Seismometer",
                           "Prepare Arm", "Excavate Site(2)", "Discard Sample", "Find Collection Targets(2)",
                           "Collect Sample(2, 1)", "Transport Sample", "Science Analyze", "Prepare HGA Comm",
                           "Downlink", "Downlink with Ground Hold", "Uplink", "Hotel Load", "Seismometer-ON"})
    EXPECT_THAT(names, Contains(name));
}

// R89: section II.C.
TEST(EuropaNetworks, ParentsAreThoseOfThePaper) {
  const Europa base("network.yaml");
  EXPECT_EQ(base.count("preamble"), 1U);
  EXPECT_EQ(base.count("sample_[0-2]_[0-2]"), 9U);
  EXPECT_EQ(base.count("excavate_site_[0-2]"), 3U);
  EXPECT_GT(base.count("panorama_[0-9]+"), 1U);
  EXPECT_GT(base.count("seismograph_[0-9]+"), 1U);
  for (const char* name : {"sample_0_0/first/raw", "sample_0_0/first/compressed", "sample_0_0/next/raw",
                           "sample_0_0/next/compressed"}) {
    const bool digs = std::ranges::count(base.ids(name), "excavate_site_0") == 1;
    EXPECT_EQ(digs, std::string(name).find("first") != std::string::npos) << name;
  }
  const Europa bsm("network-bsm1.yaml");
  EXPECT_EQ(bsm.count("sample_[0-9]_[0-9]"), 3U);
  EXPECT_EQ(bsm.count("excavate_site_[0-9]"), 1U);
  EXPECT_EQ(bsm.count("p_uplink_[0-9]+|downlink_gh.*|uplink"), 0U) << "no ground";
}

// R89: figure 4.
TEST(EuropaNetworks, ThePhaseOnATimelineSelectsTheDecomposition) {
  const Europa rsm("network-rsm1.yaml");
  const auto when = [&](const std::string& name) {
    std::set<std::string> out;
    for (const auto& constraint : rsm.chain(name).when) out.insert(to_text(constraint, rsm.network));
    return out;
  };
  EXPECT_EQ(when("preamble/once"), std::set<std::string>{"phase = landed"});
  EXPECT_EQ(when("sample_1_1/first/with_ground/raw"),
            (std::set<std::string>{"phase = sampling", "lander.site.1 = excavated", "collector = clean",
                                   "fully_autonomous = no"}));
  EXPECT_EQ(when("sample_1_1/next/autonomous/raw"),
            (std::set<std::string>{"phase = sampling", "lander.site.1 = excavated", "collector = spent",
                                   "fully_autonomous = yes"}));
  EXPECT_EQ(
      when("site_block_2/excavate/autonomous"),
      (std::set<std::string>{"phase = sampling", "lander.site.2 = untouched", "fully_autonomous = yes"}));
}

// R89: figure 8.
TEST(EuropaNetworks, ChainsAreLabelledAsInFigureEight) {
  const Europa rsm("network-rsm1.yaml");
  using Labels = std::vector<std::string>;
  EXPECT_EQ(labels(rsm.ids("comm_2/block")),
            (Labels{"prepare_hga_comm", "uplink", "downlink", "mexec_plan_process"}));
  EXPECT_EQ(rsm.ids("site_block_0/excavate/with_ground"),
            (Labels{"p_start_nfa", "excavate_site_0", "find_collection_targets_0", "mexec_plan_process",
                    "prepare_hga_comm", "downlink_gh"}));
  EXPECT_EQ(labels(rsm.ids("sample_1_0/first/with_ground/raw")),
            (Labels{"p_start_nfa", "collect_sample_1_0", "transport_sample", "science_analyze",
                    "mexec_plan_process", "prepare_hga_comm", "downlink_gh", "p_end"}));
  EXPECT_EQ(labels(rsm.ids("sample_1_1/next/autonomous/compressed")),
            (Labels{"p_start", "discard_sample", "collect_sample_1_1", "transport_sample", "science_analyze",
                    "mexec_plan_process", "prepare_hga_comm", "downlink_gh", "p_end"}));
  EXPECT_EQ(rsm.count("hotel_load"), 1U);
}

TEST(EuropaNetworks, AtLeastTwentyTwoUplinksAreFixedWhileEarthIsInView) {
  const Europa rsm("network-rsm1.yaml");
  EXPECT_GE(rsm.count("p_uplink_[0-9]+"), 22U);
  for (const Task& task : rsm.network.tasks) {
    if (!task.id.starts_with("p_uplink_")) continue;
    EXPECT_TRUE(task.fixed);
    const double start = std::fmod(temporal::to_seconds(task.preferred_start), 84 * 3600);
    EXPECT_LE(start + model::evaluate(task.duration, rsm.values), 41 * 3600) << task.id;
  }
}

// R107: the views, told by tasks.
TEST(EuropaNetworks, EarthIsHiddenForOver42OfEvery84Hours) {
  for (const char* file : {"network-bsm1.yaml", "network-rsm1.yaml"}) {
    const Europa mission(file);
    ASSERT_GE(mission.count("earth_view_[0-9]+"), 7U);
    for (std::size_t view = 0; view < 7; ++view) {
      const Task& task = mission.task("earth_view_" + std::to_string(view));
      EXPECT_EQ(task.preferred_start, temporal::seconds(static_cast<double>(view) * 84 * 3600));
      EXPECT_LT(model::evaluate(task.duration, mission.values), 42 * 3600);
      EXPECT_EQ(task.impacts.size(), 2U);
    }
  }
}

// R91.
TEST(EuropaNetworks, RawDataAreWorthAndCostMoreThanCompressedOnes) {
  for (const char* file : {"network.yaml", "network-bsm1.yaml"}) {
    const Europa mission(file);
    EXPECT_GT(mission.utility("sample_0_1/first/raw"), mission.utility("sample_0_1/first/compressed"));
    EXPECT_GT(mission.cost("sample_0_1/first/raw"), mission.cost("sample_0_1/first/compressed"));
  }
}

// R91: while there is energy for it samples go raw; where there is less,
// as many are compressed as must be so that all fit.
TEST(EuropaNetworks, PlansSwitchToCompressedDataWhereTheBudgetAsksForIt) {
  const Europa rsm("network-rsm1.yaml");
  const std::string raw = "/raw", compressed = "/compressed";
  const auto samples = [&](const cli::FirstPlan& plan, const std::string& form) {
    std::vector<std::string> out;
    for (const cli::PlannedTask& one : plan.planned)
      if (one.chain.starts_with("sample_") && one.chain.ends_with(form)) out.push_back(one.chain);
    return out;
  };
  const cli::FirstPlan ample = cli::first_plan(rsm.network, {.initial = {{"lander.battery", 120e6}}});
  EXPECT_TRUE(ample.complete);
  EXPECT_EQ(samples(ample, raw).size(), 6U);
  EXPECT_EQ(samples(ample, compressed).size(), 0U);
  const cli::FirstPlan scarce = cli::first_plan(rsm.network, {.initial = {{"lander.battery", 105e6}}});
  EXPECT_TRUE(scarce.complete);
  EXPECT_GT(samples(scarce, raw).size(), 0U);
  EXPECT_GT(samples(scarce, compressed).size(), 0U);
  for (const std::string& chain : samples(scarce, compressed)) {
    const std::string dearer = chain.substr(0, chain.size() - compressed.size()) + raw;
    EXPECT_GT(scarce.cost + rsm.cost(dearer) - rsm.cost(chain), scarce.budget) << chain << " had room";
  }
}

// R90, R91: communication is worth more than any sampling, and the same wherever it is sent from;
// surveys are worth what is sent.
TEST(EuropaNetworks, CommunicationIsWorthMoreThanSamplingAndConstant) {
  const Europa base("network.yaml");
  double most = 0;
  for (const Task& task : base.network.tasks) {
    const temporal::RankVector worth = model::utility(task, base.values);
    if (task.id.starts_with("collect_sample")) most = std::max(most, worth[0]);
    if (task.id.starts_with("collect_sample") || task.downlinks) continue;
    if (task.id == "give_up_sample") continue;  // as little as makes it worth doing
    EXPECT_EQ(worth, temporal::RankVector{}) << task.id;
  }
  EXPECT_GT(most, 0);
  EXPECT_LT(most, model::utility(base.task("downlink_compressed"), base.values)[0]);
  for (const char* name : {"panorama_1/taken", "seismograph_1/recorded"})
    EXPECT_EQ(base.utility(name), model::utility(base.task("downlink_survey"), base.values));
}

// R91: over a mission of three sites and nine samples.
TEST(EuropaNetworks, ExcavationAndSamplingTakeMoreThanHalfOfTheEnergyAndAGoodMissionJustFits) {
  const Europa rsm("network-rsm1.yaml");
  double all = 0, rules = 0;
  std::set<model::TaskIndex> done;
  for (const Chain& chain : rsm.chains.chains) {
    const bool sample = chain.name.starts_with("sample_");
    const bool first = chain.name.find("_0/first") != std::string::npos,
               next = chain.name.find("/next") != std::string::npos;
    const bool second = chain.name.find("_0/") == std::string::npos;
    if (sample && !(first || (next && second))) continue;
    if (chain.name.find("compressed") != std::string::npos || !done.insert(chain.task).second) continue;
    all += flattening::cost(rsm.network, chain, rsm.values);
    for (const auto& link : chain.links) {
      const std::string& id = rsm.network.tasks[link.task].id;
      if (id.starts_with("excavate") || id.starts_with("collect_sample")) rules += rsm.task_cost(id);
    }
  }
  const double battery = rsm.network.timelines[rsm.network.budget].initial;
  EXPECT_EQ(battery, 50 * 3.6e6);
  EXPECT_GT(rules, all / 2);
  EXPECT_LT(all, battery);
  EXPECT_GT(all * 1.1, battery);
}

TEST(EuropaNetworks, ASitesFirstSampleCostsFarMoreThanItsNext) {
  const Europa base("network.yaml");
  EXPECT_GT(base.cost("sample_0_0/first/raw"), 3 * base.cost("sample_0_0/next/raw"));
}

TEST(EuropaNetworks, TheSubwayMapHasThreeSitesOfThreeTargets) {
  const Europa rsm("network-rsm1.yaml");
  ASSERT_EQ(rsm.network.subway.sites.size(), 3U);
  EXPECT_EQ(rsm.network.subway.most_samples, 3U);
  EXPECT_EQ(rsm.network.ranks.at(rsm.network.subway.rank), "mission");
  for (const auto& site : rsm.network.subway.sites) EXPECT_EQ(site.targets.size(), 3U);
}

}  // namespace
}  // namespace roci::planner::utility_htn
