// This file renders images of the simulated ground as a body's camera takes them.
#pragma once
#include <cstdint>
#include <vector>

#include "core/temporal/duration.hpp"
#include "sim_svc/world/environment.hpp"
#include "sim_svc/world/random_stream.hpp"
#include "sim_svc/world/values.hpp"

namespace roci::sim::components {

/// Says how a camera looks at the ground: a pinhole on a mast, that looks along the body's heading and down.
struct View {
  double mast_m = 1.9;   ///< height above the ground
  double tilt_deg = 18;  ///< of the middle of the image below the horizon
  double view_deg = 60;  ///< from the left edge to the right one
  int width_px = 96;     ///< 8 … 1024; pixels are square
  int height_px = 64;    ///< 8 … 1024
  double noise = 0.02;   ///< standard deviation of a pixel, as a share of white
};

/// Renders what a camera on a body sees, as a binary PGM file of 8 bits: rays are marched over the ground (Relief),
/// which is lit by the sun (Lambert's law, cast shadows, a little light of the sky) and exposed so that flat ground is
/// of middle grey by day. The image is the same for the same ground, pose, view,
/// time and stream. The ground has a site.
std::vector<std::uint8_t> render_preview(const world::Ground&, const world::Pose& from, const View&,
                                         temporal::Time at, world::RandomStream noise);

}  // namespace roci::sim::components
