// Hosts that are no peers: whatever they send, nobody reads it. The same datagrams from a peer are read, so that the
// tests would notice if nothing was sent.
#include <gmock/gmock.h>

#include "tests/contract/support/peers.hpp"
#include "tests/contract/support/two_hosts.hpp"

namespace roci::services::contract {
namespace {

using testing::Contains;
using testing::Not;

constexpr int kDomain = 7;  // nobody else is in these namespaces

class HostileHost : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!hosts_.refused.empty()) GTEST_SKIP() << hosts_.refused;
  }
  // Writes the goal stranger/`id` to whoever listens at `address`.
  static ChildProcess attacker(const Host& at, const std::string& address, const std::string& id) {
    return ChildProcess(at.inside(
        {ROCI_BINARY_DIR "/tests/contract-hostile", "goals", std::to_string(kDomain), address, id}));
  }

  void expect_read_from_here_alone(ChildProcess& reader, const std::string& own_address) {
    ASSERT_TRUE(reader.wait_for("ready"));
    auto stranger = attacker(hosts_.ground, hosts_.rover.address, "from-ground");
    ASSERT_TRUE(stranger.wait_for("round 10"));
    auto neighbour = attacker(hosts_.rover, own_address, "from-rover");
    ASSERT_TRUE(reader.wait_for("goal stranger from-rover 1"));
    EXPECT_THAT(reader.lines(), Not(Contains("goal stranger from-ground 1")));
    EXPECT_EQ(reader.finish(), 0);
  }

  TwoHosts hosts_;
};

TEST_P(HostileHost, CannotReachALoopbackRun) {
  ChildProcess reader(hosts_.rover.inside(peer_command(GetParam(), "goal-reader", kDomain)));
  expect_read_from_here_alone(reader, "127.0.0.1");
}

TEST_P(HostileHost, IsNotReadUnlessItIsAPeer) {
  auto command = peer_command(GetParam(), "goal-reader", kDomain);
  command.insert(command.end(), {hosts_.rover.address, hosts_.rover.address});
  ChildProcess reader(hosts_.rover.inside(command));
  expect_read_from_here_alone(reader, hosts_.rover.address);
}

TEST_P(HostileHost, IsReadIfItIsAPeer) {
  auto command = peer_command(GetParam(), "goal-reader", kDomain);
  command.insert(command.end(), {hosts_.rover.address, hosts_.ground.address});
  ChildProcess reader(hosts_.rover.inside(command));
  ASSERT_TRUE(reader.wait_for("ready"));
  auto peer = attacker(hosts_.ground, hosts_.rover.address, "from-ground");
  EXPECT_TRUE(reader.wait_for("goal stranger from-ground 1"));
}

INSTANTIATE_TEST_SUITE_P(Vendors, HostileHost, testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::services::contract
