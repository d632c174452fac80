// A whole run under attack, between real processes: other runs and namesakes on its domain, an intruder, a lost journal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Ended attack(const std::string& script, const std::string& dds) {
  const services::process::DomainClaim domain;
  return run("timeout 200 " ROCI_SOURCE_DIR "/tests/scenario/" + script +
             " " ROCI_BINARY_DIR "/bin " ROCI_BINARY_DIR "/tests " ROCI_SOURCE_DIR "/missions/planetary " +
             dds + " " + std::to_string(domain.id()));
}

// How often each thing was really done: "kind object by activity attempt of epoch" → count.
std::map<std::string, int> effects_in(const std::string& output) {
  std::map<std::string, int> out;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("effect ")) continue;
    const auto effect = nlohmann::json::parse(line.substr(7));
    ++out[effect["kind"].get<std::string>() + " " + effect["object"].get<std::string>() + " by " +
          effect["activity"].get<std::string>() + " " + std::to_string(effect["attempt"].get<int>()) +
          " of " + std::to_string(effect["epoch"].get<int>())];
  }
  return out;
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
              AllOf(HasSubstr("2\t"), HasSubstr("this run has another exec_svc")));
  EXPECT_THAT(printed("intruder"), AllOf(HasSubstr("0\t"), HasSubstr("ack y 1000000 rejected epoch-jump")));
  EXPECT_THAT(printed("events"), AllOf(HasSubstr("service.doubled"), HasSubstr("command.epoch_jump"),
                                       HasSubstr("epoch.taken"), Not(HasSubstr("sim_svc was lost"))));
  EXPECT_THAT(printed("launch"), AllOf(HasSubstr("0\t"), HasSubstr("\"result\":\"achieved\"")));
  for (const auto& [effect, count] : effects_in(ended.output)) EXPECT_EQ(count, 1) << effect;
}

INSTANTIATE_TEST_SUITE_P(Transports, AttackedRun, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
