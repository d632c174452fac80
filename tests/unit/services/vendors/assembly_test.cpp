// Samples in fragments become whole ones, whatever order the fragments come in.
#include "services/vendors/guard/assembly.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/contract/hostile/rtps_message.hpp"

namespace roci::services::vendors::guard {
namespace {

using contract::hostile::Bytes;
using contract::hostile::kData;
using contract::hostile::kEclipse;
using contract::hostile::kEprosima;
using contract::hostile::Message;
using contract::hostile::Prefix;

constexpr std::uint16_t kOwnVendor = 0x010f;  // eProsima's
constexpr Prefix kFragmentSender{1, 16, 2};
constexpr std::uint32_t kFragmentWriter = 0x00000102, kFragmentReader = 0x00000107;

class AssemblyTest : public ::testing::Test {
 protected:
  Bytes payload(std::size_t size) {
    Bytes out{0, 1, 0, 0};
    while (out.size() < size) out.push_back(static_cast<std::uint8_t>(random_()));
    return out;
  }
  // Fragments `first` to `first + count - 1`, counted from 1, of this size.
  static Message fragments(std::int64_t number, const Bytes& sample, std::uint32_t first, std::uint16_t count,
                           std::uint16_t size) {
    const std::size_t from = (first - 1) * std::size_t{size};
    const std::size_t to = std::min(sample.size(), from + std::size_t{count} * size);
    const Bytes part(sample.begin() + static_cast<std::ptrdiff_t>(from),
                     sample.begin() + static_cast<std::ptrdiff_t>(to));
    return Message(kFragmentSender, kEclipse)
        .fragment(kFragmentReader, kFragmentWriter, number, first, count, size,
                  static_cast<std::uint32_t>(sample.size()), part);
  }
  // Returns what is left of the message.
  std::size_t take(const Message& message) {
    Bytes bytes = message.bytes();
    EXPECT_EQ(examine(bytes), DatagramAdmission::pass);
    return assembly_.take(bytes, kOwnVendor, whole_);
  }
  static Bytes whole(std::int64_t number, const Bytes& sample) {
    Bytes out = Message(kFragmentSender, kEclipse)
                    .data(kFragmentReader, kFragmentWriter, number, kData, {}, sample)
                    .bytes();
    out[22] = out[23] = 0;  // its length: to the end
    return out;
  }

  std::mt19937 random_{1};
  Assembly assembly_;
  std::vector<Bytes> whole_;
};

TEST_F(AssemblyTest, FragmentsInAnyOrderAndTwiceAreOneSample) {
  for (int round = 0; round < 200; ++round) {
    const auto size = static_cast<std::uint16_t>(8 + random_() % 2000);
    const Bytes sample = payload(4 * (2 + random_() % 5000));  // messages of the test are padded
    const auto last = static_cast<std::uint32_t>((sample.size() + size - 1) / size);
    std::vector<std::uint32_t> order;
    for (std::uint32_t one = 1; one <= last; ++one) order.insert(order.end(), 1 + random_() % 2, one);
    std::ranges::shuffle(order, random_);
    whole_.clear();
    for (const std::uint32_t one : order) {
      const std::uint32_t together = 1 + static_cast<std::uint32_t>(random_() % 3);
      const auto count = static_cast<std::uint16_t>(std::min(last - one + 1, together));
      EXPECT_EQ(take(fragments(round + 1, sample, one, count, size)), 0U) << "nothing else is said";
      if (!whole_.empty()) break;
    }
    ASSERT_EQ(whole_.size(), 1U) << "round " << round;
    EXPECT_EQ(whole_[0], whole(round + 1, sample));
    EXPECT_EQ(examine(whole_[0]), DatagramAdmission::pass);
    EXPECT_EQ(assembly_.kept_bytes(), 0U);
  }
}

TEST_F(AssemblyTest, WhatElseTheMessageSaysStays) {
  const Bytes sample = payload(100);
  Message message = fragments(1, sample, 1, 1, 64);
  message.heartbeat(0, kFragmentWriter, 1, 1, 1);
  EXPECT_EQ(take(message), Message(kFragmentSender, kEclipse).heartbeat(0, kFragmentWriter, 1, 1, 1).bytes().size());
  Bytes own = Message(kFragmentSender, kEprosima).fragment(0, kFragmentWriter, 1, 1, 1, 64, 100, Bytes(64)).bytes();
  EXPECT_EQ(assembly_.take(own, kOwnVendor, whole_), own.size()) << "the vendor's own";
  EXPECT_TRUE(whole_.empty());
}

TEST_F(AssemblyTest, TakesNoMoreThanItsBounds) {
  const Bytes part(64);
  for (std::int64_t number = 1; number < 2000; ++number) {
    take(Message(kFragmentSender, kEclipse).fragment(0, kFragmentWriter, number, 2, 1, 64, kMaxSampleBytes, part));
    ASSERT_LE(assembly_.kept_bytes(), Assembly::kMostBytes);
  }
  for (std::int64_t number = 1; number < 2000; ++number) {
    take(Message(kFragmentSender, kEclipse).fragment(0, kFragmentWriter, number, 2, 1, 64, 128, part));
    ASSERT_LE(assembly_.kept_bytes(), Assembly::kMostBytes);
  }
  EXPECT_EQ(assembly_.kept_bytes(), Assembly::kMostSamples * 128);
}

TEST_F(AssemblyTest, WhatIsMissingIsAskedForBehindAnAcknowledgement) {
  const Bytes sample = payload(64 * 40);
  for (const std::uint32_t one : {1, 2, 4, 40}) take(fragments(7, sample, one, 1, 64));
  const auto sent = [&](std::uint32_t writer, const Prefix& of) {
    Bytes destination(of.begin(), of.end());
    Bytes message = Message(Prefix{1, 15, 1}, kEprosima)
                        .submessage(0x0e, 1, destination)
                        .acknack(kFragmentReader, writer, 1, 40)
                        .bytes();
    std::fill_n(message.end() - 12, 8, 0xff);  // all 40 are asked for
    return assembly_.with_requests(message);
  };
  EXPECT_TRUE(sent(kFragmentWriter + 0x100, kFragmentSender).empty()) << "another writer";
  EXPECT_TRUE(sent(kFragmentWriter, Prefix{9}).empty()) << "another participant";
  const Bytes asked = sent(kFragmentWriter, kFragmentSender);
  ASSERT_EQ(examine(asked), DatagramAdmission::pass);
  int seen = 0;
  for_each_submessage(asked, [&](const Submessage& one) {
    if (one.id == 0x06) {
      EXPECT_EQ(one.body.u32(20), 0xfdffffffU) << "the sample, number 7, is not asked for as a whole";
      EXPECT_EQ(one.body.u32(24), 0xffffffffU);
    }
    if (one.id != 0x12) return;
    ++seen;
    EXPECT_EQ(one.body.sequence_number(8), 7);
    EXPECT_EQ(one.body.u32(16), 3U) << "the first that is missing";
    EXPECT_EQ(one.body.u32(20), 38U);
    EXPECT_EQ(one.body.u32(24), 0xbfffffffU) << "but for the fourth";
    EXPECT_EQ(one.body.u32(28), 0xf8000000U) << "34 to 39, and not 40: bits 32 to 36";
  });
  EXPECT_EQ(seen, 1);
}

}  // namespace
}  // namespace roci::services::vendors::guard
