#include "services/vendors/guard/ahead.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/contract/hostile/rtps_message.hpp"

namespace roci::services::vendors::guard {
namespace {

using contract::hostile::Bytes;
using contract::hostile::kData;
using contract::hostile::kEprosima;
using contract::hostile::Message;
using contract::hostile::Prefix;

constexpr Prefix kOurs{1, 15, 1}, kFirst{1, 15, 2}, kSecond{1, 15, 3};
constexpr std::uint32_t kOfWriter = 0x00000102, kOfReader = 0x00000107, kOfSecondReader = 0x00000207;

class Ahead : public testing::Test {
 protected:
  bool take(Message message) {
    Bytes bytes = message.bytes();
    std::size_t refused = 0;
    EXPECT_EQ(examine(bytes), DatagramAdmission::pass);
    const std::size_t left = samples_.take(bytes, refused);
    EXPECT_EQ(left, refused > 0 ? 0U : bytes.size());
    return refused == 0;
  }
  bool data(const Prefix& sender, std::int64_t number, std::size_t size = 1000, std::uint32_t reader = 0) {
    return take(Message(sender, kEprosima).data(reader, kOfWriter, number, kData, {}, Bytes(size)));
  }
  void acknowledge(const Prefix& to, std::int64_t next, std::uint32_t reader = kOfReader) {
    const Bytes destination(to.begin(), to.end());
    samples_.acknowledge(Message(kOurs, kEprosima)
                             .submessage(0x0e, 0, destination)
                             .acknack(reader, kOfWriter, next, 0)
                             .bytes());
  }
  // From `number` on; returns how many were taken.
  std::size_t fill(const Prefix& sender, std::int64_t number, std::size_t size = 60'000) {
    std::size_t taken = 0;
    while (data(sender, number++, size)) ++taken;
    return taken;
  }

  SamplesAhead samples_;
};

TEST_F(Ahead, AreNotCountedOfAWriterWithoutAReliableReader) {
  for (std::int64_t i = 2; i < 10'000; ++i) ASSERT_TRUE(data(kFirst, i, 60'000));
  EXPECT_EQ(samples_.samples(), 0U);
}

TEST_F(Ahead, AreBoundedInBytes) {
  acknowledge(kFirst, 1);
  const std::size_t taken = fill(kFirst, 2);
  EXPECT_GT(taken, 1000U);
  EXPECT_LE(samples_.bytes(), SamplesAhead::kMostBytes);
  EXPECT_TRUE(data(kFirst, 2, 60'000)) << "one that is there comes again";
  EXPECT_TRUE(data(kFirst, 1, 60'000)) << "the one that the reader waits for";
  acknowledge(kFirst, 2 + static_cast<std::int64_t>(taken));
  EXPECT_EQ(samples_.bytes(), 0U);
  EXPECT_EQ(samples_.samples(), 0U);
}

TEST_F(Ahead, AreBoundedInNumber) {
  acknowledge(kFirst, 1);
  EXPECT_EQ(fill(kFirst, 2, 8), SamplesAhead::kMostSamples);
}

TEST_F(Ahead, KeepNobodyElseFromReadingInTurn) {
  acknowledge(kFirst, 1);
  fill(kFirst, 2);
  acknowledge(kSecond, 1);
  EXPECT_FALSE(data(kSecond, 2, 60'000));
  for (std::int64_t i = 1; i < 100; ++i) {
    EXPECT_TRUE(data(kSecond, i, 60'000));
    acknowledge(kSecond, i + 1);
  }
}

TEST_F(Ahead, GoWithTheirParticipant) {
  acknowledge(kFirst, 1);
  fill(kFirst, 2);
  acknowledge(kSecond, 1);
  ASSERT_FALSE(data(kSecond, 2, 60'000));
  samples_.gave_up(kFirst);
  EXPECT_EQ(samples_.bytes(), 0U);
  EXPECT_TRUE(data(kSecond, 2, 60'000));
}

TEST_F(Ahead, CountForEachReaderThatKeepsThem) {
  acknowledge(kFirst, 1);
  acknowledge(kFirst, 5, kOfSecondReader);
  EXPECT_TRUE(data(kFirst, 4));
  EXPECT_EQ(samples_.samples(), 1U) << "the second one has it";
  EXPECT_TRUE(data(kFirst, 6));
  EXPECT_EQ(samples_.samples(), 3U);
  EXPECT_TRUE(data(kFirst, 7, 1000, kOfSecondReader));
  EXPECT_EQ(samples_.samples(), 4U) << "for this reader alone";
}

// Several participants of one process may speak through each other.
TEST_F(Ahead, CountForWhomTheyAreSaid) {
  acknowledge(kSecond, 1);
  Bytes source(8);
  source.insert(source.end(), kSecond.begin(), kSecond.end());
  const auto message = Message(kFirst, kEprosima)
                           .submessage(0x0c, 0, source)
                           .data(0, kOfWriter, 5, kData, {}, Bytes(1000));
  Bytes bytes = message.bytes();
  std::size_t refused = 0;
  EXPECT_EQ(samples_.take(bytes, refused), bytes.size());
  EXPECT_EQ(samples_.samples(), 1U);
}

TEST_F(Ahead, CountAFragmentAsItsWholeSample) {
  acknowledge(kFirst, 1);
  const auto fragment = [](std::int64_t number) {
    return Message(kFirst, kEprosima).fragment(0, kOfWriter, number, 1, 1, 8, kMaxSampleBytes, Bytes(8));
  };
  for (std::int64_t i = 2; i < 6; ++i) EXPECT_TRUE(take(fragment(i)));
  EXPECT_EQ(samples_.bytes(), std::size_t{4} * kMaxSampleBytes);
  EXPECT_FALSE(take(fragment(6)));
  EXPECT_TRUE(take(fragment(3))) << "further ones of a sample that is counted";
}

TEST_F(Ahead, PairsThatKeepNothingAreForgottenForNewOnes) {
  acknowledge(kFirst, 1);
  ASSERT_TRUE(data(kFirst, 3));
  for (std::size_t i = 0; i < 3 * SamplesAhead::kPairs; ++i) {
    const Bytes destination(kSecond.begin(), kSecond.end());
    samples_.acknowledge(Message(kOurs, kEprosima)
                             .submessage(0x0e, 0, destination)
                             .acknack(kOfReader, static_cast<std::uint32_t>(i << 8 | 2), 1, 0)
                             .bytes());
    ASSERT_LE(samples_.pairs(), SamplesAhead::kPairs);
  }
  EXPECT_EQ(samples_.samples(), 1U);
  acknowledge(kFirst, 4);
  EXPECT_EQ(samples_.samples(), 0U);
}

// A reader behind a network that loses and repeats: whatever else is kept, it reads all in the end, and what it keeps
// is what is counted.
TEST_F(Ahead, AReaderBehindALossyNetworkReadsEverything) {
  for (const bool flooded : {false, true}) {
    samples_ = {};
    if (flooded) {
      acknowledge(kSecond, 1);
      fill(kSecond, 2);
    }
    const std::size_t others = samples_.samples();
    std::mt19937_64 random(5);
    std::set<std::int64_t> kept;
    std::int64_t next = 1, written = 0;
    acknowledge(kFirst, next);
    for (int step = 0; next <= 2000; ++step) {
      ASSERT_LT(step, 2'000'000);
      if (written < 2000 && random() % 2 == 0) ++written;
      const auto window = static_cast<std::int64_t>(random() % 30);
      const std::int64_t number = std::min(written, next + window);
      const bool lost = number < next || random() % 3 == 0;
      if (lost) continue;
      if (data(kFirst, number, 60'000)) kept.insert(number);
      while (kept.erase(next) > 0) ++next;
      if (random() % 4 == 0) acknowledge(kFirst, next);
      if (random() % 4 != 0) continue;
      acknowledge(kFirst, next);
      ASSERT_EQ(samples_.samples() - others, kept.size());
    }
  }
}

}  // namespace
}  // namespace roci::services::vendors::guard
