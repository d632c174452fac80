// Requests and replies between our transports and native participants, and between natives of the two vendors: each
// answered once, large, in the middle of a kill, and beside a stranger who has another type on the topic.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/contract/support/native_pairing.hpp"
#include "tests/contract/support/peers.hpp"

namespace roci::services::contract {
namespace {

using std::chrono::milliseconds;

// Pairing: whoever calls writes, whoever serves reads.
class NativeCalls : public testing::TestWithParam<Pairing> {
 protected:
  // Both topics of a call are matched when the first one is answered; a caller that is not yet matched asks again.
  bool begin(Peer& client) {
    for (int first = 1; first < 200; ++first) {
      client.send("call " + std::to_string(first) + " 3 4");
      if (client.wait_for("answer " + std::to_string(first) + " 0 found 5 2 yes", milliseconds(200)))
        return true;
    }
    return false;
  }

  process::DomainClaim domain_;
};

TEST_P(NativeCalls, EachOfAHundredIsAnsweredOnce) {
  Peer server(GetParam().reader, "path-server", domain_.id());
  Peer client(GetParam().writer, "path-client", domain_.id());
  ASSERT_TRUE(begin(client));
  constexpr int kFirst = 1001, kLast = 1100;
  for (int call = kFirst; call <= kLast; ++call) client.send("call " + std::to_string(call) + " 3 4");
  for (int call = kFirst; call <= kLast; ++call)
    ASSERT_TRUE(client.wait_for("answer " + std::to_string(call) + " 0 found 5 2 yes")) << call;
  client.send("call 2000 3 4");  // what was doubled has come before its answer
  ASSERT_TRUE(client.wait_for("answer 2000 0 found 5 2 yes"));
  ASSERT_TRUE(server.wait_for("call 2000 3 4"));
  for (int call = kFirst; call <= kLast; ++call) {
    const std::string number = std::to_string(call);
    EXPECT_EQ(std::ranges::count(server.lines(), "call " + number + " 3 4"), 1) << call;
    EXPECT_EQ(std::ranges::count(client.lines(), "answer " + number + " 0 found 5 2 yes"), 1) << call;
  }
  EXPECT_EQ(client.finish(), 0);
  EXPECT_EQ(server.finish(), 0);
}

TEST_P(NativeCalls, TwoMegabytesComeWhole) {
  // 24 bytes a way-point.
  std::vector<std::string> environment = peer_environment(GetParam().reader);
  environment.push_back("PEER_WAYPOINTS=90000");
  ChildProcess server(peer_command(GetParam().reader, "path-server", domain_.id()), environment);
  Peer client(GetParam().writer, "path-client", domain_.id());
  ASSERT_TRUE(client.wait_for("matched 1"));
  bool answered = false;
  for (int call = 1; call < 20 && !answered; ++call) {
    client.send("call " + std::to_string(call) + " 3 4");
    answered = client.wait_for("answer " + std::to_string(call) + " 0 found 5 90000 yes", milliseconds(4000));
  }
  EXPECT_TRUE(answered);
  EXPECT_EQ(client.finish(), 0);
  EXPECT_EQ(server.finish(), 0);
}

class NativeKill : public NativeCalls {};

TEST_P(NativeKill, AServerThatIsKilledIsNoticedAndTheNextOneAnswers) {
  Peer client(GetParam().writer, "path-client", domain_.id());
  {
    Peer server(GetParam().reader, "path-server", domain_.id());
    ASSERT_TRUE(begin(client));
    server.kill();
  }
  ASSERT_TRUE(client.wait_for("matched 0"));
  client.send("call 500 3 4");  // nobody is there
  Peer successor(GetParam().reader, "path-server", domain_.id());
  ASSERT_TRUE(client.wait_for("matched 1"));
  EXPECT_TRUE(begin(client));
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
  ASSERT_TRUE(begin(client));
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
