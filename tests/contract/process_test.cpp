// Participants in processes of their own: killed, restarted, and in the middle of a call.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/contract/support/inbox.hpp"
#include "tests/contract/support/pairing.hpp"
#include "tests/contract/support/peers.hpp"
#include "tests/contract/support/profiles.hpp"

namespace roci::services::contract {
namespace {

using testing::ElementsAre;

class Processes : public PairingTest {};

TEST_P(Processes, AKilledWriterIsNoticedAndItsSuccessorHeard) {
  const auto receiver = open_reading();
  Inbox inbox;
  const auto reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
  {
    Peer peer(GetParam().writer, "goal-writer", domain_.id());
    peer.send("write ground photo 1");
    ASSERT_TRUE(inbox.wait_for_samples(1));
    peer.kill();
  }
  ASSERT_TRUE(inbox.wait_for_match(0));
  ASSERT_TRUE(inbox.wait_for_samples(2));
  EXPECT_THAT(inbox.ended(transport::SampleKind::no_writers), ElementsAre("ground/photo"));

  Peer successor(GetParam().writer, "goal-writer", domain_.id());
  successor.send("write ground photo 2");
  ASSERT_TRUE(inbox.wait_for_samples(3));
  EXPECT_THAT(inbox.goals(), ElementsAre("photo=1", "photo=2"));
  EXPECT_EQ(successor.finish(), 0);
}

TEST_P(Processes, AKilledReaderIsNoticedAndItsSuccessorServed) {
  const auto sender = open_writing();
  Inbox matches;
  const auto writer = sender->create_writer(goal_endpoint(latched(1)), matches.writer_events());
  ASSERT_TRUE(writer->write(goal("photo", 1)));
  {
    Peer peer(GetParam().reader, "goal-reader", domain_.id());
    ASSERT_TRUE(peer.wait_for("goal ground photo 1"));
    ASSERT_TRUE(matches.wait_for_match(1));
    peer.kill();
  }
  ASSERT_TRUE(matches.wait_for_match(0));
  Peer successor(GetParam().reader, "goal-reader", domain_.id());
  ASSERT_TRUE(successor.wait_for("goal ground photo 1"));
  EXPECT_EQ(successor.finish(), 0);
}

TEST_P(Processes, AServerKilledDuringACallIsNoticedAndTheNextOneAnswers) {
  Peer client(GetParam().writer, "path-client", domain_.id());
  {
    Peer server(GetParam().reader, "path-server", domain_.id());
    ASSERT_TRUE(client.wait_for("matched 1"));  // its request writer counts the server's reader
    client.send("call 1 3 4");
    ASSERT_TRUE(server.wait_for("call 1 3 4"));
    server.kill();
  }
  ASSERT_TRUE(client.wait_for("matched 0"));
  Peer server(GetParam().reader, "path-server", domain_.id());
  // Both writers count their readers: what is sent from now on arrives, the first call and its answer.
  ASSERT_TRUE(server.wait_for("matched 1"));
  const auto matched_again = [&client] {
    const auto& lines = client.lines();
    const auto lost = std::ranges::find(lines, "matched 0");
    return std::find(lost, lines.end(), "matched 1") != lines.end();
  };
  while (!matched_again()) ASSERT_TRUE(client.wait_for_more());
  client.send("call 2 3 4");
  EXPECT_TRUE(client.wait_for("answer 2 0 found 5 2 yes"));
}

TEST_P(Processes, ACleanExitIsNoticedAtOnce) {
  const auto receiver = open_reading();
  Inbox inbox;
  const auto reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
  Peer peer(GetParam().writer, "goal-writer", domain_.id());
  peer.send("write ground photo 1");
  ASSERT_TRUE(inbox.wait_for_samples(1));
  ASSERT_EQ(peer.finish(), 0);
  EXPECT_TRUE(inbox.wait_until([&inbox] { return inbox.matched() == 0; }, std::chrono::seconds(2)));
  EXPECT_THAT(inbox.ended(transport::SampleKind::no_writers), ElementsAre("ground/photo"));
}

INSTANTIATE_TEST_SUITE_P(Transports, Processes, kEveryNetworkPairing, pairing_name);

}  // namespace
}  // namespace roci::services::contract
