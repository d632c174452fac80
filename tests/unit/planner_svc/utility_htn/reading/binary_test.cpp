// The binary form of a network (R83): whole or not at all, with the byte at which it is refused.
#include "planner_svc/utility_htn/reading/binary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "core/bytes/crc_32.hpp"
#include "core/bytes/little_endian.hpp"
#include "planner_svc/utility_htn/model/bounds.hpp"
#include "planner_svc/utility_htn/model/check.hpp"
#include "tests/unit/planner_svc/utility_htn/random/random_network.hpp"
#include "tests/unit/planner_svc/utility_htn/reading/texts.hpp"

namespace roci::planner::utility_htn::reading {
namespace {

using model::Network;
using testing::HasSubstr;

std::string packed() {
  mission::Findings findings;
  return to_binary(*parse_yaml(kSound, "n.yaml", findings).network);
}

std::string refusal(const std::string& bytes) {
  try {
    parse_binary(bytes);
  } catch (const BinaryError& error) {
    return error.what();
  }
  return "taken";
}

// A head and a checksum that fit a body of one's own.
std::string sealed(const std::string& body) {
  std::string out = std::string(kBinaryMagic) + static_cast<char>(kBinaryFormat);
  for (std::size_t size = body.size();; size >>= 7U) {
    out += static_cast<char>(size < 0x80 ? size : (size & 0x7fU) | 0x80U);
    if (size < 0x80) break;
  }
  out += body;
  bytes::append_little_endian(out, bytes::crc_32(out), kChecksumBytes);
  return out;
}

std::string body_of(const std::string& bytes) {
  std::size_t at = kBinaryMagic.size() + 1;
  while ((static_cast<unsigned char>(bytes[at]) & 0x80U) != 0) ++at;
  return bytes.substr(at + 1, bytes.size() - at - 5);
}

TEST(NetworkBinary, EveryEndThatIsCutOffIsRefused) {
  const std::string bytes = packed();
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_THAT(refusal(bytes.substr(0, size)), HasSubstr("at byte ")) << size;
  EXPECT_THAT(refusal(bytes + "x"), HasSubstr("at byte 8: the head speaks of"));
}

TEST(NetworkBinary, EveryBitThatIsFlippedIsRefused) {
  const std::string bytes = packed();
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    std::string flipped = bytes;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    ASSERT_NE(refusal(flipped), "taken") << bit;
  }
}

TEST(NetworkBinary, SaysWhatIsWrongAndWhatToDo) {
  std::string newer = packed();
  newer[7] = 2;
  EXPECT_EQ(
      refusal(newer),
      "at byte 7: version 2 of the form; version 1 is read here; pack it with the program of this build");
  EXPECT_THAT(refusal("format: 1"), HasSubstr("at byte 0: no network in binary form"));
  std::string changed = packed();
  changed[40] = static_cast<char>(changed[40] + 1);
  EXPECT_THAT(refusal(changed),
              HasSubstr("the checksum is another: some of the bytes were changed; have it sent again"));
  EXPECT_THAT(refusal(sealed(body_of(packed()) + "x")), HasSubstr("1 bytes too many"));
}

TEST(NetworkBinary, ACountIsHeldAgainstWhatIsLeftBeforeAnythingIsMade) {
  EXPECT_THAT(refusal(sealed("\xff\xff\xff\x03")),
              HasSubstr("at byte 13: a list of 8388607 items in 0 bytes"));
  EXPECT_THAT(refusal(sealed("\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01")),
              HasSubstr("a list of 18446744073709551615 items, at most"));
  EXPECT_THAT(refusal(sealed("\xff\xff\xff\xff\xff\xff\xff\xff\xff\x02")),
              HasSubstr("a number is larger than 64 bits"));
  EXPECT_THAT(refusal(sealed(std::string("\x01\x05"
                                         "ab"))),
              HasSubstr("the bytes end in a text"));
}

TEST(NetworkBinary, WhatIsReadIsCheckedBeforeItIsUsed) {
  mission::Findings findings;
  Network network = *parse_yaml(kSound, "n.yaml", findings).network;
  network.cycle.commit_window = temporal::seconds(1);
  EXPECT_FALSE(take_network(to_binary(network), "up.bin", findings));
  ASSERT_EQ(findings.errors(), 1U);
  EXPECT_THAT(findings.all()[0].text(), HasSubstr("up.bin: network 'lander': its commit window of 1 s"));
}

// Half of the damages are sealed again, so that they come as far as the fields.
TEST(NetworkBinary, AHundredThousandDamagesAreTakenOrRefused) {
  const std::string whole = packed(), body = body_of(whole);
  std::mt19937_64 random(5);
  std::size_t taken = 0;
  for (int round = 0; round < 100'000; ++round) {
    std::string bytes = round % 2 == 0 ? whole : body;
    const std::size_t at = random() % bytes.size();
    switch (random() % 4) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.insert(at, bytes, random() % bytes.size(), random() % 16);
        break;
      default:
        bytes[at] = static_cast<char>(random());
    }
    try {
      const Network network = parse_binary(round % 2 == 0 ? bytes : sealed(bytes));
      if (taken++ % 64 == 0) model::check(network);
    } catch (const BinaryError&) {
    }
  }
  EXPECT_GT(taken, 1000U);
}

}  // namespace
}  // namespace roci::planner::utility_htn::reading
