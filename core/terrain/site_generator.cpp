#include "core/terrain/site_generator.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "core/pseudorandom/split_mix.hpp"
#include "core/terrain/lattice_noise.hpp"

namespace roci::terrain {
namespace {

constexpr std::int64_t kBlackHeight = 1000;  // height [mm] of the rock that a black pixel stands for
constexpr double kPi = 3.14159265358979323846;

// Is a layer in millimetres, by rows from the north as images are.
class Layer {
 public:
  Layer(int side, std::int64_t resolution) : side_(side), resolution_(resolution) {
    cells_.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  }

  const std::vector<std::int64_t>& cells() const { return cells_; }

  // Calls change(value, x, y) for each cell whose centre (x, y) lies in the square around (x0, y0).
  template <typename Change>
  void for_square(std::int64_t x0, std::int64_t y0, std::int64_t half, Change change) {
    const auto cell = [this](std::int64_t v) {
      return static_cast<int>(std::clamp<std::int64_t>(v / resolution_, 0, side_ - 1));
    };
    for (int row = cell(y0 - half); row <= cell(y0 + half); ++row) {
      for (int column = cell(x0 - half); column <= cell(x0 + half); ++column) {
        change(cells_[static_cast<std::size_t>(side_ - 1 - row) * static_cast<std::size_t>(side_) +
                      static_cast<std::size_t>(column)],
               column * resolution_ + resolution_ / 2, row * resolution_ + resolution_ / 2);
      }
    }
  }

  template <typename Change>
  void for_all(Change change) {
    const std::int64_t half = side_ * resolution_ / 2;
    for_square(half, half, half, change);
  }

 private:
  int side_;
  std::int64_t resolution_;
  std::vector<std::int64_t> cells_;
};

std::int64_t square(std::int64_t v) { return v * v; }

void add_hills(Layer& ground, const SiteRecipe& recipe) {
  std::uint64_t octave_seed = recipe.seed;
  for (const Octave& octave : recipe.hills) {
    octave_seed += 0x51ed270b;
    ground.for_all([&](std::int64_t& z, std::int64_t x, std::int64_t y) {
      z += lattice_noise(octave_seed, x, y, octave.wavelength, octave.amplitude);
    });
  }
}

// Adds a parabola from -depth to the rim's height inside the rim; outside, the rim falls off with the square
// of the distance squared, to nothing at twice the radius.
void add_crater(Layer& ground, const Crater& crater) {
  const std::int64_t radius2 = square(crater.diameter / 2);
  const std::int64_t rim = crater.depth / 10;
  ground.for_square(crater.x, crater.y, crater.diameter,
                    [&](std::int64_t& z, std::int64_t x, std::int64_t y) {
                      const std::int64_t d2 = square(x - crater.x) + square(y - crater.y);
                      if (d2 <= radius2) {
                        z += (crater.depth + rim) * d2 / radius2 - crater.depth;
                      } else if (d2 < 4 * radius2) {
                        const std::int64_t left = (4 * radius2 - d2) * 1000 / (3 * radius2);
                        z += rim * left * left / 1000000;
                      }
                    });
}

void add_craters(Layer& ground, const SiteRecipe& recipe) {
  pseudorandom::SplitMix64 random(recipe.seed ^ 0xc2a7e25);
  const std::int64_t side = recipe.cells_per_side * recipe.resolution;
  for (int i = 0; i < recipe.crater_count; ++i) {
    Crater crater{random.below(side), random.below(side), 8000 + random.below(24000), 0};
    crater.depth = crater.diameter * (50 + random.below(70)) / 1000;
    add_crater(ground, crater);
  }
  for (const Crater& crater : recipe.craters) add_crater(ground, crater);
}

void add_rock(Layer& rocks, std::int64_t x, std::int64_t y, std::int64_t diameter) {
  const auto raise = [&](std::int64_t& height) { height = std::max(height, diameter / 2); };
  rocks.for_square(x, y, 0, [&](std::int64_t& height, std::int64_t, std::int64_t) { raise(height); });
  rocks.for_square(x, y, diameter / 2, [&](std::int64_t& height, std::int64_t cx, std::int64_t cy) {
    if (square(cx - x) + square(cy - y) <= square(diameter / 2)) raise(height);
  });
}

void scatter_rocks(Layer& rocks, const SiteRecipe& recipe) {
  if (recipe.rock_abundance == 0) return;
  const std::int64_t side = recipe.cells_per_side * recipe.resolution;
  const double site_area = static_cast<double>(side) * static_cast<double>(side) / 1e6;
  const double q = 1.79 + 0.152 / recipe.rock_abundance;
  const auto covered = [&](double d) { return recipe.rock_abundance * std::exp(-q * d); };
  pseudorandom::SplitMix64 random(recipe.seed ^ 0x20c5);
  constexpr std::int64_t kClass = 50;
  for (std::int64_t d = 200; d < 2000; d += kClass) {
    const double diameter = static_cast<double>(2 * d + kClass) / 2000;
    const double share =
        covered(static_cast<double>(d) / 1000) - covered(static_cast<double>(d + kClass) / 1000);
    const auto count = std::llround(site_area * share / (kPi / 4 * diameter * diameter));
    for (long long i = 0; i < count; ++i) {
      const std::int64_t x = random.below(side);
      const std::int64_t y = random.below(side);
      const bool kept_free = std::any_of(
          recipe.clearings.begin(), recipe.clearings.end(),
          [&](const Clearing& c) { return square(x - c.x) + square(y - c.y) < square(c.radius + d); });
      if (!kept_free) add_rock(rocks, x, y, d + kClass / 2);
    }
  }
}

// Adds a ring one and a half cells thick, so that it has no gap even between diagonal neighbours.
void add_ring(Layer& rocks, const RockRing& ring, std::int64_t resolution) {
  const std::int64_t inner = ring.radius - resolution * 3 / 4;
  const std::int64_t outer = ring.radius + resolution * 3 / 4;
  rocks.for_square(ring.x, ring.y, outer, [&](std::int64_t& height, std::int64_t x, std::int64_t y) {
    const std::int64_t d2 = square(x - ring.x) + square(y - ring.y);
    if (d2 >= square(inner) && d2 <= square(outer)) height = std::max(height, ring.rock_height);
  });
}

GreyImage rock_image(const Layer& rocks, int side) {
  GreyImage image{side, side, 255, {}};
  for (const std::int64_t height : rocks.cells()) {
    const std::int64_t dark = (std::min(height, kBlackHeight) * 255 + kBlackHeight / 2) / kBlackHeight;
    image.pixels.push_back(static_cast<std::uint16_t>(255 - dark));
  }
  return image;
}

GreyImage elevation_image(const Layer& ground, int side, std::int64_t low, std::int64_t high) {
  GreyImage image{side, side, 65535, {}};
  for (const std::int64_t z : ground.cells()) {
    image.pixels.push_back(static_cast<std::uint16_t>(((z - low) * 65535 + (high - low) / 2) / (high - low)));
  }
  return image;
}

std::string metres(std::int64_t millimetres) {
  char text[32];
  std::snprintf(text, sizeof text, "%s%lld.%03lld", millimetres < 0 ? "-" : "",
                static_cast<long long>(std::abs(millimetres) / 1000),
                static_cast<long long>(std::abs(millimetres) % 1000));
  return text;
}

std::string describe(const SiteRecipe& recipe, std::int64_t low, std::int64_t high) {
  return "# map_server description, extended by rocks and elevation (core/terrain/README.md).\n"
         "# Written by roci-site, seed " +
         std::to_string(recipe.seed) +
         ": do not edit.\n"
         "image: rocks.pgm\n"
         "mode: scale\n"
         "resolution: " +
         metres(recipe.resolution) +
         "\n"
         "origin: [0.0, 0.0, 0.0]\n"
         "negate: 0\n"
         "occupied_thresh: 0.25\n"
         "free_thresh: 0.05\n"
         "rocks: {max_height: " +
         metres(kBlackHeight) +
         "}\n"
         "elevation: {image: elevation.pgm, min: " +
         metres(low) + ", max: " + metres(high) + "}\n";
}

void check(const SiteRecipe& recipe) {
  const bool octaves_fit =
      std::all_of(recipe.hills.begin(), recipe.hills.end(), [](const Octave& o) { return o.wavelength > 0; });
  const bool craters_fit = std::all_of(recipe.craters.begin(), recipe.craters.end(),
                                       [](const Crater& c) { return c.diameter > 1; });
  if (recipe.cells_per_side < 1 || recipe.cells_per_side > 4096 || recipe.resolution < 10 ||
      recipe.resolution > 100000 || !octaves_fit || !craters_fit) {
    throw std::invalid_argument("a site has 1 … 4096 cells per side of 0.01 … 100 m, and lengths above zero");
  }
  if (!(recipe.rock_abundance >= 0 && recipe.rock_abundance <= 0.4)) {
    throw std::invalid_argument("rock abundance is a share of the ground, 0 … 0.4");
  }
}

}  // namespace

GeneratedSite generate_site(const SiteRecipe& recipe) {
  check(recipe);
  Layer ground(recipe.cells_per_side, recipe.resolution);
  add_hills(ground, recipe);
  add_craters(ground, recipe);

  Layer rocks(recipe.cells_per_side, recipe.resolution);
  scatter_rocks(rocks, recipe);
  for (const RockRing& ring : recipe.rings) add_ring(rocks, ring, recipe.resolution);

  const auto [lowest, highest] = std::minmax_element(ground.cells().begin(), ground.cells().end());
  const std::int64_t low = *lowest;
  const std::int64_t high = std::max(*highest, low + 1);
  return {describe(recipe, low, high), rock_image(rocks, recipe.cells_per_side),
          elevation_image(ground, recipe.cells_per_side, low, high)};
}

}  // namespace roci::terrain
