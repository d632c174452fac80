#include "core/bytes/little_endian.hpp"

#include <gtest/gtest.h>

#include <string>

namespace roci::bytes {
namespace {

std::string appended(std::uint64_t number, std::size_t size) {
  std::string out;
  append_little_endian(out, number, size);
  return out;
}

TEST(LittleEndian, TheLowestByteComesFirst) {
  EXPECT_EQ(appended(0x04030201U, 4), "\x01\x02\x03\x04");
  EXPECT_EQ(appended(0x04030201U, 2), "\x01\x02") << "what does not fit is left out";
  EXPECT_EQ(appended(0xff, 3), std::string("\xff\0\0", 3));
  EXPECT_EQ(appended(1, 0), "");
}

TEST(LittleEndian, BytesBecomeTheNumberAgain) {
  EXPECT_EQ(little_endian(""), 0U);
  EXPECT_EQ(little_endian("\xfe"), 0xfeU);
  for (const std::uint64_t number :
       {std::uint64_t{0}, std::uint64_t{0x80}, std::uint64_t{0xfedcba9876543210U}})
    EXPECT_EQ(little_endian(appended(number, 8)), number);
}

}  // namespace
}  // namespace roci::bytes
