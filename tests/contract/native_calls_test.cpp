// Requests and replies between our transports and native participants of either vendor: each answered once, two
// megabytes long, across the kill of a server that has a call in hand, and beside a stranger who has another type on
// the topic.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/contract/support/native_pairing.hpp"
#include "tests/contract/support/peers.hpp"

namespace roci::services::contract {
namespace {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::Not;
using ::testing::StartsWith;

std::string call_line(int number) { return "call " + std::to_string(number) + " 3 4"; }
std::string answer_line(int number, int waypoints = 2) {
  return "answer " + std::to_string(number) + " 0 found 5 " + std::to_string(waypoints) + " yes";
}

// A native Cyclone DDS reader skips what a writer of Fast DDS sent before the first heartbeat that it hears from it
// (docs/dds.md, the vendors' quirk 11): the first request or reply may be lost, and no match tells when that is over.
bool may_lose_the_first(const Pairing& pairing) {
  const auto are = [&](const char* writer, const char* reader) {
    return pairing.writer == writer && pairing.reader == reader;
  };
  return are("fastdds", "native-cyclonedds") || are("native-cyclonedds", "fastdds");
}

// Pairing: whoever calls writes, whoever serves reads.
class NativeCalls : public testing::TestWithParam<Pairing> {
 protected:
  /// Makes the calls from number `first` on, until one is answered. Once both writers have their readers it is the
  /// first one, but for the pairings of quirk 11.
  static bool begin(Peer& client, Peer& server, int first = 1, int waypoints = 2) {
    if (!client.wait_for("matched 1") || !server.wait_for("matched 1")) return false;
    if (!may_lose_the_first(GetParam())) {
      client.send(call_line(first));
      return client.wait_for(answer_line(first, waypoints));
    }
    for (int call = first; call < first + 200; ++call) {
      client.send(call_line(call));
      if (client.wait_for(answer_line(call, waypoints), milliseconds(waypoints > 2 ? 4000 : 200)))
        return true;
    }
    return false;
  }

  process::DomainClaim domain_;
};

TEST_P(NativeCalls, EachOfAHundredIsAnsweredOnce) {
  Peer server(GetParam().reader, "path-server", domain_.id());
  Peer client(GetParam().writer, "path-client", domain_.id());
  ASSERT_TRUE(begin(client, server));
  constexpr int kFirst = 1001, kLast = 1100;
  for (int call = kFirst; call <= kLast; ++call) client.send(call_line(call));
  for (int call = kFirst; call <= kLast; ++call) ASSERT_TRUE(client.wait_for(answer_line(call))) << call;
  client.send(call_line(2000));  // what was doubled has come before its answer
  ASSERT_TRUE(client.wait_for(answer_line(2000)));
  ASSERT_TRUE(server.wait_for(call_line(2000)));
  for (int call = kFirst; call <= kLast; ++call) {
    EXPECT_EQ(std::ranges::count(server.lines(), call_line(call)), 1) << call;
    EXPECT_EQ(std::ranges::count(client.lines(), answer_line(call)), 1) << call;
  }
  EXPECT_EQ(client.finish(), 0);
  EXPECT_EQ(server.finish(), 0);
}

TEST_P(NativeCalls, TwoMegabytesComeWhole) {
  constexpr int kWaypoints = 90'000;  // of 24 bytes
  Peer server(GetParam().reader, "path-server", domain_.id(),
              {"PEER_WAYPOINTS=" + std::to_string(kWaypoints)});
  Peer client(GetParam().writer, "path-client", domain_.id());
  EXPECT_TRUE(begin(client, server, 1, kWaypoints));
  EXPECT_EQ(client.finish(), 0);
  EXPECT_EQ(server.finish(), 0);
}

class NativeKill : public NativeCalls {};

// The server dies with a call in hand, and another call is made while nobody is there. Requests are volatile: the next
// server hears of neither, and its own first one is answered.
TEST_P(NativeKill, AServerThatIsKilledDuringACallIsNoticedAndTheNextOneAnswers) {
  constexpr int kInHand = 400, kToNobody = 500;
  Peer client(GetParam().writer, "path-client", domain_.id());
  {
    Peer server(GetParam().reader, "path-server", domain_.id(),
                {"PEER_UNANSWERED=" + std::to_string(kInHand)});
    ASSERT_TRUE(begin(client, server));
    client.send(call_line(kInHand));
    ASSERT_TRUE(server.wait_for(call_line(kInHand)));
    server.kill();
  }
  ASSERT_TRUE(client.wait_for("matched 0"));
  client.send(call_line(kToNobody));
  Peer successor(GetParam().reader, "path-server", domain_.id());
  ASSERT_TRUE(successor.wait_for("matched 1"));
  const auto matched_again = [&client] {
    const auto& lines = client.lines();
    return std::find(std::ranges::find(lines, "matched 0"), lines.end(), "matched 1") != lines.end();
  };
  while (!matched_again()) ASSERT_TRUE(client.wait_for_more());
  EXPECT_TRUE(begin(client, successor, 601));
  EXPECT_THAT(successor.lines(), Not(Contains(call_line(kInHand))));
  EXPECT_THAT(successor.lines(), Not(Contains(call_line(kToNobody))));
  for (const int lost : {kInHand, kToNobody})
    EXPECT_THAT(client.lines(), Not(Contains(StartsWith("answer " + std::to_string(lost) + " "))));
  EXPECT_EQ(client.finish(), 0);
  EXPECT_EQ(successor.finish(), 0);
}

// Types match by name; a topic of the same name with another type is another topic.
TEST_P(NativeCalls, AStrangerWithAnotherTypeOnTheTopicIsNotHeard) {
  Peer server(GetParam().reader, "path-server", domain_.id());
  Peer stranger(GetParam().writer, "stranger", domain_.id());
  ASSERT_TRUE(stranger.wait_for("ready"));
  for (int goal = 0; goal < 50; ++goal) stranger.send("write ground goal-" + std::to_string(goal) + " 1");
  Peer client(GetParam().writer, "path-client", domain_.id());
  ASSERT_TRUE(begin(client, server));
  EXPECT_EQ(stranger.finish(), 0);
  EXPECT_EQ(client.finish(), 0);
  EXPECT_EQ(server.finish(), 0);
  for (const std::string& line : stranger.lines()) EXPECT_EQ(line, "ready");
  for (const std::string& line : server.lines())
    EXPECT_TRUE(line == "ready" || line.starts_with("matched") || line.ends_with(" 3 4")) << line;
}

INSTANTIATE_TEST_SUITE_P(Wire, NativeCalls, kEveryNativePairing, native_pairing_name);

// Of each program one that is killed, and one that notices; a lease of 3 s runs out each time.
INSTANTIATE_TEST_SUITE_P(Wire, NativeKill,
                         testing::Values(Pairing{"native-fastdds", "cyclonedds"},
                                         Pairing{"native-cyclonedds", "fastdds"},
                                         Pairing{"cyclonedds", "native-fastdds"},
                                         Pairing{"fastdds", "native-cyclonedds"}),
                         native_pairing_name);

}  // namespace
}  // namespace roci::services::contract
