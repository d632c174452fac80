// Whatever bytes come on whichever topic: they are read or refused, no enumerator is one that the IDL does not have,
// and they take no more memory than a small multiple of themselves.
#include "tests/fuzz/topics/decoders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/fuzz/rounds.hpp"
#include "tests/fuzz/topics/allocation_meter.hpp"
#include "tests/fuzz/topics/sample_maker.hpp"

namespace roci::fuzz {
namespace {

using services::node::Decoded;
using services::transport::Payload;

// What services/transport/payload_limit.hpp states: a decoded sample takes at most so many times its bytes. The rest is
// for the value itself and its first allocations.
constexpr std::size_t kFactor = 16;
constexpr std::size_t kBase = 8 * 1024;

class Decoders : public testing::TestWithParam<std::size_t> {
 protected:
  const Decoder& decoder() const { return decoders()[GetParam()]; }

  // Reads the payload as the node and as the vendors do.
  bool reads(const Payload& payload) const {
    const AllocationMeter meter;
    const bool whole = decoder().topic.codec.decode(payload).whole;
    expect_little(meter, payload);
    const services::transport::TypeDescription& type = decoder().topic.codec.type;
    for (const bool key_only : {false, true}) {
      if (!type.keyed) continue;
      const AllocationMeter key_meter;
      Payload key;
      type.serialized_key(payload, key_only, key);
      expect_little(key_meter, payload);
    }
    return whole;
  }

  void expect_little(const AllocationMeter& meter, const Payload& payload) const {
    EXPECT_LE(meter.peak(), kFactor * payload.size() + kBase)
        << decoder().type << " of " << payload.size() << " bytes";
  }

  SampleMaker maker_{GetParam() + 1};
};

TEST(DecodersOfTopics, AreThereForEveryTopicTypeOfTheIdl) {
  std::vector<std::string> types;
  for (const Decoder& decoder : decoders()) types.push_back(decoder.type);
  EXPECT_THAT(types, testing::UnorderedElementsAreArray(topic_types()))
      << "give each topic of services/topics/topics.hpp its decoder in tests/fuzz/topics/decoders.cpp";
}

TEST_P(Decoders, ReadWhatIsWhole) {
  for (int i = 0; i < 20; ++i) {
    const MadeSample sample = maker_.make(decoder().type, 20);
    ASSERT_TRUE(reads(sample.payload)) << decoder().type;
    const Decoded decoded = decoder().topic.codec.decode(sample.payload);
    EXPECT_EQ(decoder().encode(decoded.value.get()), sample.payload) << decoder().type;
  }
}

// The payload is as long as whoever lies can make it: a count is believed only as far as there
// are bytes for its elements.
TEST_P(Decoders, LiesAboutCountsTakeNoMemory) {
  for (const std::size_t padding : {std::size_t{0}, std::size_t{256} << 10}) {
    const MadeSample sample = maker_.make(decoder().type, 2);
    for (const Mark& mark : sample.marks) {
      if (mark.kind != Mark::Kind::count && mark.kind != Mark::Kind::text_length) continue;
      Payload payload = sample.payload;
      payload.resize(payload.size() + padding);
      const auto left = static_cast<std::uint32_t>(payload.size() - mark.offset - 4);
      for (const std::uint32_t lie : {left, left / mark.least, left / mark.least + 1, left / 2,
                                      std::uint32_t{0x7fffffff}, std::uint32_t{0xffffffff}}) {
        put(payload, mark.offset, lie);
        reads(payload);
        if (HasFailure()) FAIL() << "a count of " << lie << " at " << mark.offset;
      }
    }
  }
}

TEST_P(Decoders, AllCountsLieAtOnce) {
  for (const std::uint32_t lie : {1u, 1000u, 100'000u, 0x7fffffffu, 0xffffffffu}) {
    MadeSample sample = maker_.make(decoder().type, 3);
    for (const Mark& mark : sample.marks)
      if (mark.kind == Mark::Kind::count) put(sample.payload, mark.offset, lie);
    sample.payload.resize(sample.payload.size() + (std::size_t{256} << 10));
    reads(sample.payload);
  }
}

TEST_P(Decoders, WhatIsCutAnywhereIsRefused) {
  const MadeSample sample = maker_.make(decoder().type, 2);
  for (std::size_t size = 0; size < sample.payload.size(); ++size)
    EXPECT_FALSE(
        reads(Payload(sample.payload.begin(), sample.payload.begin() + static_cast<std::ptrdiff_t>(size))))
        << decoder().type << " cut to " << size << " of " << sample.payload.size() << " bytes";
}

TEST_P(Decoders, AnEnumeratorThatTheIdlDoesNotHaveIsRefused) {
  const MadeSample sample = maker_.make(decoder().type, 2);
  for (const Mark& mark : sample.marks) {
    if (mark.kind != Mark::Kind::enumerator) continue;
    for (const std::uint32_t number : {mark.least, std::uint32_t{77}, std::uint32_t{0xffffffff}}) {
      Payload payload = sample.payload;
      put(payload, mark.offset, number);
      EXPECT_FALSE(reads(payload)) << decoder().type << " with " << number << " at " << mark.offset;
    }
    Payload payload = sample.payload;
    put(payload, mark.offset, mark.least - 1);
    EXPECT_TRUE(reads(payload)) << decoder().type << ", the last one at " << mark.offset;
  }
}

TEST_P(Decoders, TextWithAZeroByteIsRefused) {
  const MadeSample sample = maker_.make(decoder().type, 2);
  for (const Mark& mark : sample.marks) {
    if (mark.kind != Mark::Kind::text || mark.least < 2) continue;
    Payload payload = sample.payload;
    payload[mark.offset] = 0;
    EXPECT_FALSE(reads(payload)) << decoder().type << " at " << mark.offset;
  }
}

TEST_P(Decoders, NothingElseComesOfMutants) {
  MadeSample sample;
  for (int i = 0; i < rounds(1000); ++i) {
    if (i % 50 == 0) sample = maker_.make(decoder().type, 4);
    const Payload payload = maker_.damaged(sample);
    reads(payload);
    if (HasFailure()) FAIL() << "round " << i;
  }
}

std::vector<std::size_t> every_decoder() {
  std::vector<std::size_t> all(decoders().size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

INSTANTIATE_TEST_SUITE_P(Topics, Decoders, testing::ValuesIn(every_decoder()),
                         [](const auto& test) { return decoders()[test.param].type; });

}  // namespace
}  // namespace roci::fuzz
