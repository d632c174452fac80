// Who hears whom: types, domains, partitions, restarts, large samples, and the identity of writers.
#include <gmock/gmock.h>

#include "roci_idl/command.h"
#include "roci_idl/motion.h"
#include "services/transport/scope.hpp"
#include "tests/contract/support/inbox.hpp"
#include "tests/contract/support/pairing.hpp"
#include "tests/contract/support/profiles.hpp"

namespace roci::services::contract {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

class Isolation : public PairingTest {};

TEST_P(Isolation, AForeignTypeOnAKnownTopicDoesNotMatch) {
  const auto foreign = open_writing();
  const auto sender = open_writing();
  const auto receiver = open_reading();
  Inbox inbox, marker, goal_matches;
  const auto reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
  const auto marker_description = endpoint<v1::Goal>("marker", "roci::v1::Goal", latched(1));
  const auto marker_reader = receiver->create_reader(marker_description, marker.reader_events());

  const auto impostor =
      foreign->create_writer(endpoint<v1::Hazard>("roci/goal", "roci::v1::Hazard", latched(1)), {});
  v1::Hazard hazard;
  hazard.id("rock");
  ASSERT_TRUE(impostor->write(transport::serialize(hazard)));
  // Discovery is in order: when the marker of the same participant is matched, the impostor was seen too.
  const auto marker_writer = foreign->create_writer(marker_description, {});
  ASSERT_TRUE(marker_writer->write(goal("marker", 1)));
  ASSERT_TRUE(marker.wait_for_samples(1));

  const auto writer = sender->create_writer(goal_endpoint(latched(1)), {});
  ASSERT_TRUE(writer->write(goal("photo", 1)));
  ASSERT_TRUE(inbox.wait_for_samples(1));
  ASSERT_TRUE(inbox.wait_for_match(1));  // told apart from samples, in any order
  EXPECT_EQ(inbox.matched(), 1);
  EXPECT_EQ(impostor->matched_readers(), 0);
  EXPECT_THAT(inbox.goals(), ElementsAre("photo=1"));
}

TEST_P(Isolation, TwoDomainsDoNotHearEachOther) {
  const process::DomainClaim second;
  const auto sender_1 = open_writing(), sender_2 = open_writing({.domain = second.id()});
  const auto receiver_1 = open_reading(), receiver_2 = open_reading({.domain = second.id()});
  Inbox inbox_1, inbox_2;
  const auto writer_1 = sender_1->create_writer(goal_endpoint(latched(1)), {});
  const auto writer_2 = sender_2->create_writer(goal_endpoint(latched(1)), {});
  ASSERT_TRUE(writer_1->write(goal("one", 1)));
  ASSERT_TRUE(writer_2->write(goal("two", 2)));
  const auto reader_1 = receiver_1->create_reader(goal_endpoint(latched(1)), inbox_1.reader_events());
  const auto reader_2 = receiver_2->create_reader(goal_endpoint(latched(1)), inbox_2.reader_events());
  ASSERT_TRUE(inbox_1.wait_for_samples(1));
  ASSERT_TRUE(inbox_2.wait_for_samples(1));
  EXPECT_THAT(inbox_1.goals(), ElementsAre("one=1"));
  EXPECT_THAT(inbox_2.goals(), ElementsAre("two=2"));
  EXPECT_EQ(inbox_1.matched(), 1);
  EXPECT_EQ(inbox_2.matched(), 1);
}

TEST_P(Isolation, TwoPartitionsDoNotHearEachOther) {
  const auto in = [](const std::string& partition) {
    auto description = goal_endpoint(latched(1));
    description.partitions = {partition};
    return description;
  };
  const auto sender_a = open_writing(), sender_b = open_writing();
  const auto receiver = open_reading();
  const auto writer_a = sender_a->create_writer(in("a"), {});
  const auto writer_b = sender_b->create_writer(in("b"), {});
  ASSERT_TRUE(writer_a->write(goal("a", 1)));
  ASSERT_TRUE(writer_b->write(goal("b", 2)));
  Inbox inbox;
  const auto reader = receiver->create_reader(in("b"), inbox.reader_events());
  ASSERT_TRUE(inbox.wait_for_samples(1));
  EXPECT_THAT(inbox.goals(), ElementsAre("b=2"));
  EXPECT_EQ(inbox.matched(), 1);
}

std::string name_of_scope(const transport::EndpointDescription& endpoint) {
  std::string text;
  for (const std::string& partition : endpoint.partitions) text += (text.empty() ? "" : ",") + partition;
  return text.empty() ? "none" : text;
}

// Every pair of partitions that topics have: the writer's sample arrives exactly where it is meant to.
TEST_P(Isolation, PartitionsFollowFromScopeAndRobot) {
  const auto endpoint_of = [](transport::Scope scope, const std::string& robot) {
    auto description = goal_endpoint(latched(1));
    description.partitions = transport::partitions_of(scope, robot);
    return description;
  };
  const std::vector<transport::EndpointDescription> kinds{
      endpoint_of(transport::Scope::everyone, "a"), endpoint_of(transport::Scope::team, "a"),
      endpoint_of(transport::Scope::robot, ""), endpoint_of(transport::Scope::robot, "a"),
      endpoint_of(transport::Scope::robot, "b")};
  const std::vector<std::vector<std::string>> heard_by{
      {"0=1"}, {"1=1"}, {"2=1", "3=1", "4=1"}, {"2=1", "3=1"}, {"2=1", "4=1"}};
  const auto sender = open_writing();
  std::vector<std::unique_ptr<transport::Writer>> writers;
  for (const auto& kind : kinds) {
    writers.push_back(sender->create_writer(kind, {}));
    ASSERT_TRUE(writers.back()->write(goal(std::to_string(writers.size() - 1), 1)));
  }
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    Inbox inbox;
    const auto receiver = open_reading();
    const auto reader = receiver->create_reader(kinds[i], inbox.reader_events());
    EXPECT_TRUE(inbox.wait_for_samples(heard_by[i].size())) << name_of_scope(kinds[i]);
    EXPECT_TRUE(inbox.wait_for_match(static_cast<int>(heard_by[i].size()))) << name_of_scope(kinds[i]);
    EXPECT_THAT(inbox.goals(), testing::UnorderedElementsAreArray(heard_by[i])) << name_of_scope(kinds[i]);
  }
}

TEST_P(Isolation, ATwoMegabyteSampleArrivesWhole) {
  const auto sender = open_writing();
  const auto receiver = open_reading();
  const auto description = endpoint<v1::DataProduct>("roci/product", "roci::v1::DataProduct", latched(1));
  const auto writer = sender->create_writer(description, {});
  v1::DataProduct product;
  product.id("panorama");
  product.preview().resize(2 * 1024 * 1024);
  for (std::size_t i = 0; i < product.preview().size(); ++i) {
    product.preview()[i] = static_cast<std::uint8_t>((i * 2654435761U) >> 24);
  }
  ASSERT_TRUE(writer->write(transport::serialize(product)));
  Inbox inbox;
  const auto reader = receiver->create_reader(description, inbox.reader_events());
  ASSERT_TRUE(inbox.wait_for_samples(1));
  v1::DataProduct received;
  ASSERT_TRUE(transport::deserialize(inbox.samples()[0].payload, received));
  EXPECT_TRUE(received == product);
}

TEST_P(Isolation, SamplesNameTheirWriter) {
  const auto sender = open_writing();
  const auto receiver = open_reading();
  const auto first = sender->create_writer(goal_endpoint(latched(1)), {});
  const auto second = sender->create_writer(goal_endpoint(latched(1)), {});
  EXPECT_NE(first->guid(), second->guid());
  ASSERT_TRUE(first->write(goal("photo", 1)));
  ASSERT_TRUE(second->write(goal("sample", 1)));
  Inbox inbox;
  const auto reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
  ASSERT_TRUE(inbox.wait_for_samples(2));
  std::vector<transport::Guid> writers;
  for (const auto& sample : inbox.samples()) writers.push_back(sample.writer);
  EXPECT_THAT(writers, UnorderedElementsAre(first->guid(), second->guid()));
}

TEST_P(Isolation, EitherSideMayRestart) {
  auto sender = open_writing();
  auto receiver = open_reading();
  Inbox inbox, matches;
  auto writer = sender->create_writer(goal_endpoint(latched(1)), matches.writer_events());
  auto reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
  ASSERT_TRUE(writer->write(goal("photo", 1)));
  ASSERT_TRUE(inbox.wait_for_samples(1));

  writer.reset();
  sender.reset();
  ASSERT_TRUE(inbox.wait_for_match(0));
  sender = open_writing();
  writer = sender->create_writer(goal_endpoint(latched(1)), matches.writer_events());
  ASSERT_TRUE(writer->write(goal("photo", 2)));
  ASSERT_TRUE(inbox.wait_until([&inbox] { return inbox.goals().size() == 2; }));
  EXPECT_EQ(reader->matched_writers(), 1);

  reader.reset();
  receiver.reset();
  ASSERT_TRUE(matches.wait_for_match(0));
  receiver = open_reading();
  reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
  ASSERT_TRUE(inbox.wait_until([&inbox] { return inbox.goals().size() == 3; }));
  ASSERT_TRUE(matches.wait_for_match(1));
  EXPECT_THAT(inbox.goals(), ElementsAre("photo=1", "photo=2", "photo=2"));
}

TEST_P(Isolation, FortyParticipantsFindEachOtherAndSoDoTheNext) {
  constexpr int kCount = 40;
  for (int round = 0; round < 2; ++round) {
    Inbox inbox;
    const auto receiver = open_reading();
    const auto reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
    std::vector<std::unique_ptr<transport::Transport>> senders;
    std::vector<std::unique_ptr<transport::Writer>> writers;
    for (int i = 1; i < kCount; ++i) {
      senders.push_back(open_writing());
      writers.push_back(senders.back()->create_writer(goal_endpoint(latched(1)), {}));
      ASSERT_TRUE(writers.back()->write(goal("goal-" + std::to_string(i), i)));
    }
    EXPECT_TRUE(inbox.wait_for_samples(kCount - 1)) << "round " << round << ": " << inbox.samples().size();
    writers.clear();
  }
}

TEST_P(Isolation, OneTopicHasOneTypeInAParticipant) {
  const auto transport = open_writing();
  const auto writer = transport->create_writer(goal_endpoint(latched(1)), {});
  const auto foreign = endpoint<v1::Hazard>("roci/goal", "roci::v1::Hazard", latched(1));
  EXPECT_THROW(transport->create_writer(foreign, {}), transport::TransportError);
}

INSTANTIATE_TEST_SUITE_P(Transports, Isolation, kEveryPairing, pairing_name);

}  // namespace
}  // namespace roci::services::contract
