// What is written in either form is read as it was (R67, R83).
#include <gtest/gtest.h>

#include "planner_svc/utility_htn/model/check.hpp"
#include "planner_svc/utility_htn/reading/binary.hpp"
#include "tests/unit/planner_svc/utility_htn/random/random_network.hpp"
#include "tests/unit/planner_svc/utility_htn/reading/texts.hpp"

namespace roci::planner::utility_htn::reading {
namespace {

using model::Network;

TEST(NetworkRoundTrip, RandomNetworksGoThroughYamlAndBytesAndBack) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 60; ++round) {
    const Network network = random_network(random);
    const std::string text = to_yaml(network);
    ASSERT_EQ(faults_of(text), "") << text;
    mission::Findings findings;
    const Read read = parse_yaml(text, "n.yaml", findings);
    ASSERT_TRUE(*read.network == network) << "round " << round << ":\n"
                                          << text << "\nagain:\n"
                                          << to_yaml(*read.network);
    const Network unpacked = parse_binary(to_binary(*read.network));
    ASSERT_TRUE(unpacked == network) << "round " << round << ":\n" << text;
    ASSERT_EQ(to_yaml(unpacked), text);
  }
}

TEST(NetworkRoundTrip, AFileByHandIsEqualToWhatIsWrittenOfIt) {
  mission::Findings findings;
  const Read read = parse_yaml(kSound, "n.yaml", findings);
  const Read again = parse_yaml(to_yaml(*read.network), "again.yaml", findings);
  EXPECT_TRUE(*again.network == *read.network);
  EXPECT_LT(to_binary(*read.network).size(), kSound.size() / 2);
}

}  // namespace
}  // namespace roci::planner::utility_htn::reading
