// What readers get of the past and in which order.
#include <gmock/gmock.h>

#include "services/transport/refused_datagrams.hpp"
#include "tests/contract/support/inbox.hpp"
#include "tests/contract/support/pairing.hpp"
#include "tests/contract/support/profiles.hpp"

namespace roci::services::contract {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

class History : public PairingTest {};

TEST_P(History, LateJoinerSeesTheNewestStateOfEachKey) {
  const auto sender = open_writing();
  const auto receiver = open_reading();
  const auto writer = sender->create_writer(goal_endpoint(latched(1)), {});
  for (int priority = 1; priority <= 3; ++priority) {
    ASSERT_TRUE(writer->write(goal("photo", priority)));
    ASSERT_TRUE(writer->write(goal("sample", 10 * priority)));
  }
  Inbox inbox;
  const auto reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
  ASSERT_TRUE(inbox.wait_for_samples(2));
  ASSERT_TRUE(writer->write(goal("last", 0)));
  ASSERT_TRUE(inbox.wait_for_samples(3));
  EXPECT_THAT(inbox.goals(), UnorderedElementsAre("photo=3", "sample=30", "last=0"));
}

TEST_P(History, KeepLastKeepsThatManySamplesPerKeyInOrder) {
  const auto sender = open_writing();
  const auto receiver = open_reading();
  const auto writer = sender->create_writer(goal_endpoint(latched(3)), {});
  for (int priority = 1; priority <= 10; ++priority) ASSERT_TRUE(writer->write(goal("photo", priority)));
  Inbox inbox;
  const auto reader = receiver->create_reader(goal_endpoint(latched(3)), inbox.reader_events());
  ASSERT_TRUE(inbox.wait_for_samples(3));
  ASSERT_TRUE(writer->write(goal("photo", 11)));
  ASSERT_TRUE(inbox.wait_for_samples(4));
  EXPECT_THAT(inbox.goals(), ElementsAre("photo=8", "photo=9", "photo=10", "photo=11"));
}

TEST_P(History, VolatileReaderSeesNothingOfThePast) {
  const auto sender = open_writing();
  const auto receiver = open_reading();
  Inbox matches;
  const auto writer = sender->create_writer(goal_endpoint(request()), matches.writer_events());
  ASSERT_TRUE(writer->write(goal("old", 1)));
  Inbox inbox;
  const auto reader = receiver->create_reader(goal_endpoint(request()), inbox.reader_events());
  ASSERT_TRUE(matches.wait_for_match());
  ASSERT_TRUE(inbox.wait_for_match());
  ASSERT_TRUE(writer->write(goal("new", 2)));
  ASSERT_TRUE(inbox.wait_for_samples(1));
  EXPECT_THAT(inbox.goals(), ElementsAre("new=2"));
}

TEST_P(History, ReliableSamplesArriveInOrderWithoutGaps) {
  constexpr int kCount = 3000;
  const auto sender = open_writing();
  const auto receiver = open_reading();
  Inbox matches, inbox;
  const auto writer = sender->create_writer(goal_endpoint(request()), matches.writer_events());
  const auto reader = receiver->create_reader(goal_endpoint(request()), inbox.reader_events());
  ASSERT_TRUE(matches.wait_for_match());
  ASSERT_TRUE(inbox.wait_for_match());
  std::vector<std::string> expected;
  for (int i = 0; i < kCount; ++i) {
    const auto sample = goal("goal-" + std::to_string(i % 7), i);
    expected.push_back("goal-" + std::to_string(i % 7) + "=" + std::to_string(i));
    const auto give_up = std::chrono::steady_clock::now() + kDeadline;
    while (!writer->write(sample)) ASSERT_LT(std::chrono::steady_clock::now(), give_up);
  }
  ASSERT_TRUE(inbox.wait_for_samples(kCount));
  EXPECT_EQ(inbox.goals(), expected);
}

TEST_P(History, BestEffortSamplesKeepTheirOrder) {
  const auto sender = open_writing();
  const auto receiver = open_reading();
  Inbox matches, inbox;
  const auto writer = sender->create_writer(goal_endpoint(stream()), matches.writer_events());
  const auto reader = receiver->create_reader(goal_endpoint(stream()), inbox.reader_events());
  ASSERT_TRUE(matches.wait_for_match());
  ASSERT_TRUE(inbox.wait_for_match());
  int sent = 0;
  const auto give_up = std::chrono::steady_clock::now() + kDeadline;
  while (inbox.samples().size() < 20 && std::chrono::steady_clock::now() < give_up) {
    const auto before = inbox.samples().size();
    ASSERT_TRUE(writer->write(goal("stream", ++sent)));
    inbox.wait_until([&] { return inbox.samples().size() > before; }, std::chrono::milliseconds(20));
  }
  ASSERT_GE(inbox.samples().size(), 20U);
  int last = 0;
  for (const auto& sample : inbox.samples()) {
    v1::Goal value;
    ASSERT_TRUE(transport::deserialize(sample.payload, value));
    EXPECT_GT(value.priority(), last);
    last = value.priority();
  }
}

// A goal whose serialized form has that many bytes, or up to 7 more, as its padding has it.
transport::Payload goal_of_size(const std::string& id, std::size_t size) {
  const std::size_t bare = goal(id, 1).size();
  for (std::size_t filling = size - bare;; ++filling)
    if (auto sample = goal(id, 1, "ground", std::string(filling, 'r')); sample.size() >= size) return sample;
}

// Fast DDS packs a history into messages as long as they may be. Samples of these sizes, each with a gap behind it,
// fill one to the last byte; what it adds to it then must find its place. Cyclone DDS would send the largest in two
// fragments each, which ended Fast DDS readers that met them between gaps.
TEST_P(History, LateJoinersRefuseNoDatagramThatIsAsLongAsItMayBe) {
  constexpr std::size_t kInstances = 250;
  const auto sender = open_writing();
  const auto receiver = open_reading();
  for (const std::size_t size : {476, 788, 1528}) {
    for (int round = 0; round < 10; ++round) {
      const auto writer = sender->create_writer(goal_endpoint(latched(1)), {});
      for (std::size_t i = 0; i < kInstances; ++i) {
        ASSERT_TRUE(writer->write(goal_of_size(std::to_string(1000 + i), size)));
        ASSERT_TRUE(writer->write(goal("replaced", 1)));
      }
      Inbox inbox;
      const auto reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
      ASSERT_TRUE(inbox.wait_for_samples(kInstances + 1));
      const auto* guarded = dynamic_cast<const transport::RefusesDatagrams*>(receiver.get());
      if (guarded == nullptr) continue;  // in one process there are none
      ASSERT_THAT(guarded->refused_datagrams(), testing::IsEmpty()) << size << " bytes, round " << round;
    }
  }
}

// Samples that no datagram holds come in fragments, and what was replaced between them as gaps: that ended Fast DDS
// readers of Cyclone DDS writers, or let them turn in a circle.
TEST_P(History, LateJoinersGetLargeSamplesBetweenGaps) {
  constexpr std::size_t kInstances = 60;
  const auto sender = open_writing();
  const auto receiver = open_reading();
  auto endpoint = goal_endpoint(latched(1));
  endpoint.topic = "roci/large";
  for (int round = 0; round < 3; ++round) {
    const auto writer = sender->create_writer(endpoint, {});
    for (std::size_t i = 0; i < kInstances; ++i) {
      ASSERT_TRUE(writer->write(goal_of_size(std::to_string(1000 + i), i % 2 == 0 ? 130'000 : 70'000)));
      ASSERT_TRUE(writer->write(goal("replaced", 1)));
    }
    Inbox inbox;
    const auto reader = receiver->create_reader(endpoint, inbox.reader_events());
    ASSERT_TRUE(inbox.wait_for_samples(kInstances + 1)) << "round " << round;
  }
}

INSTANTIATE_TEST_SUITE_P(Transports, History, kEveryPairing, pairing_name);

}  // namespace
}  // namespace roci::services::contract
