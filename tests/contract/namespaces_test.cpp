// Two hosts: two network namespaces joined by a veth pair. Needs the right to make namespaces (root); without it these
// are skipped.
#include <gmock/gmock.h>

#include "tests/contract/secure/key_ring.hpp"
#include "tests/contract/support/pairing.hpp"
#include "tests/contract/support/peers.hpp"
#include "tests/contract/support/two_hosts.hpp"

namespace roci::services::contract {
namespace {

constexpr int kDomain = 7;  // nobody else is in these namespaces

class Namespaces : public testing::TestWithParam<Pairing> {
 protected:
  void SetUp() override {
    if (!hosts_.refused.empty()) GTEST_SKIP() << hosts_.refused;
  }
  std::vector<std::string> peer(const Host& at, const Host& other, const std::string& vendor,
                                const std::string& role) {
    auto command = peer_command(vendor, role, kDomain);
    command.insert(command.end(), {at.address, other.address});
    return at.inside(command);
  }

  TwoHosts hosts_;
};

TEST_P(Namespaces, StateCrossesAndALateJoinerSeesIt) {
  ChildProcess writer(peer(hosts_.rover, hosts_.ground, GetParam().writer, "goal-writer"));
  writer.send("write ground photo 1");
  ChildProcess reader(peer(hosts_.ground, hosts_.rover, GetParam().reader, "goal-reader"));
  ASSERT_TRUE(reader.wait_for("goal ground photo 1"));
  // A second participant on the writer's host, which is among the peers without being named.
  ChildProcess neighbour(peer(hosts_.rover, hosts_.ground, GetParam().reader, "goal-reader"));
  ASSERT_TRUE(neighbour.wait_for("goal ground photo 1"));
  writer.send("dispose ground photo");
  ASSERT_TRUE(reader.wait_for("disposed ground photo"));
  ASSERT_TRUE(neighbour.wait_for("disposed ground photo"));
  EXPECT_EQ(writer.finish(), 0);
}

// The rover has a key folder of its own, and no authority.
TEST_P(Namespaces, SecureParticipantsHearEachOtherAcrossAndOutsidersNobody) {
  const KeyRing ring;
  const std::string rover = ring.path() + "-rover";
  ring.authority().export_to(rover, "rover", {"exec_svc"}, 365, KeyRing::now_s());
  ChildProcess outsider(peer(hosts_.rover, hosts_.ground, GetParam().reader, "goal-reader"),
                        {"PEER_PARTITION=roci.team"});
  ChildProcess writer(peer(hosts_.ground, hosts_.rover, GetParam().writer, "goal-writer"),
                      peer_keys(ring.path(), "roci"));
  writer.send("write ground photo 1");
  ChildProcess reader(peer(hosts_.rover, hosts_.ground, GetParam().reader, "goal-reader"),
                      peer_keys(rover, "exec_svc"));
  ASSERT_TRUE(reader.wait_for("goal ground photo 1"));
  writer.send("write ground photo 2");
  ASSERT_TRUE(reader.wait_for("goal ground photo 2"));
  EXPECT_THAT(outsider.lines(), testing::Not(testing::Contains("goal ground photo 1")));
}

TEST_P(Namespaces, CallsAreAnsweredAcross) {
  ChildProcess server(peer(hosts_.rover, hosts_.ground, GetParam().reader, "path-server"));
  ChildProcess client(peer(hosts_.ground, hosts_.rover, GetParam().writer, "path-client"));
  // Both writers count their readers: what is sent from now on arrives, the first call and its answer.
  ASSERT_TRUE(client.wait_for("matched 1"));
  ASSERT_TRUE(server.wait_for("matched 1"));
  client.send("call 1 3 4");
  EXPECT_TRUE(client.wait_for("answer 1 0 found 5 2 yes"));
}

TEST_P(Namespaces, ACutLinkIsNoticedAndItsReturnToo) {
  ChildProcess writer(peer(hosts_.rover, hosts_.ground, GetParam().writer, "goal-writer"));
  ChildProcess reader(peer(hosts_.ground, hosts_.rover, GetParam().reader, "goal-reader"));
  writer.send("write ground photo 1");
  ASSERT_TRUE(reader.wait_for("goal ground photo 1"));
  run_on_host(hosts_.rover.inside({"ip", "link", "set", hosts_.rover.link, "down"}));
  ASSERT_TRUE(reader.wait_for("lost ground photo"));
  run_on_host(hosts_.rover.inside({"ip", "link", "set", hosts_.rover.link, "up"}));
  writer.send("write ground sample 2");
  EXPECT_TRUE(reader.wait_for("goal ground sample 2"));
}

INSTANTIATE_TEST_SUITE_P(Hosts, Namespaces, kEveryNetworkPairing, pairing_name);

}  // namespace
}  // namespace roci::services::contract
