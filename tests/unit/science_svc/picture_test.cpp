#include "science_svc/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/terrain/map_error.hpp"
#include "science_svc/limits.hpp"

namespace roci::science {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string& file) {
  try {
    read_picture(file, "img-1");
  } catch (const terrain::MapError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Picture, IsReadIfItIsABinaryPgmOf8Bits) {
  const terrain::GreyImage image = read_picture("P5\n16 20\n255\n" + std::string(320, 'a'), "img-1");
  EXPECT_EQ(image.width, 16);
  EXPECT_EQ(image.height, 20);
  EXPECT_EQ(image.pixels.back(), 'a');
}

TEST(Picture, WhatIsWrongIsNamed) {
  EXPECT_THAT(error_of(""), HasSubstr("img-1: the image has no pixels"));
  EXPECT_THAT(error_of("\x89PNG"), HasSubstr("not a binary PGM image"));
  EXPECT_THAT(error_of("P2\n16 16\n255\n1"), HasSubstr("not a binary PGM image"));
  EXPECT_THAT(error_of("P5\n16 16\n255\nabc"), HasSubstr("256 bytes of pixels are announced, 3 are there"));
  EXPECT_THAT(error_of("P5\n0 0\n255\n"), HasSubstr("the width is out of range"));
  EXPECT_THAT(error_of("P5\n10000 10000\n255\nabc"),
              HasSubstr("100000000 bytes of pixels are announced, 3 are there"));
  EXPECT_THAT(error_of("P5\n16 16\n65535\n" + std::string(512, '\1')), HasSubstr("16 bits a pixel"));
  EXPECT_THAT(error_of("P5\n8 40\n255\n" + std::string(320, 'a')),
              HasSubstr("8 x 40 pixels; an image has 16 to 1024 a side"));
  EXPECT_THAT(error_of("P5\n2000 20\n255\n" + std::string(40000, 'a')), HasSubstr("2000 x 20 pixels"));
  EXPECT_THAT(error_of("P5\n" + std::string(kFileBytes, ' ')), HasSubstr("more than an image may have"));
}

TEST(Picture, ACutStaysWithinTheImage) {
  terrain::GreyImage image{4, 3, 255, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
  const std::string file = cut(image, {2, 1, 9, 9});
  EXPECT_EQ(file.substr(0, 11), "P5\n2 2\n255\n");
  EXPECT_EQ(file.substr(11), std::string("\6\7\12\13"));
}

}  // namespace
}  // namespace roci::science
