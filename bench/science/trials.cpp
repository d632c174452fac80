#include "bench/science/trials.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <string>

#include "core/terrain/site_file.hpp"
#include "core/terrain/site_generator.hpp"
#include "sim_svc/components/preview.hpp"

namespace roci::bench::science {

namespace fs = std::filesystem;
using roci::science::CameraModel;
using sim::world::Oddity;
using terrain::Point;

namespace {

constexpr double kOddPerHectare = 35;
constexpr double kSide = 160;      // m, of a site
constexpr double kMargin = 20;     // m, that images keep from its border
constexpr double kAtTarget = 1.5;  // m, beyond the edge of a target, within which a goal is at it

std::shared_ptr<const terrain::Site> site_of(std::uint64_t seed) {
  terrain::SiteRecipe recipe;
  recipe.seed = seed;
  recipe.cells_per_side = static_cast<int>(kSide);
  recipe.craters.clear();
  recipe.rings.clear();
  const terrain::GeneratedSite generated = terrain::generate_site(recipe);
  const fs::path folder = fs::temp_directory_path() / ("roci_bench_science_" + std::to_string(seed));
  fs::create_directories(folder);
  const auto write = [&](const char* name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
  };
  write("site.yaml", generated.description);
  write("rocks.pgm", terrain::to_pgm(generated.rocks, ""));
  write("elevation.pgm", terrain::to_pgm(generated.elevation, ""));
  auto out = std::make_shared<terrain::Site>(terrain::load_site(folder / "site.yaml"));
  fs::remove_all(folder);
  return out;
}

void note_what_is_shown(const std::vector<Oddity>& near, const terrain::Site& site, double reach,
                        Trial& trial) {
  std::vector<int> pixels(near.size(), 0);
  const roci::science::MappedGround ground{&site};
  const auto& image = trial.photo.pixels;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const auto p = roci::science::ground_at(ground, CameraModel{}, trial.photo.from, image.width,
                                              image.height, column + 0.5, row + 0.5, 2 * reach);
      if (!p) continue;
      if (terrain::distance(*p, trial.photo.from.at) <= reach) trial.ground.push_back(*p);
      for (std::size_t i = 0; i < near.size(); ++i)
        pixels[i] += terrain::distance(*p, {near[i].x, near[i].y}) <= near[i].radius;
    }
  }
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (pixels[i] > 0) trial.odd.push_back(near[i]);
    const bool close = terrain::distance({near[i].x, near[i].y}, trial.photo.from.at) <= reach;
    if (pixels[i] >= kLeastPixels && close) trial.to_see.push_back(near[i]);
  }
}

}  // namespace

World make_world(std::uint64_t seed, int images, double reach) {
  World out{seed, site_of(seed), {}};
  sim::world::Ground ground{out.site, {}, {}};
  ground.surface.seed = seed;
  ground.surface.odd_per_hectare = kOddPerHectare;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> anywhere(kMargin, kSide - kMargin),
      turn(-std::numbers::pi, std::numbers::pi), share(0, 1);
  for (int i = 0; i < images; ++i) {
    sim::world::Pose pose{anywhere(random), anywhere(random), turn(random)};
    const auto odd = sim::world::oddities_near(ground.surface, {pose.x, pose.y}, 15);
    if (i % 2 == 0 && !odd.empty()) {
      const Oddity& one = odd.front();
      const double range = 3 + 8 * share(random), bearing = turn(random);
      pose = {one.x - range * std::cos(bearing), one.y - range * std::sin(bearing),
              bearing + 0.7 * (share(random) - 0.5)};
    }
    const auto file = sim::components::render_preview(ground, pose, {}, {},
                                                      sim::world::RandomStream(seed, std::to_string(i)));
    Trial trial;
    trial.photo.id = std::to_string(seed) + "-" + std::to_string(i);
    trial.photo.from = {{pose.x, pose.y}, pose.heading};
    trial.photo.pixels = roci::science::read_picture(
        {reinterpret_cast<const char*>(file.data()), file.size()}, trial.photo.id);
    note_what_is_shown(sim::world::oddities_near(ground.surface, {pose.x, pose.y}, 2 * reach), *out.site,
                       reach, trial);
    out.trials.push_back(std::move(trial));
  }
  return out;
}

void Score::add(const Score& other) {
  goals += other.goals;
  right += other.right;
  to_find += other.to_find;
  found += other.found;
}

Score score_of(const Trial& trial, const std::vector<Point>& places) {
  const auto at = [](const Oddity& one, Point p) {
    return terrain::distance(p, {one.x, one.y}) <= one.radius + kAtTarget;
  };
  Score out{static_cast<int>(places.size()), 0, static_cast<int>(trial.to_see.size()), 0};
  for (const Point p : places)
    out.right += std::ranges::any_of(trial.odd, [&](const Oddity& one) { return at(one, p); });
  for (const Oddity& one : trial.to_see)
    out.found += std::ranges::any_of(places, [&](Point p) { return at(one, p); });
  return out;
}

Score detect(const std::vector<World>& worlds, double threshold, double reach) {
  Score out;
  for (const World& world : worlds) {
    roci::science::DetectorSettings settings;
    settings.reach_m = reach;
    roci::science::Detector detector(settings, world.site);
    for (const Trial& trial : world.trials) {
      std::vector<Point> places;
      for (const auto& one : detector.candidates(trial.photo, threshold)) places.push_back(one.place);
      out.add(score_of(trial, places));
    }
  }
  return out;
}

Score guess(const std::vector<World>& worlds, int goals, std::uint64_t seed) {
  std::vector<const Trial*> trials;
  for (const World& world : worlds)
    for (const Trial& trial : world.trials) trials.push_back(&trial);
  std::vector<std::vector<Point>> places(trials.size());
  std::mt19937_64 random(seed);
  for (int i = 0; i < goals; ++i) {
    const std::size_t one = random() % trials.size();
    const auto& ground = trials[one]->ground;
    if (!ground.empty()) places[one].push_back(ground[random() % ground.size()]);
  }
  Score out;
  for (std::size_t i = 0; i < trials.size(); ++i) out.add(score_of(*trials[i], places[i]));
  return out;
}

}  // namespace roci::bench::science
