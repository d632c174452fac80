// What an image shows of the ground.
#include "sim_svc/components/preview.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/terrain/pgm.hpp"
#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::components {
namespace {

using terrain::GreyImage;
using world::Ground;
using world::Look;
using world::Pose;
using world::RandomStream;

constexpr Pose kHere{60, 60, 0};

View calm() {
  View view;
  view.noise = 0;
  return view;
}

GreyImage render(const Ground& ground, const Pose& pose = kHere, const View& view = calm(),
                 temporal::Time at = {}) {
  const auto file = render_preview(ground, pose, view, at, RandomStream(1, "test"));
  return terrain::parse_pgm({reinterpret_cast<const char*>(file.data()), file.size()}, "image");
}

double mean(const GreyImage& image, int left, int top, int width, int height) {
  double sum = 0;
  for (int row = top; row < top + height; ++row)
    for (int column = left; column < left + width; ++column)
      sum += image.pixels[static_cast<std::size_t>(row * image.width + column)];
  return sum / (width * height);
}

// Returns what 6 m ahead of a camera at kHere is shown by: 4 rows around the ray that meets flat ground there.
double at_target(const Ground& ground) { return mean(render(ground), 44, 30, 8, 4); }

Ground ground_with(std::vector<world::Oddity> odd) {
  Ground ground{flat_site(), {}, {}};
  ground.surface.placed = std::move(odd);
  return ground;
}

TEST(Preview, IsAnImageOfTheSizeThatWasAskedFor) {
  View view;
  view.width_px = 40;
  view.height_px = 20;
  const GreyImage image = render(ground_with({}), kHere, view);
  EXPECT_EQ(image.width, 40);
  EXPECT_EQ(image.height, 20);
  EXPECT_EQ(image.max_value, 255);
}

TEST(Preview, IsTheSameForTheSameSeedAndAnotherForAnother) {
  Ground one = ground_with({}), other = ground_with({});
  other.surface.seed = 2;
  EXPECT_EQ(render(one).pixels, render(one).pixels);
  EXPECT_NE(render(one).pixels, render(other).pixels) << "texture and pebbles are the seed's";
  EXPECT_NE(render(one).pixels, render(one, {61, 60, 0}).pixels);
}

TEST(Preview, HasSkyAboveAndGroundOfMiddleGreyBelow) {
  const GreyImage image = render(ground_with({}));
  const double sky = mean(image, 0, 0, 96, 2), ground = mean(image, 0, 10, 96, 54);
  EXPECT_GT(sky, 170);
  EXPECT_NEAR(ground, 115, 25);
}

TEST(Preview, OddTargetsDifferFromTheGroundAroundThem) {
  const double plain = at_target(ground_with({}));
  EXPECT_GT(at_target(ground_with({{66, 60, 1, Look::bright}})), plain + 60);
  EXPECT_LT(at_target(ground_with({{66, 60, 1, Look::dark}})), plain - 60);
}

TEST(Preview, ARockStandsInTheWayOfWhatLiesBehind) {
  Ground ground = ground_with({{68, 60, 1.2, Look::bright}});
  const double open = mean(render(ground), 44, 22, 8, 5);
  ground.hidden_rocks = {{65.5, 60, 1.2}};
  EXPECT_LT(mean(render(ground), 44, 22, 8, 5), open - 30);
}

TEST(Preview, SlopesThatFaceTheSunAreLighter) {
  const auto ramp = [](double grade, double azimuth_deg) {
    Ground ground{ramp_site(grade), {}, {}};
    ground.surface.sun.azimuth_deg = azimuth_deg;
    return mean(render(ground), 0, 40, 96, 20);
  };
  EXPECT_GT(ramp(0.2, 180), ramp(0.2, 0) + 20) << "the ground rises eastwards and faces west";
}

TEST(Preview, NightIsDark) {
  Ground ground = ground_with({});
  ground.surface.sun = {0, 0, 80000, 0, 20};
  const double noon = mean(render(ground, kHere, calm(), temporal::seconds(0)), 0, 20, 96, 44);
  const double night = mean(render(ground, kHere, calm(), temporal::seconds(40000)), 0, 20, 96, 44);
  EXPECT_GT(noon, 80);
  EXPECT_LT(night, 40);
}

TEST(Preview, NoiseIsThatOfItsStream) {
  View noisy;
  noisy.noise = 0.05;
  const Ground ground = ground_with({});
  const GreyImage with = render(ground, kHere, noisy), without = render(ground);
  double sum = 0;
  for (std::size_t i = 0; i < with.pixels.size(); ++i) sum += std::pow(with.pixels[i] - without.pixels[i], 2);
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(with.pixels.size())), 0.05 * 255, 2);
}

}  // namespace
}  // namespace roci::sim::components
