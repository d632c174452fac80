// The commands for authors of networks: what they print, and with which code they end.
#include "planner_svc/utility_htn/cli/commands.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace roci::planner::utility_htn::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr, testing::Not;

const fs::path kNetwork = ROCI_SOURCE_DIR "/missions/europa/network-rsm1.yaml";

class Commands : public testing::Test {
 protected:
  Commands() : folder_(fs::temp_directory_path() / ("roci-network-cli-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "bad.yaml") << "network: a\nbudgt: b\n";
  }
  ~Commands() override { fs::remove_all(folder_); }

  fs::path folder_;
  std::ostringstream out_, errors_;
  Output output_{out_, errors_};
  Output json_{out_, errors_, true};
};

using RociNetwork = Commands;

TEST_F(RociNetwork, ChecksAndCounts) {
  EXPECT_EQ(check(kNetwork, output_), done);
  EXPECT_THAT(out_.str(), HasSubstr("network 'rsm1', version 1: "));
  EXPECT_THAT(out_.str(), HasSubstr("132 chains; no error, 0 warnings"));
}

TEST_F(RociNetwork, TellsFaultsWithPlaceAndRemedy) {
  EXPECT_EQ(check(folder_ / "bad.yaml", output_), faulty);
  EXPECT_THAT(out_.str(), HasSubstr("bad.yaml:2:1: error: unknown key 'budgt'"));
  EXPECT_THAT(out_.str(), HasSubstr("did you mean 'budget'?"));
  EXPECT_EQ(check(folder_ / "bad.yaml", json_), faulty);
  EXPECT_EQ(chains(folder_ / "bad.yaml", output_), faulty);
  EXPECT_EQ(pack(folder_ / "bad.yaml", folder_ / "bad.bin", output_), faulty);
  EXPECT_FALSE(fs::exists(folder_ / "bad.bin"));
}

const fs::path kSmall = ROCI_SOURCE_DIR "/tests/missions/lander/network.yaml";

TEST_F(RociNetwork, ExplainsTheFirstPlanAndWhatIsNotInIt) {
  EXPECT_EQ(explain(kSmall, {}, {}, output_), done);
  EXPECT_THAT(out_.str(), HasSubstr("the first plan takes 380400 for utility science 1.05"));
  EXPECT_THAT(out_.str(), Not(HasSubstr("is not planned")));
  out_.str("");
  EXPECT_EQ(explain(kSmall, {}, {"lander.battery=250000"}, output_), done);
  EXPECT_THAT(out_.str(), HasSubstr("sample_near/whole  120 s to 1440 s, 169800, utility science 0.5"));
  EXPECT_THAT(out_.str(),
              HasSubstr("'sample_far/whole' is not planned, since it costs 169800 of 'lander.battery' and "
                        "the plan leaves less than 39400 of 250000"));
  out_.str("");
  EXPECT_EQ(explain(kSmall, {"sample_near"}, {"lander.lamp=dark", "dig_w=10"}, output_), done);
  EXPECT_THAT(out_.str(),
              HasSubstr("'sample_near/whole' is not planned, since 'dig_near' has no valid start"));
  EXPECT_THAT(out_.str(), Not(HasSubstr("'sample_far/whole' is not planned"))) << "nobody asked";
  out_.str("");
  EXPECT_EQ(explain(kSmall, {}, {"lander.battery=250000"}, json_), done);
  const auto json = nlohmann::json::parse(out_.str());
  EXPECT_EQ(json["planned"].size(), 3U);
  EXPECT_EQ(json["unplanned"][0]["task"], "sample_far");
  EXPECT_EQ(json["complete"], true);
}

TEST_F(RociNetwork, ExplainRefusesWhatTheNetworkDoesNotHave) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"dig_s_far=9000000", "'dig_s_far' is 9e+06, and goes from 60 to 7200"},
      {"dig_s_far", "'dig_s_far' is not NAME=NUMBER"},
      {"dig=1", "the network has no parameter 'dig'"},
      {"dig=open", "the network has no parameter 'dig'"},
      {"lander.battery=-1", "'lander.battery' would begin with -1"},
      {"lander.lamp=green", "'lander.lamp=green' is no value of the timeline 'lander.lamp'"}};
  for (const auto& [change, words] : wrong) {
    errors_.str("");
    EXPECT_EQ(explain(kSmall, {}, {change}, output_), wrong_use) << change;
    EXPECT_THAT(errors_.str(), HasSubstr(words));
  }
  EXPECT_EQ(explain(kSmall, {"sample"}, {}, output_), wrong_use);
  EXPECT_THAT(errors_.str(), HasSubstr("there is no task 'sample'"));
  EXPECT_EQ(explain(kSmall, {"look"}, {}, output_), wrong_use);
  EXPECT_THAT(errors_.str(), HasSubstr("'look' is a template"));
  EXPECT_EQ(explain(folder_ / "bad.yaml", {}, {}, output_), faulty);
}

TEST_F(RociNetwork, ListsChainsForPeopleAndPrograms) {
  EXPECT_EQ(chains(kNetwork, output_), done);
  EXPECT_THAT(out_.str(), HasSubstr("sample_1_1/next/with_ground/raw"));
  out_.str("");
  EXPECT_EQ(chains(kNetwork, json_), done);
  const auto json = nlohmann::json::parse(out_.str());
  EXPECT_EQ(json["budget"], "lander.battery");
  EXPECT_EQ(json["chains"].size(), 132U);
  for (const char* key : {"chain", "task", "batch", "utility", "cost", "duration_s", "links", "when"})
    EXPECT_TRUE(json["chains"][0].contains(key)) << key;
}

TEST_F(RociNetwork, PacksAndUnpacksToTheSame) {
  EXPECT_EQ(pack(kNetwork, folder_ / "a.bin", output_), done);
  EXPECT_EQ(unpack(folder_ / "a.bin", folder_ / "a.yaml", output_), done);
  EXPECT_EQ(pack(folder_ / "a.yaml", folder_ / "b.bin", output_), done);
  const auto bytes = [](const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes(folder_ / "a.bin"), bytes(folder_ / "b.bin"));
  EXPECT_LT(fs::file_size(folder_ / "a.bin"), 20'000U);
}

TEST_F(RociNetwork, WhatCannotBeReadOrWrittenIsWrongUse) {
  EXPECT_EQ(check(folder_ / "gone.yaml", output_), wrong_use);
  EXPECT_EQ(check(folder_, output_), wrong_use);
  EXPECT_EQ(pack(kNetwork, folder_ / "no/such/folder.bin", output_), wrong_use);
  EXPECT_THAT(errors_.str(), HasSubstr("cannot be written; check that the folder exists"));
}

}  // namespace
}  // namespace roci::planner::utility_htn::cli
