#include "sim_svc/components/preview.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roci::sim::components {

using world::Ground;
using world::Pose;
using world::RandomStream;
using world::Rock;

namespace {

constexpr double kNearest = 2;
constexpr double kFarthest = 20;
constexpr double kFieldOfView = std::numbers::pi / 3;
constexpr double kSunElevation = 0.5;  // rad, in the west

// Returns the light by Lambert's law for the ground's normal (-east, -north, 1).
double lit(const terrain::Gradient& gradient) {
  const double facing = std::sin(kSunElevation) + gradient.east * std::cos(kSunElevation);
  return std::max(0.0,
                  facing / std::sqrt(1 + gradient.east * gradient.east + gradient.north * gradient.north));
}

bool on_rock(const Ground& ground, terrain::Point p) {
  if (ground.site->rock_height(p) > 0) return true;
  return std::any_of(ground.hidden_rocks.begin(), ground.hidden_rocks.end(), [&](const Rock& rock) {
    return terrain::distance(p, {rock.x, rock.y}) < rock.radius;
  });
}

}  // namespace

std::vector<std::uint8_t> render_preview(const Ground& ground, const Pose& from, double noise_share,
                                         RandomStream& noise) {
  std::vector<std::uint8_t> out;
  out.reserve(static_cast<std::size_t>(kPreviewWidth) * kPreviewHeight);
  for (int row = 0; row < kPreviewHeight; ++row) {
    const double depth = (kPreviewHeight - 1 - row) / static_cast<double>(kPreviewHeight - 1);
    const double range = kNearest * std::pow(kFarthest / kNearest, depth);
    for (int column = 0; column < kPreviewWidth; ++column) {
      const double side = 0.5 - (column + 0.5) / kPreviewWidth;
      const double bearing = from.heading + side * kFieldOfView;
      const terrain::Point p{from.x + range * std::cos(bearing), from.y + range * std::sin(bearing)};
      const double shade = (on_rock(ground, p) ? 0.3 : 1.0) * lit(ground.site->gradient(p));
      const double grey = 255 * std::clamp(shade + noise_share * noise.normal(), 0.0, 1.0);
      out.push_back(static_cast<std::uint8_t>(grey));
    }
  }
  return out;
}

}  // namespace roci::sim::components
