/// Images of worlds with known odd targets: what a detector of them is measured on.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "science_svc/detector.hpp"
#include "sim_svc/world/surface.hpp"

namespace roci::bench::science {

/// Is an image, and which targets it shows.
struct Trial {
  roci::science::Photo photo;
  std::vector<sim::world::Oddity> odd;     ///< all whose ground lies in view, at any size
  std::vector<sim::world::Oddity> to_see;  ///< those of at least kLeastPixels within reach
  std::vector<terrain::Point> ground;      ///< what its pixels show, within reach
};

inline constexpr int kLeastPixels = 12;

/// Is one seed's world: a site of its own, and images taken there in order.
struct World {
  std::uint64_t seed = 0;
  std::shared_ptr<const terrain::Site> site;
  std::vector<Trial> trials;
};

/// Makes the world of a seed with so many images: every other one is taken where a target may be in view.
World make_world(std::uint64_t seed, int images, double reach);

/// Counts what finds came to.
struct Score {
  int goals = 0;    ///< raised
  int right = 0;    ///< of these, those at an odd target
  int to_find = 0;  ///< targets to be seen, counted for each image
  int found = 0;    ///< of these, those at which a goal was raised

  double precision() const { return goals > 0 ? static_cast<double>(right) / goals : 1; }
  double recall() const { return to_find > 0 ? static_cast<double>(found) / to_find : 1; }
  void add(const Score&);
};

/// Compares the places of goals that were raised for an image with its targets.
Score score_of(const Trial&, const std::vector<terrain::Point>& places);

/// Shows each world to a detector of its own, with this threshold.
Score detect(const std::vector<World>&, double threshold, double reach);

/// Raises as many goals as given, each in an image and at a pixel of its ground drawn by chance.
Score guess(const std::vector<World>&, int goals, std::uint64_t seed);

}  // namespace roci::bench::science
