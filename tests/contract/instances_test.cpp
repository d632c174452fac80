// The life of keyed instances: many of them, disposed, and left by their writers.
#include <gmock/gmock.h>

#include <chrono>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <set>

#include "roci_idl/command.h"
#include "services/transport/forgets_instances.hpp"
#include "tests/contract/support/inbox.hpp"
#include "tests/contract/support/pairing.hpp"
#include "tests/contract/support/profiles.hpp"

namespace roci::services::contract {
namespace {

using testing::ElementsAre;

class Instances : public PairingTest {};

TEST_P(Instances, AThousandKeysLiveAndLate) {
  constexpr int kCount = 1000;
  const auto sender = open_writing();
  const auto receiver = open_reading();
  Inbox live, late;
  const auto writer = sender->create_writer(goal_endpoint(latched(1)), {});
  const auto live_reader = receiver->create_reader(goal_endpoint(latched(1)), live.reader_events());
  ASSERT_TRUE(live.wait_for_match());
  std::set<std::string> expected;
  for (int i = 0; i < kCount; ++i) {
    ASSERT_TRUE(writer->write(goal("goal-" + std::to_string(i), i)));
    expected.insert("goal-" + std::to_string(i) + "=" + std::to_string(i));
  }
  ASSERT_TRUE(live.wait_for_samples(kCount));
  const auto late_reader = receiver->create_reader(goal_endpoint(latched(1)), late.reader_events());
  ASSERT_TRUE(late.wait_for_samples(kCount));
  for (const auto* inbox : {&live, &late}) {
    const auto goals = inbox->goals();
    EXPECT_EQ(std::set<std::string>(goals.begin(), goals.end()), expected);
    EXPECT_EQ(goals.size(), expected.size());
  }
}

TEST_P(Instances, DisposeCarriesTheKeyAndClearsTheState) {
  const auto sender = open_writing();
  const auto receiver = open_reading();
  Inbox inbox, late;
  const auto writer = sender->create_writer(goal_endpoint(latched(1)), {});
  const auto reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
  ASSERT_TRUE(writer->write(goal("photo", 1)));
  ASSERT_TRUE(writer->write(goal("sample", 2)));
  ASSERT_TRUE(inbox.wait_for_samples(2));
  ASSERT_TRUE(writer->dispose(goal("photo", 99)));
  ASSERT_TRUE(inbox.wait_for_samples(3));
  EXPECT_THAT(inbox.ended(transport::SampleKind::disposed), ElementsAre("ground/photo"));

  const auto late_reader = receiver->create_reader(goal_endpoint(latched(1)), late.reader_events());
  ASSERT_TRUE(late.wait_until([&late] { return !late.goals().empty(); }));
  ASSERT_TRUE(writer->write(goal("last", 3)));
  ASSERT_TRUE(late.wait_until([&late] { return late.goals().size() >= 2; }));
  EXPECT_THAT(late.goals(), ElementsAre("sample=2", "last=3"));
}

TEST_P(Instances, ADisposedInstanceLivesAgainWhenWritten) {
  const auto sender = open_writing();
  const auto receiver = open_reading();
  Inbox inbox;
  const auto writer = sender->create_writer(goal_endpoint(latched(1)), {});
  const auto reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
  for (int round = 1; round <= 3; ++round) {
    const auto before = inbox.samples().size();
    ASSERT_TRUE(writer->write(goal("photo", round)));
    ASSERT_TRUE(inbox.wait_for_samples(before + 1));
    ASSERT_TRUE(writer->dispose(goal("photo", 0)));
    ASSERT_TRUE(inbox.wait_for_samples(before + 2));
  }
  EXPECT_THAT(inbox.goals(), ElementsAre("photo=1", "photo=2", "photo=3"));
  EXPECT_EQ(inbox.ended(transport::SampleKind::disposed).size(), 3U);
}

TEST_P(Instances, OwnerLostForWhatTheLastWriterLeaves) {
  const auto sender = open_writing();
  const auto other_sender = open_writing();
  const auto receiver = open_reading();
  Inbox inbox;
  auto writer = sender->create_writer(goal_endpoint(latched(1)), {});
  auto other = other_sender->create_writer(goal_endpoint(latched(1)), {});
  const auto reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
  ASSERT_TRUE(inbox.wait_for_match(2));
  ASSERT_TRUE(writer->write(goal("mine", 1)));
  ASSERT_TRUE(writer->write(goal("ours", 1)));
  ASSERT_TRUE(writer->write(goal("gone", 1)));
  ASSERT_TRUE(inbox.wait_for_samples(3));
  ASSERT_TRUE(other->write(goal("ours", 2)));
  ASSERT_TRUE(inbox.wait_for_samples(4));
  ASSERT_TRUE(writer->dispose(goal("gone", 1)));
  ASSERT_TRUE(inbox.wait_for_samples(5));
  writer.reset();
  ASSERT_TRUE(inbox.wait_for_match(1));
  ASSERT_TRUE(inbox.wait_for_samples(6));
  EXPECT_THAT(inbox.ended(transport::SampleKind::no_writers), ElementsAre("ground/mine"));
  other.reset();
  ASSERT_TRUE(inbox.wait_for_samples(7));
  EXPECT_THAT(inbox.ended(transport::SampleKind::no_writers), ElementsAre("ground/mine", "ground/ours"));
}

// What this process itself has taken, in kB.
std::size_t own_memory() {
  std::ifstream status("/proc/self/status");
  std::string word;
  std::size_t kilobytes = 0;
  while (status >> word)
    if (word == "RssAnon:") status >> kilobytes;
  return kilobytes;
}

// A writer that makes things for months and forgets what is finished: neither it nor its readers keep what is gone.
TEST_P(Instances, WhatIsForgottenTakesNoMemory) {
  constexpr int kKeys = 2'400;
  constexpr int kAlive = 16;
  const auto sender = open_writing();
  const auto receiver = open_reading();
  std::mutex mutex;
  std::condition_variable changed;
  int ended = 0;
  const auto reader = receiver->create_reader(goal_endpoint(latched(32)),
                                              {[&](transport::Sample&& sample) {
                                                 const std::lock_guard lock(mutex);
                                                 ended += sample.kind == transport::SampleKind::disposed;
                                                 changed.notify_all();
                                               },
                                               {}});
  Inbox matches;
  const auto writer = sender->create_writer(goal_endpoint(latched(32)), matches.writer_events());
  ASSERT_TRUE(matches.wait_for_match());
  auto* forgetting = dynamic_cast<transport::ForgetsInstances*>(writer.get());
  ASSERT_NE(forgetting, nullptr);
  if (GetParam().writer == "cyclonedds" && GetParam().reader == "fastdds")
    GTEST_SKIP() << "what Fast DDS has not confirmed yet is most of what this test writes";
  const std::string large(8'000, 'x');
  const auto make_and_forget = [&](int from, int to) {
    for (int i = from; i < to; ++i) {
      ASSERT_TRUE(writer->write(goal("goal-" + std::to_string(i), i, "ground", large)));
      if (i < kAlive) continue;
      ASSERT_TRUE(forgetting->forget(goal("goal-" + std::to_string(i - kAlive), 0)));
      // So that nothing is merely under way; Fast DDS forgets when it is asked and everything is confirmed.
      const auto deadline = std::chrono::steady_clock::now() + kDeadline;
      std::unique_lock lock(mutex);
      while (
          !changed.wait_for(lock, std::chrono::milliseconds(20), [&] { return ended > i - kAlive - 64; })) {
        ASSERT_LT(std::chrono::steady_clock::now(), deadline);
        lock.unlock();
        forgetting->forget(goal("goal-" + std::to_string(i - kAlive), 0));
        lock.lock();
      }
    }
  };
  make_and_forget(0, kKeys / 6);
  const std::size_t before = own_memory();
  make_and_forget(kKeys / 6, kKeys);
  const std::size_t after = own_memory();
  EXPECT_LE(after, before + 5'000) << "kB, for " << kKeys * 5 / 6 << " samples of 8 kB each";
}

// Keys with a number beside the string: activity and attempt.
TEST_P(Instances, KeysOfSeveralMembers) {
  const auto sender = open_writing();
  const auto receiver = open_reading();
  const auto description = endpoint<v1::Command>("roci/command", "roci::v1::Command", latched(1));
  Inbox inbox;
  const auto writer = sender->create_writer(description, {});
  const auto reader = receiver->create_reader(description, inbox.reader_events());
  v1::Command command;
  command.activity("drive-1");
  for (std::uint32_t attempt = 1; attempt <= 2; ++attempt) {
    command.attempt(attempt);
    ASSERT_TRUE(writer->write(transport::serialize(command)));
  }
  ASSERT_TRUE(inbox.wait_for_samples(2));
  ASSERT_TRUE(writer->dispose(transport::serialize(command)));
  ASSERT_TRUE(inbox.wait_for_samples(3));
  v1::Command key;
  ASSERT_EQ(inbox.samples()[2].kind, transport::SampleKind::disposed);
  ASSERT_TRUE(transport::deserialize_key(inbox.samples()[2].payload, key));
  EXPECT_EQ(key.activity(), "drive-1");
  EXPECT_EQ(key.attempt(), 2U);
}

TEST_P(Instances, AMalformedSampleIsRefusedAtTheWriter) {
  const auto sender = open_writing();
  const auto writer = sender->create_writer(goal_endpoint(latched(1)), {});
  auto truncated = goal("photo", 1);
  truncated.resize(10);
  EXPECT_FALSE(writer->write(truncated));
  EXPECT_FALSE(writer->write({}));
  EXPECT_FALSE(writer->dispose(truncated));
  EXPECT_TRUE(writer->write(goal("photo", 1)));
}

INSTANTIATE_TEST_SUITE_P(Transports, Instances, kEveryPairing, pairing_name);

}  // namespace
}  // namespace roci::services::contract
