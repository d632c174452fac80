#include "core/terrain/pgm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "core/terrain/map_error.hpp"

namespace roci::terrain {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string& bytes) {
  try {
    parse_pgm(bytes, "map.pgm");
  } catch (const MapError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Pgm, RawImagesSurviveARoundTrip) {
  std::mt19937_64 random(1);
  for (const int max_value : {1, 200, 255, 256, 65535}) {
    GreyImage image{1 + static_cast<int>(random() % 40), 1 + static_cast<int>(random() % 40), max_value, {}};
    for (int i = 0; i < image.width * image.height; ++i) {
      image.pixels.push_back(static_cast<std::uint16_t>(random() % static_cast<unsigned>(max_value + 1)));
    }
    const GreyImage again = parse_pgm(to_pgm(image, "a comment"), "map.pgm");
    EXPECT_EQ(again.width, image.width);
    EXPECT_EQ(again.height, image.height);
    EXPECT_EQ(again.max_value, image.max_value);
    EXPECT_EQ(again.pixels, image.pixels);
  }
}

TEST(Pgm, PlainImagesWithCommentsAreRead) {
  const GreyImage image = parse_pgm("P2 # plain\n# size\n3 2\n9\n0 1 2\n7 8 9\n", "map.pgm");
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.height, 2);
  EXPECT_THAT(image.pixels, testing::ElementsAre(0, 1, 2, 7, 8, 9));
}

TEST(Pgm, SixteenBitPixelsHaveTheHigherByteFirst) {
  EXPECT_THAT(parse_pgm(std::string("P5 1 1 65535\n\x01\x02", 15), "m").pixels, testing::ElementsAre(0x0102));
}

TEST(Pgm, ErrorsNameFileLineAndFault) {
  EXPECT_THAT(error_of(""), HasSubstr("map.pgm:1: not a PGM"));
  EXPECT_THAT(error_of("\x89PNG"), HasSubstr("not a PGM"));
  EXPECT_THAT(error_of("P5\n# c\n12 x"), HasSubstr("map.pgm:3: the height is not a number"));
  EXPECT_THAT(error_of("P5\n12"), HasSubstr("the file ends where the height should stand"));
  EXPECT_THAT(error_of("P5\n0 5\n255\n"), HasSubstr("the width is out of range"));
  EXPECT_THAT(error_of("P5\n5 99999999999999999999\n255\n"), HasSubstr("the height is out of range"));
  EXPECT_THAT(error_of("P5\n2 2\n70000\nabcd"), HasSubstr("map.pgm:3: the largest value is out of range"));
  EXPECT_THAT(error_of("P5\n2 2\n255\nabc"),
              HasSubstr("truncated: 4 bytes of pixels are announced, 3 are there"));
  EXPECT_THAT(error_of("P5\n2 1\n65535\nabc"), HasSubstr("truncated: 4 bytes"));
  EXPECT_THAT(error_of("P5\n2 2\n255"), HasSubstr("one white space must stand"));
  EXPECT_THAT(error_of("P5\n1 1\n9\nz"), HasSubstr("pixel 0 is 122, more than the largest value 9"));
  EXPECT_THAT(error_of("P2\n2 1\n9\n3\n12\n"), HasSubstr("map.pgm:5: the pixel is out of range 0 … 9"));
  EXPECT_THAT(error_of("P2\n2 1\n9\n3"), HasSubstr("the file ends where the pixel should stand"));
}

TEST(Pgm, MutatedImagesNeverCrash) {
  std::mt19937_64 random(2);
  const std::string good = to_pgm({6, 5, 300, std::vector<std::uint16_t>(30, 77)}, "seed");
  for (int round = 0; round < 20000; ++round) {
    std::string bytes = good.substr(0, random() % 4 == 0 ? random() % good.size() : good.size());
    for (std::size_t k = random() % 4; k > 0 && !bytes.empty(); --k) {
      bytes[random() % bytes.size()] = static_cast<char>(random());
    }
    try {
      const GreyImage image = parse_pgm(bytes, "map.pgm");
      EXPECT_EQ(image.pixels.size(),
                static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    } catch (const MapError&) {
    }
  }
}

TEST(Pgm, AMissingFileIsNamed) {
  try {
    read_pgm("/nowhere/map.pgm");
    FAIL() << "a missing file was read";
  } catch (const MapError& e) {
    EXPECT_THAT(e.what(), HasSubstr("/nowhere/map.pgm: cannot open"));
  }
}

}  // namespace
}  // namespace roci::terrain
