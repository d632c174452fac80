// A whole run under attack, between real processes: other runs and namesakes on its domain,
// an intruder, a lost journal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "tests/scenario/attack.hpp"

namespace roci::scenario {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// An executive that has lost its journal numbers its plans anew, so the same key in a later epoch may be another command.
// What was done to the world tells: no image is taken or sent twice under whatever key, and nobody drives to a place
// again where its image was taken.
void expect_each_deed_once(const nlohmann::json& effects) {
  ASSERT_FALSE(effects.empty());
  std::set<std::string> deeds, commands;
  for (const nlohmann::json& effect : effects) {
    const auto kind = effect.at("kind").get<std::string>(), object = effect.at("object").get<std::string>();
    if (kind == "detour") continue;
    if (kind != "motion") {
      EXPECT_TRUE(deeds.insert(kind + " " + object).second) << effect;
      continue;
    }
    const std::string place = object.substr(object.find('-') + 1);
    EXPECT_FALSE(deeds.contains("image image-" + place)) << effect;
    const std::string command = effect.at("activity").get<std::string>() + " " + effect.at("attempt").dump() +
                                " of " + effect.at("epoch").dump();
    EXPECT_TRUE(commands.insert(command).second) << effect;
  }
}

class AttackedRun : public ::testing::TestWithParam<const char*> {};

TEST_P(AttackedRun, GoesOnAndNamesWhoIsNotOfIt) {
  const Ended ended = attack("run_under_attack.sh", GetParam());
  const auto printed = [&](const std::string& step) {
    std::istringstream lines(ended.output);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(step + "\t")) return line.substr(step.size() + 1);
    return std::string();
  };
  EXPECT_THAT(printed("another-run"),
              AllOf(HasSubstr("2\t"), HasSubstr("is held by another run, \"attacked\"")));
  EXPECT_THAT(printed("same-run"), AllOf(HasSubstr("2\t"), HasSubstr("run \"attacked\" has a ")));
  EXPECT_THAT(printed("second-executive"),
              AllOf(HasSubstr("5\t"), HasSubstr("this run has another exec_svc")));
  EXPECT_THAT(printed("second-simulator"),
              AllOf(HasSubstr("5\t"), HasSubstr("this run has another sim_svc")));
  EXPECT_THAT(printed("second-owner"), HasSubstr("0\t"));
  EXPECT_THAT(printed("intruder"), AllOf(HasSubstr("0\t"), HasSubstr("ack y 1000000 rejected epoch-jump")));
  EXPECT_THAT(printed("events"),
              AllOf(HasSubstr("this run has another exec_svc"), HasSubstr("this run has another sim_svc"),
                    HasSubstr("command.epoch_jump"), HasSubstr("epoch.taken"),
                    HasSubstr("double tells of rover.nav, which sim_svc observes"),
                    HasSubstr("double acknowledges commands in the place of sim_svc"),
                    Not(HasSubstr("sim_svc was lost"))));
  EXPECT_THAT(printed("launch"), AllOf(HasSubstr("0\t"), HasSubstr("\"result\":\"achieved\"")));
  expect_each_deed_once(effects_in(ended.output));
}

INSTANTIATE_TEST_SUITE_P(Transports, AttackedRun, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
