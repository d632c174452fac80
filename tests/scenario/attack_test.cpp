// An owner of commands under attack, between real processes: an intruder on its domain who knows the run's identity.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pair;

Ended attack(const std::string& script, const std::string& dds) {
  const services::process::DomainClaim domain;
  return run("timeout 200 " ROCI_SOURCE_DIR "/tests/scenario/" + script +
             " " ROCI_BINARY_DIR "/bin " ROCI_BINARY_DIR "/tests " ROCI_SOURCE_DIR "/missions/planetary " +
             dds + " " + std::to_string(domain.id()));
}

// How often each thing was really done: "kind object by activity attempt" → count.
std::map<std::string, int> effects_in(const std::string& output) {
  std::map<std::string, int> out;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("effect ")) continue;
    const auto effect = nlohmann::json::parse(line.substr(7));
    ++out[effect["kind"].get<std::string>() + " " + effect["object"].get<std::string>() + " by " +
          effect["activity"].get<std::string>() + " " + std::to_string(effect["attempt"].get<int>())];
  }
  return out;
}

class Attack : public ::testing::TestWithParam<const char*> {};

// A far query and a far command change nothing, a stranger's stop is obeyed and told of, and what the owner has taken is
// neither forgotten nor done again by the process that follows it.
TEST_P(Attack, AnOwnerKeepsItsKeysAndItsEpochOverItsDeath) {
  const Ended ended = attack("owner_under_attack.sh", GetParam());
  EXPECT_THAT(ended.output, Not(HasSubstr("nobody said")));
  EXPECT_THAT(ended.output, HasSubstr("end 0"));
  EXPECT_THAT(effects_in(ended.output), ElementsAre(Pair("image one by p1.1-image 1", 1)));
}

INSTANTIATE_TEST_SUITE_P(Transports, Attack, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
