// A network file and what is made of it (R67–R70, R89).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/mission/entry.hpp"
#include "planner_svc/utility_htn/model/check.hpp"
#include "planner_svc/utility_htn/model/describe.hpp"
#include "planner_svc/utility_htn/reading/expression.hpp"
#include "tests/unit/planner_svc/utility_htn/reading/texts.hpp"

namespace roci::planner::utility_htn::reading {
namespace {

using model::Network, model::Task;
using temporal::ImpactKind, temporal::ImpactWhen, temporal::seconds;
using testing::ElementsAre, testing::HasSubstr;

Network lander() {
  mission::Findings findings;
  auto read = parse_yaml(kSound, "n.yaml", findings);
  EXPECT_EQ(faults_of(kSound), "");
  EXPECT_TRUE(read.network && model::usable(model::check(*read.network)));
  return read.network.value_or(Network{});
}

std::vector<std::string> ids(const Network& network) {
  std::vector<std::string> out;
  for (const Task& task : network.tasks) out.push_back(task.id);
  return out;
}

TEST(NetworkYaml, EntriesAreRepeatedForEachCombination) {
  const Network network = lander();
  EXPECT_THAT(ids(network), ElementsAre("dig_0", "dig_1", "stow", "hotel_load", "site_0", "site_1",
                                        "uplink_1", "uplink_2"));
  EXPECT_EQ(network.parameters.at(1).name, "dig_s_1");
  EXPECT_EQ(network.tasks[1].name, "Dig(1)");
  EXPECT_EQ(network.tasks[1].commands.at(0).arguments.at(0), (temporal::Property{"site", "1"}));
  EXPECT_EQ(network.tasks[1].duration, (model::Amount{5, 1, 2}));
  EXPECT_EQ(network.tasks[7].preferred_start, seconds(14 * 3600));
}

TEST(NetworkYaml, ATaskHasAllThatTheFileSays) {
  const Network network = lander();
  const Task& dig = network.tasks.at(0);
  EXPECT_TRUE(dig.is_template);
  EXPECT_EQ(dig.batch, 0U);
  EXPECT_EQ(dig.commands.at(0).answer_within, seconds(5));
  using model::Impact;
  EXPECT_THAT(dig.impacts, ElementsAre(Impact{0, ImpactKind::rate, ImpactWhen::during, {-3, {}, 1}},
                                       Impact{0, ImpactKind::delta, ImpactWhen::at_start, {-7, {}, 1}},
                                       Impact{2, ImpactKind::delta, ImpactWhen::during, {1, {}, 1}},
                                       Impact{1, ImpactKind::assign, ImpactWhen::at_end, {2, {}, 1}}));
  ASSERT_EQ(dig.constraints.size(), 3U);
  EXPECT_EQ(dig.constraints[0].states, 6U);
  EXPECT_EQ(to_text(dig.constraints[1], network), "battery >= 500");
  EXPECT_EQ(dig.constraints[2].phase, temporal::timelines::Phase::maintenance);
  EXPECT_EQ(dig.control.retries, 2U);
  EXPECT_EQ(dig.control.skip_if.at(0).states, 4U);
  EXPECT_EQ(dig.response->command_name, "stop");
  EXPECT_EQ(*dig.contingency, (model::Contingency{{2}, {3}}));
  EXPECT_EQ(model::utility(dig, model::priors(network)), temporal::RankVector({0, 0.5}));
  EXPECT_EQ(dig.products.at(0), (model::Product{"images", model::Tier::decisional, {1e6, {}, 1}, {0, 0.25}}));
  EXPECT_THAT(dig.learns, ElementsAre(model::Learns{model::Measure::duration_s, 0},
                                      model::Learns{model::Measure::value, 0, "yield_0"}));
  EXPECT_EQ(network.timelines.at(0).highest, 180000);
  EXPECT_FALSE(network.timelines.at(1).reported);
  EXPECT_EQ(network.timelines.at(1).initial, 1);
  const Task& site = network.tasks.at(5);
  EXPECT_EQ(site.priority, 4);
  EXPECT_EQ(site.batch, 1U);
  EXPECT_THAT(site.decompositions.at(0).subtasks,
              ElementsAre(model::Subtask{1}, model::Subtask{2, seconds(1), seconds(60)}));
  EXPECT_EQ(site.decompositions.at(1).name, "again");
}

TEST(NetworkYaml, NumbersMayBeSumsOfProducts) {
  const auto parsed = parse_expression("3600 + 2 * 100 * 2 - p.x * 3");
  EXPECT_EQ(parsed.fault, "");
  EXPECT_EQ(parsed.constant, 4000);
  EXPECT_EQ(parsed.name, "p.x");
  EXPECT_EQ(parsed.factor, -3);
  EXPECT_EQ(parse_expression("-1.5e-3").constant, -0.0015);
  for (const char* bad : {"", "1 +", "* 2", "a * b", "a + b", "1 2", "nan", "inf", "1e999", "0x10", "12k"}) {
    const auto wrong = parse_expression(bad);
    EXPECT_TRUE(!wrong.fault.empty() || !wrong.name.empty()) << bad;
  }
}

class Files : public testing::Test {
 protected:
  Files() : folder_(std::filesystem::temp_directory_path() / ("roci-network-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Files() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::filesystem::path folder_;
};

using NetworkFiles = Files;

TEST_F(NetworkFiles, IncludedSectionsComeFirstAndTheOwnWordsWin) {
  write("model.yaml",
        "constants: {start: 5, rank: science}\nsets: {sites: [7, 8, 9]}\ntimelines:\n  battery: {kind: "
        "cumulative, initial: 1}\n");
  const auto file = write("network.yaml", R"(network: small
include: model.yaml
sets: {sites: [1]}
constants: {start: 9}
ranks: [science]
budget: battery
cycle: {process_interval_s: 10, worst_cycle_s: 2, commit_window_s: 20}
timelines: {phase: {kind: state, states: [a]}}
tasks:
  look_{site}: {for: {site: sites}, start_s: "{start}", utility: {"{rank}": 1}}
)");
  const Network network = load_network(file);
  EXPECT_EQ(network.timelines.at(0).name, "battery");
  EXPECT_THAT(ids(network), ElementsAre("look_1"));
  EXPECT_EQ(network.tasks[0].preferred_start, seconds(9));
}

TEST_F(NetworkFiles, FaultsOfIncludedFilesAreToldWithTheirFile) {
  write("model.yaml", "timelines:\n  battery: {kind: cumulativ, initial: 1}\n");
  const auto file = write(
      "network.yaml", with(kSound, "network: lander", "network: lander\ninclude: [model.yaml, gone.yaml]"));
  mission::Findings findings;
  EXPECT_FALSE(load_network(file, findings));
  std::string all;
  for (const auto& finding : findings.all()) all += finding.text() + "\n";
  EXPECT_THAT(all, HasSubstr("model.yaml:2:19: unknown kind 'cumulativ'"));
  EXPECT_THAT(all, HasSubstr("network.yaml:3:23: no file 'gone.yaml' beside this one"));
}

TEST_F(NetworkFiles, WhatTheCheckFindsStandsAtItsTask) {
  const auto file = write("network.yaml", with(kSound, "stow: {duration_s: 10}", "stow: {duration_s: -10}"));
  try {
    load_network(file);
    FAIL() << "not refused";
  } catch (const mission::FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("network.yaml:37:9: task 'stow': its duration in seconds is -10"));
  }
}

TEST_F(NetworkFiles, WhatTheCheckFindsOfTheCycleStandsThere) {
  const auto file = write("network.yaml", with(kSound, "commit_window_s: 20", "commit_window_s: 9"));
  mission::Findings findings;
  EXPECT_FALSE(load_network(file, findings));
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_THAT(findings.all()[0].text(),
              HasSubstr("network.yaml:7:8: network 'lander': its commit window of 9 s is shorter"));
}

TEST_F(NetworkFiles, TheExampleOfTheDocumentationIsUsable) {
  std::ifstream in(ROCI_SOURCE_DIR "/docs/network-format.md");
  const std::string page{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::size_t from = page.find("# small.yaml");
  ASSERT_NE(from, std::string::npos);
  mission::Findings findings;
  const auto network =
      load_network(write("small.yaml", page.substr(from, page.find("```", from) - from)), findings);
  ASSERT_TRUE(network);
  EXPECT_EQ(findings.size(), 0U);
  EXPECT_EQ(network->tasks.size(), 5U);
}

TEST_F(NetworkFiles, WhatIsNoFileIsRefused) {
  EXPECT_THROW(load_network(folder_ / "gone.yaml"), mission::FileError);
  EXPECT_THROW(load_network(folder_), mission::FileError);
}

}  // namespace
}  // namespace roci::planner::utility_htn::reading
