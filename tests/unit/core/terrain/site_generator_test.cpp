#include "core/terrain/site_generator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "core/terrain/lattice_noise.hpp"

namespace roci::terrain {
namespace {

std::string content(const std::string& name) {
  std::ifstream in(std::string(ROCI_SOURCE_DIR) + "/missions/planetary/site/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Metres, of the cell (column, row) from the south-west.
double elevation(const GreyImage& image, int column, int row, double low, double high) {
  const auto pixel = static_cast<std::size_t>((image.height - 1 - row) * image.width + column);
  return low + (high - low) * image.pixels[pixel] / 65535.0;
}

SiteRecipe bare(int cells) {
  SiteRecipe recipe;
  recipe.cells_per_side = cells;
  recipe.hills.clear();
  recipe.crater_count = 0;
  recipe.craters.clear();
  recipe.rings.clear();
  recipe.clearings.clear();
  recipe.rock_abundance = 0;
  return recipe;
}

// The committed files were written on another day by another build: equal bytes show that the seed is all
// that counts.
TEST(SiteGenerator, ThePlanetarySiteIsItsSeed) {
  SiteRecipe recipe;
  recipe.seed = 3;
  const GeneratedSite site = generate_site(recipe);
  EXPECT_EQ(site.description, content("site.yaml"));
  EXPECT_TRUE(to_pgm(site.rocks, "roci-site --seed 3") == content("rocks.pgm"));
  EXPECT_TRUE(to_pgm(site.elevation, "roci-site --seed 3") == content("elevation.pgm"));
}

TEST(SiteGenerator, AnotherSeedGivesAnotherSite) {
  SiteRecipe recipe;
  recipe.cells_per_side = 60;
  const GeneratedSite one = generate_site(recipe);
  recipe.seed = 2;
  const GeneratedSite two = generate_site(recipe);
  EXPECT_NE(one.rocks.pixels, two.rocks.pixels);
  EXPECT_NE(one.elevation.pixels, two.elevation.pixels);
}

TEST(SiteGenerator, NoiseIsContinuousAndBounded) {
  for (std::int64_t x = -5000; x < 5000; x += 7) {
    const std::int64_t here = lattice_noise(9, x, 3 * x, 1000, 400);
    EXPECT_LE(std::abs(here), 400);
    EXPECT_LE(std::abs(lattice_noise(9, x + 1, 3 * x, 1000, 400) - here), 3);
  }
}

TEST(SiteGenerator, RockCountsFollowTheStatedDistribution) {
  SiteRecipe recipe = bare(400);
  recipe.resolution = 500;
  recipe.rock_abundance = 0.05;
  const GeneratedSite site = generate_site(recipe);
  // Rocks of 0.5 m diameter and more stand 0.25 m high and more. They are sparse, so that each fills its own
  // cells; those below 0.75 m (over nine tenths) fill few beside their own.
  const double q = 1.79 + 0.152 / 0.05;
  double expected = 0;
  for (double d = 0.5; d < 2; d += 0.01) {
    expected +=
        0.05 * (std::exp(-q * d) - std::exp(-q * (d + 0.01))) * 200 * 200 / (std::acos(-1.0) / 4 * d * d);
  }
  const auto tall = std::count_if(site.rocks.pixels.begin(), site.rocks.pixels.end(),
                                  [](std::uint16_t grey) { return (255 - grey) / 255.0 > 0.2509; });
  EXPECT_GT(static_cast<double>(tall), 0.9 * expected);
  EXPECT_LT(static_cast<double>(tall), 2.0 * expected);
}

TEST(SiteGenerator, ACraterHasItsDepthAndRim) {
  SiteRecipe recipe = bare(61);
  recipe.craters = {{30500, 30500, 40000, 5000}};
  const GeneratedSite site = generate_site(recipe);
  EXPECT_NE(site.description.find("min: -5.000, max: 0.500"), std::string::npos) << site.description;
  EXPECT_NEAR(elevation(site.elevation, 30, 30, -5, 0.5), -5, 0.01);
  EXPECT_NEAR(elevation(site.elevation, 0, 0, -5, 0.5), 0, 0.06);
  EXPECT_NEAR(elevation(site.elevation, 49, 30, -5, 0.5), -5 + 5.5 * 19 * 19 / 400, 0.06);
}

TEST(SiteGenerator, ARingIsClosedAndAClearingClear) {
  SiteRecipe recipe = bare(40);
  recipe.rings = {{20000, 20000, 8000, 700}};
  const GeneratedSite site = generate_site(recipe);
  const auto dark = [&](int column, int row) {
    return site.rocks.pixels[static_cast<std::size_t>((39 - row) * 40 + column)] != 255;
  };
  std::vector<std::pair<int, int>> frontier{{20, 20}};
  std::vector<bool> seen(1600, false);
  while (!frontier.empty()) {
    const auto [x, y] = frontier.back();
    frontier.pop_back();
    ASSERT_TRUE(x > 5 && x < 35 && y > 5 && y < 35) << "the flood left the ring";
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const auto next = static_cast<std::size_t>((y + dy) * 40 + x + dx);
        if (seen[next] || dark(x + dx, y + dy)) continue;
        seen[next] = true;
        frontier.emplace_back(x + dx, y + dy);
      }
    }
  }

  recipe.rock_abundance = 0.3;
  recipe.rings.clear();
  recipe.clearings = {{20000, 20000, 6000}};
  const GeneratedSite rocky = generate_site(recipe);
  for (int row = 16; row < 24; ++row) {
    for (int column = 16; column < 24; ++column) {
      EXPECT_EQ(rocky.rocks.pixels[static_cast<std::size_t>((39 - row) * 40 + column)], 255);
    }
  }
}

TEST(SiteGenerator, RefusesARecipeThatMakesNoSense) {
  SiteRecipe recipe = bare(10);
  recipe.rock_abundance = 0.9;
  EXPECT_THROW(generate_site(recipe), std::invalid_argument);
  recipe = bare(0);
  EXPECT_THROW(generate_site(recipe), std::invalid_argument);
  recipe = bare(10);
  recipe.hills = {{0, 5}};
  EXPECT_THROW(generate_site(recipe), std::invalid_argument);
}

}  // namespace
}  // namespace roci::terrain
