// What a match is worth: all that a reliable writer sends once it counts a reader reaches that reader, even
// if the reader has not found the writer yet.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/contract/support/inbox.hpp"
#include "tests/contract/support/pairing.hpp"
#include "tests/contract/support/profiles.hpp"

namespace roci::services::contract {
namespace {

using testing::ElementsAreArray;

class Matching : public PairingTest {
 protected:
  // "goal=first" to "goal=last".
  static std::vector<std::string> goals(int first, int last) {
    std::vector<std::string> texts;
    for (int i = first; i <= last; ++i) texts.push_back("goal=" + std::to_string(i));
    return texts;
  }
  // The last `count` of `texts`, or all.
  static std::vector<std::string> tail(const std::vector<std::string>& texts, std::size_t count) {
    return {texts.end() - static_cast<std::ptrdiff_t>(std::min(count, texts.size())), texts.end()};
  }
};

constexpr int kBurst = 50;

// A topic of its own for each round: a writer may still count the reader of the round before.
transport::EndpointDescription round_endpoint(int round, const transport::QosSettings& qos) {
  return endpoint<v1::Goal>("roci/goal/" + std::to_string(round), "roci::v1::Goal", qos);
}

TEST_P(Matching, WhatAWriterSendsAtOnceReachesTheReaderItCounts) {
  const auto sender = open_writing();
  const auto receiver = open_reading();
  for (int round = 0; round < 20; ++round) {
    Inbox matches, inbox;
    std::unique_ptr<transport::Writer> writer;
    std::unique_ptr<transport::Reader> reader;
    const bool reader_first = round % 2 == 0;
    if (reader_first)
      reader = receiver->create_reader(round_endpoint(round, request()), inbox.reader_events());
    writer = sender->create_writer(round_endpoint(round, request()), matches.writer_events());
    if (!reader_first)
      reader = receiver->create_reader(round_endpoint(round, request()), inbox.reader_events());
    ASSERT_TRUE(matches.wait_for_match());
    for (int i = 1; i <= kBurst; ++i) ASSERT_TRUE(writer->write(goal("goal", i)));
    ASSERT_TRUE(inbox.wait_for_samples(kBurst)) << "round " << round << ": " << inbox.samples().size();
    ASSERT_THAT(inbox.goals(), ElementsAreArray(goals(1, kBurst)));
  }
}

TEST_P(Matching, SoItIsBetweenParticipantsThatHaveJustMet) {
  for (int round = 0; round < 5; ++round) {
    Inbox matches, inbox;
    const auto receiver = open_reading();
    const auto reader = receiver->create_reader(round_endpoint(round, request()), inbox.reader_events());
    const auto sender = open_writing();
    const auto writer = sender->create_writer(round_endpoint(round, request()), matches.writer_events());
    ASSERT_TRUE(matches.wait_for_match());
    for (int i = 1; i <= kBurst; ++i) ASSERT_TRUE(writer->write(goal("goal", i)));
    ASSERT_TRUE(inbox.wait_for_samples(kBurst)) << "round " << round << ": " << inbox.samples().size();
    ASSERT_THAT(inbox.goals(), ElementsAreArray(goals(1, kBurst)));
  }
}

TEST_P(Matching, AndForAVolatileReaderOfAWriterThatKeepsThePastForOthers) {
  const auto sender = open_writing();
  const auto receiver = open_reading();
  for (int round = 0; round < 10; ++round) {
    Inbox matches, inbox;
    const auto writer =
        sender->create_writer(round_endpoint(round, latched(2 * kBurst)), matches.writer_events());
    for (int i = 1; i <= kBurst; ++i) ASSERT_TRUE(writer->write(goal("past", i)));
    const auto reader = receiver->create_reader(round_endpoint(round, request()), inbox.reader_events());
    ASSERT_TRUE(matches.wait_for_match());
    for (int i = 1; i <= kBurst; ++i) ASSERT_TRUE(writer->write(goal("goal", i)));
    const auto newest = goals(kBurst, kBurst);
    ASSERT_TRUE(inbox.wait_until([&] { return tail(inbox.goals(), 1) == newest; })) << "round " << round;
    // Whether the past comes too depends on the vendor (docs/dds.md, quirks).
    ASSERT_THAT(tail(inbox.goals(), kBurst), ElementsAreArray(goals(1, kBurst)));
  }
}

TEST_P(Matching, WhoJoinsLateHearsOfInstancesInTheOrderInWhichTheyWereWritten) {
  const auto sender = open_writing();
  const auto receiver = open_reading();
  Inbox inbox;
  const auto writer = sender->create_writer(round_endpoint(0, latched(1)), {});
  std::vector<std::string> written;
  for (int i = 1; i <= kBurst; ++i) {
    const std::string name = "goal-" + std::to_string(i);
    ASSERT_TRUE(writer->write(goal(name, i)));
    written.push_back(name + "=" + std::to_string(i));
  }
  const auto reader = receiver->create_reader(round_endpoint(0, latched(1)), inbox.reader_events());
  ASSERT_TRUE(inbox.wait_for_samples(kBurst)) << inbox.samples().size();
  EXPECT_THAT(inbox.goals(), ElementsAreArray(written));
}

TEST_P(Matching, AReaderThatJoinsAStreamMissesNothingFromThenOn) {
  const auto sender = open_writing();
  // Beside the writer: Cyclone DDS merges what its readers of one process hear of a remote writer.
  const auto early_receiver = open_writing();
  const auto late_receiver = open_reading();
  Inbox matches, early, late;
  const auto writer = sender->create_writer(goal_endpoint(request()), matches.writer_events());
  const auto early_reader = early_receiver->create_reader(goal_endpoint(request()), early.reader_events());
  ASSERT_TRUE(matches.wait_for_match(1));
  int sent = 0;
  const auto send = [&] {
    const auto give_up = std::chrono::steady_clock::now() + kDeadline;
    ++sent;
    while (!writer->write(goal("goal", sent))) ASSERT_LT(std::chrono::steady_clock::now(), give_up);
  };
  for (int i = 0; i < kBurst; ++i) send();
  const auto late_reader = late_receiver->create_reader(goal_endpoint(request()), late.reader_events());
  while (matches.matched() < 2) {
    send();
    ASSERT_TRUE(early.wait_for_samples(static_cast<std::size_t>(sent)));
  }
  const int sent_before = sent;
  for (int i = 0; i < kBurst; ++i) send();
  ASSERT_TRUE(late.wait_until([&] { return tail(late.goals(), 1) == goals(sent, sent); }));
  const auto seen = late.goals();
  const int first = sent - static_cast<int>(seen.size()) + 1;
  EXPECT_THAT(seen, ElementsAreArray(goals(first, sent)));
  EXPECT_LE(first, sent_before + 1);
  ASSERT_TRUE(early.wait_for_samples(static_cast<std::size_t>(sent)));
  EXPECT_THAT(early.goals(), ElementsAreArray(goals(1, sent)));
}

INSTANTIATE_TEST_SUITE_P(Transports, Matching, kEveryPairing, pairing_name);

}  // namespace
}  // namespace roci::services::contract
