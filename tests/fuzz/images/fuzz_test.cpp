// Mutated image files: each is read or refused with a reason that names it, takes no more memory than it has pixels,
// and what is read can be looked at.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "core/terrain/map_error.hpp"
#include "science_svc/detector.hpp"
#include "science_svc/limits.hpp"
#include "tests/fuzz/rounds.hpp"

namespace roci::fuzz {
namespace {

using terrain::GreyImage;

constexpr const char* kHeaders[] = {"P5\n32 24\n255\n",
                                    "P5\n# made\n32 24\n255\n",
                                    "P5 32 24 15 ",
                                    "P5\n32 24\n65535\n",
                                    "P5\n99999 1\n255\n",
                                    "P5\n10000 10000\n255\n",
                                    "P5\n0 0\n255\n",
                                    "P5\n-3 24\n255\n",
                                    "P5\n32 24\n0\n",
                                    "P2\n32 24\n255\n",
                                    "P5\n1024 1024\n1\n",
                                    "P5",
                                    "P5\n18446744073709551616 2\n255\n"};

std::string made(std::mt19937_64& random) {
  std::string out = kHeaders[random() % std::size(kHeaders)];
  const std::size_t pixels = random() % 4 == 0 ? random() % 2000 : 32 * 24;
  for (std::size_t i = 0; i < pixels; ++i)
    out += static_cast<char>(random() % (random() % 2 == 0 ? 256 : 16));
  for (std::uint64_t i = random() % 4; i > 0; --i) {
    const std::size_t at = random() % std::min<std::size_t>(out.size(), random() % 2 == 0 ? 16 : out.size());
    switch (random() % 3) {
      case 0:
        out[at] = static_cast<char>(random());
        break;
      case 1:
        out.erase(at, random() % 8 + 1);
        break;
      default:
        out.insert(at, 1, "0123456789 \n#"[random() % 13]);
    }
    if (out.empty()) return out;
  }
  return out;
}

TEST(FuzzImages, EachIsReadOrRefusedWithAReason) {
  std::mt19937_64 random(16);
  science::DetectorSettings settings;
  settings.threshold = 0;
  science::Detector detector(settings, nullptr);
  int read = 0;
  for (int i = 0; i < rounds(3000); ++i) {
    const std::string file = made(random);
    GreyImage image;
    try {
      image = science::read_picture(file, "image");
    } catch (const terrain::MapError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("image")) << error.what();
      continue;
    }
    ++read;
    EXPECT_EQ(image.pixels.size(),
              static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    EXPECT_LE(image.pixels.size(), file.size());
    EXPECT_LE(std::max(image.width, image.height), science::kSidePixels);
    for (const auto& one : detector.candidates({std::to_string(i), {{0, 0}, 0}, image}, 0.5)) {
      EXPECT_GE(one.score, 0.5);
      EXPECT_LT(one.score, 1);
    }
  }
  EXPECT_GT(read, rounds(100));
}

}  // namespace
}  // namespace roci::fuzz
