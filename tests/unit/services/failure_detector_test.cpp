#include "services/health/failure_detector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roci::services::health {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

v1::Heartbeat beat(std::uint32_t incarnation, v1::ServiceState state = v1::SERVICE_RUNNING) {
  v1::Heartbeat message;
  message.service("arm_svc");
  message.incarnation(incarnation);
  message.state(state);
  return message;
}

class FailureDetectorTest : public testing::Test {
 protected:
  std::vector<std::string> changes() {
    std::vector<std::string> texts;
    for (const PeerChange& change : peers.take_changes()) {
      texts.push_back(std::to_string(change.incarnation) + (change.alive ? " alive" : " " + change.cause));
    }
    return texts;
  }
  FailureDetector peers{5s};
  clock::WallTime start{1000s};
};

TEST_F(FailureDetectorTest, TheFirstHeartbeatMakesAPeer) {
  EXPECT_EQ(peers.state("arm_svc"), PeerState::never_seen);
  peers.heartbeat(beat(1), start);
  peers.heartbeat(beat(1), start + 1s);
  EXPECT_THAT(changes(), ElementsAre("1 alive"));
  EXPECT_EQ(peers.state("arm_svc"), PeerState::alive);
}

TEST_F(FailureDetectorTest, SilenceIsAHangAndANewHeartbeatItsEnd) {
  peers.heartbeat(beat(1), start);
  peers.check(start + 5s);
  EXPECT_THAT(changes(), ElementsAre("1 alive"));
  peers.check(start + 5001ms);
  EXPECT_THAT(changes(), ElementsAre("1 hung"));
  EXPECT_EQ(peers.state("arm_svc"), PeerState::dead);
  peers.heartbeat(beat(1), start + 6s);
  EXPECT_THAT(changes(), ElementsAre("1 alive"));
}

TEST_F(FailureDetectorTest, OtherSignsOfLifeCount) {
  peers.heartbeat(beat(2), start);
  peers.seen("arm_svc", 2, start + 4s);
  peers.seen("arm_svc", 1, start + 9s);  // of an older incarnation
  peers.check(start + 8s);
  EXPECT_THAT(changes(), ElementsAre("2 alive"));
  peers.check(start + 10s);
  EXPECT_THAT(changes(), ElementsAre("2 hung"));
}

TEST_F(FailureDetectorTest, AKillIsNotALeave) {
  peers.heartbeat(beat(1), start);
  peers.writer_lost("arm_svc");
  peers.writer_lost("arm_svc");
  EXPECT_THAT(changes(), ElementsAre("1 alive", "1 killed"));
  peers.heartbeat(beat(2), start);
  peers.heartbeat(beat(2, v1::SERVICE_STOPPING), start);
  peers.heartbeat(beat(2, v1::SERVICE_STOPPING), start + 1s);
  peers.writer_lost("arm_svc");
  EXPECT_THAT(changes(), ElementsAre("2 alive", "2 left"));
}

TEST_F(FailureDetectorTest, WhoSaysThatItStopsAndIsSilentHasLeft) {
  peers.heartbeat(beat(1), start);
  peers.heartbeat(beat(1, v1::SERVICE_STOPPING), start);
  peers.check(start + FailureDetector::kStillHeard);
  EXPECT_EQ(peers.state("arm_svc"), PeerState::alive);
  peers.check(start + FailureDetector::kStillHeard + 1ms);
  EXPECT_THAT(changes(), ElementsAre("1 alive", "1 left"));
  peers.heartbeat(beat(1, v1::SERVICE_STOPPING), start + 1s);
  EXPECT_EQ(peers.state("arm_svc"), PeerState::dead);
  peers.heartbeat(beat(2), start + 2s);
  EXPECT_THAT(changes(), ElementsAre("2 alive"));
}

TEST_F(FailureDetectorTest, NobodyWhoIsHeardHasLeftHoweverOftenItIsSaid) {
  clock::WallTime now = start;
  for (int turn = 0; turn < 40; ++turn, now += 250ms) {
    peers.heartbeat(beat(3), now);
    for (const std::uint32_t forged : {3U, 4U, 2U})
      peers.heartbeat(beat(forged, v1::SERVICE_STOPPING), now + 10ms);
    peers.check(now + 240ms);
  }
  EXPECT_THAT(changes(), ElementsAre("3 alive"));
  peers.writer_lost("arm_svc");
  EXPECT_EQ(peers.state("arm_svc"), PeerState::dead);
}

TEST_F(FailureDetectorTest, ANewIncarnationProvesTheDeathOfTheOld) {
  peers.heartbeat(beat(1), start);
  peers.heartbeat(beat(2), start + 1s);
  peers.heartbeat(beat(1), start + 1s);  // late
  EXPECT_THAT(changes(), ElementsAre("1 alive", "1 restarted", "2 alive"));
}

TEST_F(FailureDetectorTest, AForgedHeartbeatReplacesNobodyWhoIsHeard) {
  clock::WallTime now = start;
  for (int turn = 0; turn < 40; ++turn, now += 250ms) {
    peers.heartbeat(beat(3), now);
    for (const std::uint32_t forged : {4U, 7U, 4'000'000'000U, 2U}) peers.heartbeat(beat(forged), now + 10ms);
    peers.check(now + 20ms);
  }
  EXPECT_THAT(changes(), ElementsAre("3 alive"));
}

TEST_F(FailureDetectorTest, ANumberFarAheadIsNotTheSuccessorOfTheDead) {
  peers.heartbeat(beat(1), start);
  peers.writer_lost("arm_svc");
  peers.heartbeat(beat(1 + FailureDetector::kIncarnationJump + 1), start + 1s);
  peers.heartbeat(beat(2), start + 2s);
  EXPECT_THAT(changes(), ElementsAre("1 alive", "1 killed", "2 alive"));
}

TEST_F(FailureDetectorTest, WhoWasReplacedByAForgedNumberComesBackWhenThatIsSilent) {
  peers.heartbeat(beat(4'000'000'000U), start);  // before the real one was ever heard
  clock::WallTime now = start + 250ms;
  for (int turn = 0; turn < 40; ++turn, now += 250ms) {
    peers.heartbeat(beat(1), now);
    peers.check(now);
  }
  EXPECT_THAT(changes(), ElementsAre("4000000000 alive", "4000000000 hung", "1 alive"));
}

TEST_F(FailureDetectorTest, StrangersAreNobody) {
  peers.writer_lost("unknown");
  peers.seen("unknown", 1, start);
  peers.check(start + 100s);
  EXPECT_THAT(changes(), IsEmpty());
}

}  // namespace
}  // namespace roci::services::health
