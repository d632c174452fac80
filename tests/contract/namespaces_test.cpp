// Two hosts: two network namespaces joined by a veth pair. Needs the right to make namespaces (root), which
// is why it is a program of its own; CMake registers it only where `ip netns` works.
#include <gmock/gmock.h>
#include <unistd.h>

#include "tests/contract/support/pairing.hpp"
#include "tests/contract/support/peers.hpp"

namespace roci::services::contract {
namespace {

constexpr int kDomain = 7;  // nobody else is in these namespaces

void run(const std::vector<std::string>& command) {
  if (ChildProcess(command).finish() == 0) return;
  std::string text = "cannot set up network namespaces (it takes root):";
  for (const auto& word : command) text += " " + word;
  throw std::runtime_error(text);
}

struct Host {
  std::string name;
  std::string link;
  std::string address;

  std::vector<std::string> inside(const std::vector<std::string>& command) const {
    std::vector<std::string> all{"ip", "netns", "exec", name};
    all.insert(all.end(), command.begin(), command.end());
    return all;
  }
};

// Both hosts and their link, until the test ends.
class TwoHosts {
 public:
  TwoHosts() {
    for (const auto& host : {rover, ground}) run({"ip", "netns", "add", host.name});
    run({"ip", "link", "add", rover.link, "netns", rover.name, "type", "veth", "peer", "name", ground.link,
         "netns", ground.name});
    for (const auto& host : {rover, ground}) {
      run(host.inside({"ip", "address", "add", host.address + "/24", "dev", host.link}));
      run(host.inside({"ip", "link", "set", host.link, "up"}));
      run(host.inside({"ip", "link", "set", "lo", "up"}));
    }
    for (const auto& host : {rover, ground}) wait_for_link(host);
  }
  ~TwoHosts() {
    for (const auto& host : {rover, ground}) ChildProcess({"ip", "netns", "del", host.name}).finish();
  }
  TwoHosts(const TwoHosts&) = delete;
  TwoHosts& operator=(const TwoHosts&) = delete;

  static void wait_for_link(const Host& host) {
    const std::vector<std::string> state{"cat", "/sys/class/net/" + host.link + "/operstate"};
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!ChildProcess(host.inside(state)).wait_for("up")) {
      if (std::chrono::steady_clock::now() > give_up)
        throw std::runtime_error(host.link + " does not come up");
    }
  }

  const std::string id = std::to_string(getpid());
  const Host rover{"roci-rover-" + id, "rr" + id, "10.77.0.1"};
  const Host ground{"roci-ground-" + id, "rg" + id, "10.77.0.2"};
};

class Namespaces : public testing::TestWithParam<Pairing> {
 protected:
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

TEST_P(Namespaces, CallsAreAnsweredAcross) {
  ChildProcess server(peer(hosts_.rover, hosts_.ground, GetParam().reader, "path-server"));
  ChildProcess client(peer(hosts_.ground, hosts_.rover, GetParam().writer, "path-client"));
  ASSERT_TRUE(client.wait_for("matched 1"));
  bool answered = false;
  for (int call = 1; call <= 100 && !answered; ++call) {
    client.send("call " + std::to_string(call) + " 3 4");
    answered = client.wait_for("answer " + std::to_string(call) + " 0 found 5 2 yes",
                               std::chrono::milliseconds(200));
  }
  EXPECT_TRUE(answered);
}

TEST_P(Namespaces, ACutLinkIsNoticedAndItsReturnToo) {
  ChildProcess writer(peer(hosts_.rover, hosts_.ground, GetParam().writer, "goal-writer"));
  ChildProcess reader(peer(hosts_.ground, hosts_.rover, GetParam().reader, "goal-reader"));
  writer.send("write ground photo 1");
  ASSERT_TRUE(reader.wait_for("goal ground photo 1"));
  run(hosts_.rover.inside({"ip", "link", "set", hosts_.rover.link, "down"}));
  ASSERT_TRUE(reader.wait_for("lost ground photo"));
  run(hosts_.rover.inside({"ip", "link", "set", hosts_.rover.link, "up"}));
  writer.send("write ground sample 2");
  EXPECT_TRUE(reader.wait_for("goal ground sample 2"));
}

INSTANTIATE_TEST_SUITE_P(Hosts, Namespaces, kEveryNetworkPairing, pairing_name);

}  // namespace
}  // namespace roci::services::contract
