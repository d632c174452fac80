#include "core/bytes/crc_32.hpp"

#include <gtest/gtest.h>

#include <string>

namespace roci::bytes {
namespace {

// The check value of the catalogue of CRC algorithms, and others that zlib's crc32() returns.
TEST(Crc32, IsThatOfIeee8023) {
  EXPECT_EQ(crc_32("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc_32(""), 0U);
  EXPECT_EQ(crc_32("a"), 0xE8B7BE43U);
  EXPECT_EQ(crc_32("The quick brown fox jumps over the lazy dog"), 0x414FA339U);
  EXPECT_EQ(crc_32(std::string(32, '\0')), 0x190A55ADU);
  EXPECT_EQ(crc_32(std::string(32, '\xff')), 0xFF6CAB0BU);
}

TEST(Crc32, PiecesCountAsTheWhole) {
  const std::string whole = "123456789";
  for (std::size_t cut = 0; cut <= whole.size(); ++cut)
    EXPECT_EQ(Crc32().add(whole.substr(0, cut)).add(whole.substr(cut)).value(), crc_32(whole)) << cut;
}

}  // namespace
}  // namespace roci::bytes
