// Datagrams and samples that mean harm, from participants that are nobody's: none ends a process of ours, none takes
// somebody's place, and what is bound is bound to loopback alone.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>

#include "services/clock/wall.hpp"
#include "services/node.hpp"
#include "services/publisher.hpp"
#include "services/transport/rtps_ports.hpp"
#include "tests/contract/hostile/participant.hpp"
#include "tests/contract/support/pairing.hpp"
#include "tests/contract/support/peers.hpp"
#include "tests/contract/support/udp_sockets.hpp"

namespace roci::services::contract {
namespace {

using hostile::Message;
using hostile::Prefix;

constexpr std::uint32_t kLoopback = 0x7f000001;

std::vector<std::string> reader_command(const std::string& vendor, int domain) {
  return {ROCI_BINARY_DIR "/tests/contract-reader", vendor, std::to_string(domain)};
}
std::vector<std::string> hostile_command(const std::string& role, int domain) {
  return {ROCI_BINARY_DIR "/tests/contract-hostile", role, std::to_string(domain)};
}

class Hostile : public testing::TestWithParam<const char*> {
 protected:
  // A goal of an honest writer, in a process of its own, still arrives.
  void expect_still_reading(ChildProcess& reader) {
    expect_a_goal_to_arrive(reader);
    EXPECT_EQ(reader.finish(), 0);
  }
  void expect_a_goal_to_arrive(ChildProcess& reader) {
    ChildProcess writer(peer_command(GetParam(), "goal-writer", domain_.id()), {"PEER_PARTITION=roci.team"});
    writer.send("write ground photo 1");
    EXPECT_TRUE(reader.wait_for("goal ground photo"));
  }

  process::DomainClaim domain_;
};

TEST_P(Hostile, MalformedSamplesOnEveryTopicEndNoReader) {
  ChildProcess reader(reader_command(GetParam(), domain_.id()));
  ASSERT_TRUE(reader.wait_for("ready"));
  ChildProcess writers(hostile_command("writers", domain_.id()));
  ASSERT_TRUE(reader.wait_for("matched all")) << "both hostile participants, on every topic";
  ASSERT_TRUE(writers.wait_for("round 2"));
  expect_still_reading(reader);
}

TEST_P(Hostile, AReaderThatComesLateSurvivesWhatIsLatched) {
  ChildProcess writers(hostile_command("writers", domain_.id()));
  ASSERT_TRUE(writers.wait_for("round 2"));
  ChildProcess reader(reader_command(GetParam(), domain_.id()));
  ASSERT_TRUE(reader.wait_for("matched all"));
  ASSERT_TRUE(writers.wait_for_more());
  ASSERT_TRUE(writers.wait_for_more());
  expect_still_reading(reader);
}

// Fast DDS reads statistics behind each message of its own kind; Debian's build asserts that they stand at its end.
TEST_P(Hostile, StatisticsInTheMiddleOfAMessageAreNotRead) {
  ChildProcess reader(reader_command(GetParam(), domain_.id()));
  ASSERT_TRUE(reader.wait_for("ready"));
  const hostile::Participant attacker(kLoopback, domain_.id(), hostile::kEprosima, 1, "");
  attacker.send_statistics_in_the_middle();
  expect_still_reading(reader);
}

// Operators hear of what the guard of a service refuses, by a few events however much it is.
TEST_P(Hostile, WhatIsRefusedIsToldByAnEvent) {
  node::NodeOptions options;
  options.name = "listener";
  options.run = "test";
  options.clock = clock::ClockMode::observer;
  Node listener(options,
                transport::open_transport(GetParam(), {.domain = domain_.id(), .participant = "listener"}));
  std::vector<v1::Event> told;
  subscribe(listener, topics::event, [&](const v1::Event& event) {
    if (event.code() == "datagram.refused") told.push_back(event);
  });
  ChildProcess service({ROCI_BINARY_DIR "/tests/contract-robot", "--mission",
                        ROCI_SOURCE_DIR "/missions/planetary", "--name", "world", "--clock", "live",
                        "--epoch", std::to_string(clock::unix_us() / 1'000'000), "--run", "test", "--dds",
                        GetParam(), "--domain", std::to_string(domain_.id())});
  const auto until = [&](const auto& so) {
    for (int i = 0; i < 2000 && !so(); ++i) listener.spin_once(std::chrono::milliseconds(10));
    return so();
  };
  ASSERT_TRUE(until([&] { return listener.peer_alive("world"); }));
  const hostile::Participant attacker(kLoopback, domain_.id(), hostile::kEclipse, 1, "");
  auto message = attacker.message();
  message.submessage(0x7e, 0, hostile::Bytes(8));
  const auto about = [&](const std::string& reason) {
    return std::ranges::count_if(told, [&](const v1::Event& event) {
      return event.header().sender() == "world" && event.properties().at(1).value() == reason;
    });
  };
  EXPECT_TRUE(until([&] {
    for (int i = 0; i < 20; ++i) attacker.send_to_discovery(message);
    return about("unknown_submessage") >= 2;
  }));
  EXPECT_LE(about("unknown_submessage"), 6) << "of some ten thousand";
  EXPECT_THAT(told.back().properties().at(3).value(), testing::StartsWith("127.0.0.1:"));
}

TEST_P(Hostile, SocketsAreBoundToLoopbackAlone) {
  ChildProcess reader(reader_command(GetParam(), domain_.id()));
  ASSERT_TRUE(reader.wait_for("ready"));
  EXPECT_THAT(udp_addresses_of(reader.pid()),
              testing::AllOf(testing::SizeIs(testing::Ge(2U)), testing::Each("127.0.0.1")));
  EXPECT_EQ(reader.finish(), 0);
}

// Binds the highest port at which both vendors look for others, and hears their announcements there.
class Eavesdropper {
 public:
  explicit Eavesdropper(int domain) : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_addr.s_addr = htonl(kLoopback);
    own.sin_port = htons(static_cast<std::uint16_t>(transport::first_participant_port(domain) +
                                                    2 * (transport::kMaxParticipantsPerHost - 2)));
    const timeval patience{20, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (bind(socket_, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0)
      throw std::runtime_error("the port is taken");
  }
  ~Eavesdropper() { close(socket_); }
  Eavesdropper(const Eavesdropper&) = delete;
  Eavesdropper& operator=(const Eavesdropper&) = delete;

  /// The next message from a participant that is not `known`.
  hostile::Bytes hear_other_than(const Prefix& known) const {
    for (;;) {
      hostile::Bytes bytes(65536);
      const auto size = recv(socket_, bytes.data(), bytes.size(), 0);
      if (size < 0) throw std::runtime_error("nobody announces itself");
      bytes.resize(static_cast<std::size_t>(size));
      if (bytes.size() > 20 && prefix_in(bytes) != known) return bytes;
    }
  }
  static Prefix prefix_in(const hostile::Bytes& message) {
    Prefix prefix;
    std::copy_n(message.begin() + 8, prefix.size(), prefix.begin());
    return prefix;
  }

 private:
  int socket_;
};

// Each says that the victim has left: under its name, under the attacker's own, and with a change of name on the way.
std::vector<Message> farewells_of(const Prefix& victim, const Prefix& own, hostile::Vendor vendor) {
  constexpr hostile::Entity kWriter = 0x000100c2, kReader = 0x000100c7;
  const auto [end, named] = hostile::farewell_of(victim);
  hostile::Bytes source{0, 0, 0, 0, 2, 2, vendor[0], vendor[1]};
  hostile::put_bytes(source, victim);
  std::vector<Message> messages;
  for (const Prefix& sender : {victim, own}) {
    messages.push_back(Message(sender, vendor).data(kReader, kWriter, 1000, hostile::kInlineQos, end, {}));
    messages.push_back(Message(sender, vendor)
                           .data(kReader, kWriter, 1001, hostile::kInlineQos | hostile::kKey, end, named));
  }
  messages.push_back(Message(own, vendor)
                         .submessage(0x0c, 0, source)
                         .data(kReader, kWriter, 1002, hostile::kInlineQos, end, {}));
  return messages;
}

TEST_P(Hostile, NobodyElseSaysFarewellForAParticipant) {
  const Eavesdropper eavesdropper(domain_.id());
  Peer reader(GetParam(), "goal-reader", domain_.id());
  ASSERT_TRUE(reader.wait_for("ready"));
  const Prefix readers = Eavesdropper::prefix_in(eavesdropper.hear_other_than({}));
  Peer writer(GetParam(), "goal-writer", domain_.id());
  writer.send("write ground photo 1");
  ASSERT_TRUE(reader.wait_for("goal ground photo 1"));
  const Prefix writers = Eavesdropper::prefix_in(eavesdropper.hear_other_than(readers));
  for (const hostile::Vendor vendor : {hostile::kEprosima, hostile::kEclipse}) {
    const hostile::Participant attacker(kLoopback, domain_.id(), vendor, 1, "");
    for (const Message& farewell : farewells_of(writers, attacker.prefix(), vendor))
      attacker.send_to_discovery(farewell);
  }
  writer.send("write ground photo 2");
  ASSERT_TRUE(reader.wait_for("goal ground photo 2"));
  EXPECT_EQ(reader.finish(), 0);
  EXPECT_THAT(reader.lines(), testing::Not(testing::Contains("lost ground photo")));
  EXPECT_THAT(reader.lines(), testing::Not(testing::Contains("matched 0")));
}

std::string hex(const Prefix& prefix) {
  std::string text;
  for (const std::uint8_t byte : prefix) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    text += {kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return text;
}

// Small samples and some that go in fragments.
TEST_P(Hostile, AReaderThatAsksForWhatIsNotEndsAndHoldsNoWriter) {
  const Eavesdropper eavesdropper(domain_.id());
  Peer writer(GetParam(), "goal-writer", domain_.id(), {"PEER_PARTITION=roci.team"});
  ASSERT_TRUE(writer.wait_for("ready"));
  const Prefix writers = Eavesdropper::prefix_in(eavesdropper.hear_other_than({}));
  writer.send("write ground small 1");
  writer.send("write ground " + std::string(150'000, 'x') + " 1");
  auto command = hostile_command("asks", domain_.id());
  command.insert(command.end(), {hex(writers), "0"});
  ChildProcess asker(command);
  ASSERT_TRUE(writer.wait_for("matched 1"));
  ASSERT_TRUE(asker.wait_for("round 9"));
  const std::string large(150'000, 'y');
  writer.send("write ground " + large + " 2");
  ASSERT_TRUE(asker.wait_for("round 12"));
  ChildProcess reader(reader_command(GetParam(), domain_.id()));
  EXPECT_TRUE(reader.wait_for("goal ground " + large));
  writer.send("write ground photo 3");
  EXPECT_TRUE(reader.wait_for("goal ground photo"));
  EXPECT_EQ(reader.finish(), 0);
  EXPECT_EQ(writer.finish(), 0);
}

// Debian's Fast DDS asserts, or stands still for ever, where a farewell meets the end of its sender's lease.
TEST_P(Hostile, AFarewellAtTheEndOfALeaseEndsNoReader) {
  ChildProcess reader(reader_command(GetParam(), domain_.id()));
  ASSERT_TRUE(reader.wait_for("ready"));
  hostile::Participant passer_by(kLoopback, domain_.id(), hostile::kEprosima, 1, "");
  constexpr int kVisits = 10'000;
  for (int i = 0; i < kVisits; ++i) {
    passer_by.set_lease(std::chrono::microseconds(1 + i % 500));
    passer_by.announce();
    passer_by.leave();
  }
  expect_still_reading(reader);
}

TEST_P(Hostile, GapsTakeLittleMemoryOfAReader) {
  ChildProcess reader(reader_command(GetParam(), domain_.id()));
  ASSERT_TRUE(reader.wait_for("ready"));
  const std::size_t before = peak_memory(reader.pid());
  ChildProcess writers(hostile_command("gaps", domain_.id()));
  ASSERT_TRUE(reader.wait_for("matched roci/goal"));
  while (writers.lines().size() < 25) ASSERT_TRUE(writers.wait_for_more());
  expect_a_goal_to_arrive(reader);
  EXPECT_LT(peak_memory(reader.pid()) - before, std::size_t{250} << 20) << "gigabytes without a bound";
  EXPECT_EQ(reader.finish(), 0);
}

TEST_P(Hostile, EndpointsThatAreAnnouncedTakeLittleMemoryOfAReader) {
  constexpr int kEndpoints = 8'000;
  ChildProcess reader(reader_command(GetParam(), domain_.id()));
  ASSERT_TRUE(reader.wait_for("ready"));
  hostile::Participant crowd(kLoopback, domain_.id(), hostile::kEprosima, 1, "");
  crowd.announce();
  expect_a_goal_to_arrive(reader);
  const std::size_t before = peak_memory(reader.pid());
  for (int i = 0; i < kEndpoints; ++i) crowd.add_writer({"topic " + std::to_string(i), "type", true, {}});
  for (int i = 0; i < 3; ++i) crowd.announce();
  expect_a_goal_to_arrive(reader);
  EXPECT_LT(peak_memory(reader.pid()) - before, std::size_t{8} << 20);
  EXPECT_EQ(reader.finish(), 0);
}

TEST_P(Hostile, SamplesBehindOneThatNeverComesTakeBoundedMemory) {
  ChildProcess reader(reader_command(GetParam(), domain_.id()));
  ASSERT_TRUE(reader.wait_for("ready"));
  expect_a_goal_to_arrive(reader);
  const std::size_t before = peak_memory(reader.pid());
  ChildProcess writer(hostile_command("ahead", domain_.id()));
  ASSERT_TRUE(writer.wait_for("round 50"));
  expect_a_goal_to_arrive(reader);
  EXPECT_LT(peak_memory(reader.pid()) - before, std::size_t{100} << 20);
  EXPECT_EQ(reader.finish(), 0);
}

TEST_P(Hostile, HeartbeatsWithoutMeasureNeitherEndNorHoldAReader) {
  ChildProcess reader(reader_command(GetParam(), domain_.id()));
  ASSERT_TRUE(reader.wait_for("ready"));
  ChildProcess writer(hostile_command("starts", domain_.id()));
  ASSERT_TRUE(reader.wait_for("matched roci/goal"));
  while (writer.lines().size() < 15) ASSERT_TRUE(writer.wait_for_more());
  expect_a_goal_to_arrive(reader);
  EXPECT_EQ(reader.finish(), 0);
}

INSTANTIATE_TEST_SUITE_P(Vendors, Hostile, testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::services::contract
