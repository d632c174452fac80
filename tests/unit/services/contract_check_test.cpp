#include "services/node/contract_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "services/bounds/limits.hpp"
#include "services/node/contract_gate.hpp"

namespace roci::services::node {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Agreement = ContractCheck::Agreement;

constexpr char kOwn[] = "roci;build=1;Goal=aaaaaaaa;Event=bbbbbbbb";
const ContractTopic kGoal{"roci/goal", "roci::v1::Goal"};
const ContractTopic kEvent{"roci/event", "roci::v1::Event"};

transport::Guid guid(std::uint8_t participant, std::uint8_t endpoint = 1) {
  transport::Guid guid{};
  guid[0] = participant;
  guid[15] = endpoint;
  return guid;
}

class ContractCheckTest : public testing::Test {
 protected:
  std::map<std::uint8_t, transport::Participant> known{
      {1, {"right", kOwn}},
      {2, {"changed", "roci;build=2;Goal=cccccccc;Event=bbbbbbbb"}},
      {3, {"", ""}},
      {4, {"tool", "enclave=/;"}},
      {5, {"older", "roci;build=0;Event=bbbbbbbb"}}};
  int lookups = 0;
  ContractCheck check{kOwn, [this](const transport::Guid& guid) {
                        ++lookups;
                        const auto found = known.find(guid[0]);
                        return found == known.end() ? std::nullopt : std::optional(found->second);
                      }};
};

TEST_F(ContractCheckTest, JudgesTypeByType) {
  EXPECT_EQ(check.judge(kGoal, guid(1)), Agreement::same);
  EXPECT_EQ(check.judge(kGoal, guid(2)), Agreement::different);
  EXPECT_EQ(check.judge(kEvent, guid(2)), Agreement::same) << "this type is the same there";
  EXPECT_EQ(check.judge(kGoal, guid(3)), Agreement::different);
  EXPECT_EQ(check.judge(kGoal, guid(4)), Agreement::different);
  EXPECT_EQ(check.judge(kGoal, guid(5)), Agreement::different) << "it does not know this type";
  EXPECT_EQ(check.judge({"roci/attic", "roci::v1::Attic"}, guid(1)), Agreement::different) << "nor do we";
}

TEST_F(ContractCheckTest, AsksOncePerParticipant) {
  for (std::uint8_t endpoint = 1; endpoint < 10; ++endpoint) {
    check.judge(kGoal, guid(1, endpoint));
    check.judge(kEvent, guid(2, endpoint));
  }
  EXPECT_EQ(lookups, 2);
}

TEST_F(ContractCheckTest, TellsOncePerParticipantAndTopicWithBothBuildsAndHashes) {
  for (int i = 0; i < 3; ++i) check.judge(kGoal, guid(2));
  check.met(kGoal, guid(2, 7));
  check.met(kGoal, guid(1));
  const auto mismatches = check.take_mismatches();
  ASSERT_EQ(mismatches.size(), 1U);
  const std::string text = to_text(mismatches.front());
  for (const char* part : {"changed", "build 2", "build 1", "roci/goal", "cccccccc", "aaaaaaaa", "idl/"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_THAT(check.take_mismatches(), IsEmpty());
  check.met(kEvent, guid(3));
  EXPECT_EQ(check.take_mismatches().size(), 1U) << "told though no sample ever came";
}

TEST_F(ContractCheckTest, WhoWasMetBeforeItIsKnownIsJudgedLater) {
  check.met(kGoal, guid(9));
  EXPECT_THAT(check.take_mismatches(), IsEmpty());
  EXPECT_EQ(check.judge(kGoal, guid(9)), Agreement::unknown);
  known[9] = {"late", "roci;build=3"};
  EXPECT_EQ(check.take_mismatches().size(), 1U);
}

class ContractGateTest : public ContractCheckTest {
 protected:
  ContractGateTest() { reader.contract = kGoal; }
  void arrive(std::uint8_t participant, std::uint8_t number) {
    gate.arrive({&reader, {transport::SampleKind::data, {participant, number}, guid(participant)}});
  }
  TopicReader reader;
  std::vector<std::string> passed;
  std::vector<std::string> told;
  bool prepared = false;
  ContractGate gate{check,
                    [this](Arrival&& arrival) {
                      passed.push_back(std::to_string(arrival.sample.payload[0]) + "." +
                                       std::to_string(arrival.sample.payload[1]));
                    },
                    [this] { prepared = true; },
                    [this](const v1::Event& event) { told.push_back(event.code()); }};
};

TEST_F(ContractGateTest, RefusesAndCounts) {
  arrive(1, 1);
  arrive(2, 1);
  arrive(3, 1);
  arrive(1, 2);
  EXPECT_THAT(passed, ElementsAre("1.1", "1.2"));
  EXPECT_EQ(gate.refused(), 2U);
}

TEST_F(ContractGateTest, HoldsBackInOrderUntilTheParticipantIsKnown) {
  arrive(8, 1);
  arrive(1, 1);
  arrive(8, 2);
  EXPECT_THAT(passed, ElementsAre("1.1"));
  known[8] = {"late", kOwn};
  arrive(8, 3);
  EXPECT_THAT(passed, ElementsAre("1.1", "8.1", "8.2", "8.3"));
  arrive(9, 1);
  known[9] = {"later", kOwn};
  gate.turn(clock::WallTime{});
  EXPECT_EQ(passed.back(), "9.1") << "without any further sample";
  EXPECT_EQ(gate.refused(), 0U);
}

TEST_F(ContractGateTest, HoldsBackNoMoreThanItsBound) {
  for (std::size_t i = 0; i < ContractGate::kHeldBack + 5; ++i) arrive(8, 1);
  EXPECT_EQ(gate.refused(), 5U);
}

TEST_F(ContractGateTest, HoldsBackNoMoreBytesThanItsBound) {
  constexpr std::size_t kSize = std::size_t{1} << 20;
  constexpr std::size_t kRoom = bounds::kHeldBytes / kSize;
  for (std::uint8_t i = 0; i < kRoom + 6; ++i) {
    transport::Payload payload(kSize);
    payload[0] = 8;
    payload[1] = i;
    gate.arrive({&reader, {transport::SampleKind::data, std::move(payload), guid(8)}});
  }
  EXPECT_EQ(gate.refused(), 6U);
  known[8] = {"late", kOwn};
  gate.turn(clock::WallTime{});
  ASSERT_EQ(passed.size(), kRoom);
  EXPECT_EQ(passed.front(), "8.6") << "the oldest went";
}

TEST_F(ContractGateTest, TellsWhenReadersOfEventsHadTimeToFindIt) {
  const clock::WallTime start{};
  arrive(2, 1);
  gate.turn(start);
  EXPECT_TRUE(prepared);
  EXPECT_THAT(told, IsEmpty());
  gate.turn(start + clock::wall_seconds(ContractGate::kTellAfterS));
  EXPECT_THAT(told, ElementsAre("contract.mismatch"));
  gate.turn(start + clock::wall_seconds(10));
  EXPECT_EQ(told.size(), 1U);
}

}  // namespace
}  // namespace roci::services::node
