#pragma once
#include <cstdint>
#include <vector>

#include "sim_svc/world/environment.hpp"
#include "sim_svc/world/random_stream.hpp"
#include "sim_svc/world/values.hpp"

namespace roci::sim::components {

inline constexpr int kPreviewWidth = 24;
inline constexpr int kPreviewHeight = 16;

/// Renders a thumbnail of what lies ahead, as seen from the mast: each pixel is a spot of ground between 2
/// and 20 m away within 60 degrees of view, shaded by a low sun in the west; rocks are dark. The ground has a
/// site. The pixels are grey, by rows from the top.
std::vector<std::uint8_t> render_preview(const world::Ground&, const world::Pose& from, double noise_share,
                                         world::RandomStream&);

}  // namespace roci::sim::components
