#include "services/transport/type_support.hpp"

#include <gtest/gtest.h>

#include <random>

#include "roci_idl/command.h"
#include "roci_idl/function.h"
#include "roci_idl/goal.h"
#include "roci_idl/planner.h"

namespace roci::services {
namespace {

using Random = std::mt19937_64;

int below(Random& random, int bound) { return static_cast<int>(random() % static_cast<unsigned>(bound)); }

std::string text(Random& random) {
  std::string result(static_cast<std::size_t>(below(random, 40)), ' ');
  for (auto& c : result) c = static_cast<char>('a' + below(random, 26));
  return result;
}

v1::Command random_command(Random& random) {
  v1::Command command;
  command.commander(text(random));
  command.epoch(random());
  command.activity(text(random));
  command.attempt(static_cast<std::uint32_t>(random()));
  command.header().sender(text(random));
  command.header().seq(random());
  command.subsystem(text(random));
  command.expected_us(static_cast<std::int64_t>(random()));
  command.arguments().resize(static_cast<std::size_t>(below(random, 5)));
  for (auto& argument : command.arguments()) argument.name(text(random)), argument.value(text(random));
  return command;
}

v1::FunctionReply random_reply(Random& random) {
  v1::FunctionReply reply;
  reply.owner(text(random));
  reply.results().resize(1 + static_cast<std::size_t>(below(random, 3)));
  for (auto& result : reply.results()) {
    result.function(text(random));
    result.numbers().assign(static_cast<std::size_t>(below(random, 6)), 1.5);
    result.outcomes().assign(result.numbers().size(), v1::FUNCTION_UNREACHABLE);
  }
  return reply;
}

v1::PlanReply random_plan(Random& random) {
  v1::PlanReply reply;
  reply.reason(text(random));
  reply.solution().activities().resize(static_cast<std::size_t>(below(random, 4)));
  for (auto& activity : reply.solution().activities()) {
    activity.name(text(random));
    activity.pre().nodes().resize(static_cast<std::size_t>(below(random, 3)));
    activity.goals_served().push_back(text(random));
  }
  return reply;
}

// The key as RTPS hashes it, written by hand: string length with its zero, string,
// alignment to a number's own size, number.
transport::Payload expected_key(const v1::Command& command) {
  transport::Payload key;
  const auto number = [&key](std::uint32_t value) {
    key.resize((key.size() + 3) / 4 * 4);
    for (int shift = 24; shift >= 0; shift -= 8) key.push_back(static_cast<std::uint8_t>(value >> shift));
  };
  const auto string = [&](const std::string& text) {
    number(static_cast<std::uint32_t>(text.size() + 1));
    key.insert(key.end(), text.begin(), text.end());
    key.push_back(0);
  };
  string(command.commander());
  key.resize((key.size() + 7) / 8 * 8);
  number(static_cast<std::uint32_t>(command.epoch() >> 32));
  number(static_cast<std::uint32_t>(command.epoch()));
  string(command.activity());
  number(command.attempt());
  return key;
}

template <class T>
transport::Payload big_endian(const T& value) {
  transport::Payload payload(4 + T::getCdrSerializedSize(value));
  eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload.data()), payload.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::BIG_ENDIANNESS, eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  value.serialize(cdr);
  return payload;
}

TEST(TypeSupport, ValuesComeBackFromBothByteOrders) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const auto command = random_command(random);
    v1::Command little, big;
    ASSERT_TRUE(transport::deserialize(transport::serialize(command), little));
    ASSERT_TRUE(transport::deserialize(big_endian(command), big));
    EXPECT_TRUE(little == command);
    EXPECT_TRUE(big == command);
  }
}

TEST(TypeSupport, EqualValuesGiveEqualBytes) {
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const auto command = random_command(random);
    const v1::Command copy = command;
    EXPECT_EQ(transport::serialize(command), transport::serialize(copy));
    EXPECT_EQ(transport::serialize(command).size(), 4 + v1::Command::getCdrSerializedSize(command));
  }
}

TEST(TypeSupport, KeysAreBigEndianWhateverTheSampleIs) {
  Random random(3);
  const auto type = transport::describe_type<v1::Command>("roci::v1::Command");
  ASSERT_TRUE(type.keyed);
  EXPECT_FALSE(type.key_fits_hash);
  for (int i = 0; i < 500; ++i) {
    const auto command = random_command(random);
    const auto expected = expected_key(command);
    for (const auto& payload : {transport::serialize(command), big_endian(command)}) {
      transport::Payload key;
      ASSERT_TRUE(type.serialized_key(payload, false, key));
      EXPECT_EQ(key, expected);
    }
  }
}

TEST(TypeSupport, AKeyOnlyPayloadGivesTheKeyMembers) {
  Random random(4);
  const auto type = transport::describe_type<v1::Command>("roci::v1::Command");
  for (int i = 0; i < 500; ++i) {
    const auto command = random_command(random);
    const auto expected = expected_key(command);
    transport::Payload payload(4), key;
    payload.insert(payload.end(), expected.begin(), expected.end());
    EXPECT_FALSE(type.serialized_key(payload, false, key)) << "it is no whole sample";
    ASSERT_TRUE(type.serialized_key(payload, true, key));
    EXPECT_EQ(key, expected);
    v1::Command read;
    ASSERT_TRUE(transport::deserialize_key(payload, read));
    EXPECT_EQ(read.commander(), command.commander());
    EXPECT_EQ(read.epoch(), command.epoch());
    EXPECT_EQ(read.activity(), command.activity());
    EXPECT_EQ(read.attempt(), command.attempt());
    for (std::size_t size = 0; size < payload.size(); ++size) {
      EXPECT_FALSE(transport::deserialize_key(std::span(payload).first(size), read))
          << size << " of " << payload.size();
    }
  }
}

TEST(TypeSupport, TypesWithoutKeyHaveNone) {
  const auto type = transport::describe_type<v1::PlanRequest>("roci::v1::PlanRequest");
  EXPECT_FALSE(type.keyed);
  EXPECT_EQ(type.serialized_key, nullptr);
}

TEST(TypeSupport, TruncatedSamplesAreRefused) {
  Random random(5);
  const auto payload = transport::serialize(random_command(random));
  for (std::size_t size = 0; size < payload.size(); ++size) {
    v1::Command value;
    EXPECT_FALSE(transport::deserialize(std::span(payload).first(size), value))
        << size << " of " << payload.size();
  }
}

template <class T, class Make>
void survive_mutations(Make make, int count) {
  Random random(6);
  for (int i = 0; i < count; ++i) {
    auto payload = transport::serialize(make(random));
    for (int flips = 1 + below(random, 4); flips > 0; --flips) {
      auto& byte = payload[random() % payload.size()];
      byte = random() % 2 ? 0xFF : static_cast<std::uint8_t>(random());
    }
    if (random() % 4 == 0) payload.resize(random() % payload.size());
    T value;
    if (transport::deserialize(payload, value)) {
      T again;
      EXPECT_TRUE(transport::deserialize(transport::serialize(value), again));
    }
  }
}

TEST(TypeSupport, MutatedSamplesNeverCrash) {
  survive_mutations<v1::Command>(random_command, 10000);
  survive_mutations<v1::FunctionReply>(random_reply, 10000);
  survive_mutations<v1::PlanReply>(random_plan, 10000);
}

// fastddsgen would reserve 16 GB here.
TEST(TypeSupport, ALengthThatTheSampleCannotHoldIsRefusedBeforeMemoryIsTaken) {
  v1::FunctionReply reply;
  reply.results().resize(1);
  reply.results()[0].outcomes({v1::FUNCTION_VALUE});
  auto payload = transport::serialize(reply);
  std::fill_n(payload.end() - 8, 4, std::uint8_t{0xFF});
  EXPECT_FALSE(transport::deserialize(payload, reply));
  EXPECT_LT(reply.results()[0].outcomes().capacity(), 1000U);
}

}  // namespace
}  // namespace roci::services
