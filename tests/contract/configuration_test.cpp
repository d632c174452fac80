// Whose settings a participant uses: ours, unless a vendor's own XML is given; and what it listens to.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include "services/transport/rtps_ports.hpp"
#include "tests/contract/support/inbox.hpp"
#include "tests/contract/support/pairing.hpp"
#include "tests/contract/support/peers.hpp"
#include "tests/contract/support/profiles.hpp"

namespace roci::services::contract {
namespace {

bool is_taken(int port) {
  const int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_port = htons(static_cast<std::uint16_t>(port));
  name.sin_addr.s_addr = htonl(INADDR_ANY);
  const bool taken = bind(probe, reinterpret_cast<const sockaddr*>(&name), sizeof name) != 0;
  close(probe);
  return taken;
}

// Any of the 40 participants whose ports begin here.
bool anybody_at(int first_port) {
  for (int port = first_port; port < first_port + 80; ++port) {
    if (is_taken(port)) return true;
  }
  return false;
}

class Configuration : public testing::TestWithParam<std::string> {
 protected:
  std::string other_ports_xml() const { return kPeerFolder + "/" + GetParam() + "_other_ports.xml"; }

  // Two participants with these options hear each other; nobody in the domain listens for multicast, and the
  // first of them listens at the port that `port_base` leads to.
  void expect_exchange(const transport::TransportOptions& options, int port_base) {
    const auto sender = transport::open_transport(GetParam(), options);
    const auto receiver = transport::open_transport(GetParam(), options);
    Inbox inbox;
    const auto writer = sender->create_writer(goal_endpoint(latched(1)), {});
    const auto reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
    EXPECT_TRUE(writer->write(goal("photo", 1)));
    EXPECT_TRUE(inbox.wait_for_samples(1));
    const int moved = port_base - 7400;
    EXPECT_EQ(anybody_at(transport::first_participant_port(options.domain)), moved == 0);
    EXPECT_EQ(anybody_at(transport::first_participant_port(options.domain) + 100), moved == 100);
    const int multicast_port = transport::first_participant_port(options.domain) - 10;
    EXPECT_FALSE(is_taken(multicast_port)) << "somebody listens for multicast";
    EXPECT_FALSE(is_taken(multicast_port + moved)) << "somebody listens for multicast";
  }

  process::DomainClaim domain_;
};

TEST_P(Configuration, OursIsUnicastOnLoopback) { expect_exchange({.domain = domain_.id()}, 7400); }

TEST_P(Configuration, TheVendorsXmlIsUsedWhenGiven) {
  expect_exchange({.domain = domain_.id(), .vendor_xml = other_ports_xml()}, 7500);
}

TEST_P(Configuration, TheVendorsEnvironmentDoesNotChangeOurs) {
  const auto native = "native-" + GetParam();
  // If ours heeded it, it would be at other ports than the native peer.
  const std::vector<std::string> environment{"FASTRTPS_DEFAULT_PROFILES_FILE=" + other_ports_xml(),
                                             "CYCLONEDDS_URI=" + other_ports_xml()};
  ChildProcess ours(peer_command(GetParam(), "goal-writer", domain_.id()), environment);
  Peer reader(native, "goal-reader", domain_.id());
  ours.send("write ground photo 1");
  EXPECT_TRUE(reader.wait_for("goal ground photo 1"));
}

INSTANTIATE_TEST_SUITE_P(Vendors, Configuration, testing::Values("fastdds", "cyclonedds"),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace roci::services::contract
