#include "services/process/connection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "core/mission/entry.hpp"
#include "services/process/incarnation.hpp"

namespace roci::services::process {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ConnectionTest : public testing::Test {
 protected:
  ConnectionTest() {
    std::filesystem::create_directories(folder);
    write("mission.yaml", "name: test\ndds: cyclonedds\n");
  }
  ~ConnectionTest() override { std::filesystem::remove_all(folder); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
  Connection resolve() const {
    const Environment environment = [this](const char* name) -> std::optional<std::string> {
      const auto found = variables.find(name);
      return found == variables.end() ? std::nullopt : std::optional(found->second);
    };
    return resolve_connection(flags, environment, folder);
  }

  std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                 ("roci-connection-" + std::to_string(getpid()) +
                                  testing::UnitTest::GetInstance()->current_test_info()->name());
  ConnectionFlags flags;
  std::map<std::string, std::string> variables;
};

TEST_F(ConnectionTest, DefaultsAreLoopbackAndTheMissionsVendor) {
  const auto connection = resolve();
  EXPECT_EQ(connection.dds, "cyclonedds");
  EXPECT_EQ(connection.transport.domain, 0);
  EXPECT_EQ(connection.transport.address, "127.0.0.1");
  EXPECT_THAT(connection.transport.peers, ElementsAre("127.0.0.1"));
}

TEST_F(ConnectionTest, TheNarrowerPlaceWins) {
  flags.network =
      write("network.yaml", "dds: one\ndomain: 3\naddress: 10.0.0.1\npeers: [10.0.0.1, 10.0.0.2]\n");
  EXPECT_EQ(resolve().dds, "one");
  EXPECT_EQ(resolve().transport.domain, 3);
  EXPECT_THAT(resolve().transport.peers, ElementsAre("10.0.0.1", "10.0.0.2"));
  variables = {{"ROCI_DDS", "two"},
               {"ROCI_DOMAIN", "4"},
               {"ROCI_ADDRESS", "10.0.0.3"},
               {"ROCI_PEERS", "10.0.0.3,10.0.0.4"}};
  EXPECT_EQ(resolve().dds, "two");
  EXPECT_EQ(resolve().transport.domain, 4);
  EXPECT_EQ(resolve().transport.address, "10.0.0.3");
  EXPECT_THAT(resolve().transport.peers, ElementsAre("10.0.0.3", "10.0.0.4"));
  flags.dds = "three";
  flags.domain = 5;
  flags.address = "10.0.0.5";
  flags.peers = "10.0.0.6";
  EXPECT_EQ(resolve().dds, "three");
  EXPECT_EQ(resolve().transport.domain, 5);
  EXPECT_EQ(resolve().transport.address, "10.0.0.5");
  EXPECT_THAT(resolve().transport.peers, ElementsAre("10.0.0.6"));
}

TEST_F(ConnectionTest, MistakesAreNamedWithTheirPlace) {
  const auto error_of = [this] {
    try {
      resolve();
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  flags.network = write("network.yaml", "dds: one\nadress: 10.0.0.1\n");
  EXPECT_THAT(error_of(), HasSubstr("network.yaml:2:1: "));
  flags.network = write("network.yaml", "domain: 500\n");
  EXPECT_THAT(error_of(), HasSubstr("network.yaml:1:9: domain 500 is not between 0 and 232"));
  flags.network = write("network.yaml", "domain: 5\npartition: red\n");
  EXPECT_THAT(error_of(),
              HasSubstr("network.yaml:2:12: nobody sets a DDS partition: partitions follow from the robot"));
  flags.network.reset();
  variables["ROCI_DOMAIN"] = "x7";
  EXPECT_THAT(error_of(), HasSubstr("ROCI_DOMAIN: \"x7\" is not a domain number"));
  variables.clear();
  flags.domain = -1;
  EXPECT_THAT(error_of(), HasSubstr("--domain"));
  flags.domain.reset();
  flags.network = folder / "nowhere.yaml";
  EXPECT_THAT(error_of(), HasSubstr("nowhere.yaml"));
}

TEST_F(ConnectionTest, IncarnationsAreCountedInTheRunFolder) {
  EXPECT_EQ(next_incarnation(folder, "arm_svc"), 1U);
  EXPECT_EQ(next_incarnation(folder, "arm_svc"), 2U);
  EXPECT_EQ(next_incarnation(folder, "exec_svc"), 1U);
  EXPECT_THROW(next_incarnation(folder / "nowhere", "arm_svc"), std::runtime_error);
}

TEST(SplitList, LeavesOutEmptyParts) {
  EXPECT_THAT(split_list("a,,b,"), ElementsAre("a", "b"));
  EXPECT_THAT(split_list(""), IsEmpty());
}

TEST_F(ConnectionTest, SecureComesFromTheFlagTheVariableOrTheNetworkFile) {
  EXPECT_TRUE(resolve().keys.empty());
  flags.network = write("network.yaml", "secure: keys\n");
  EXPECT_EQ(resolve().keys, folder / "keys") << "seen from the file";
  EXPECT_EQ(resolve().network, folder / "network.yaml");
  variables = {{"ROCI_SECURE", "/var/keys"}};
  EXPECT_EQ(resolve().keys, "/var/keys");
  flags.secure = "/flag/keys";
  EXPECT_EQ(resolve().keys, "/flag/keys");
}

}  // namespace
}  // namespace roci::services::process
