#include "sim_svc/components/preview.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "core/terrain/pgm.hpp"
#include "sim_svc/components/relief.hpp"

namespace roci::sim::components {

using terrain::Point;
using world::Direction;
using world::Ground;
using world::Pose;
using world::RandomStream;

namespace {

constexpr double kFarthest = 60;    // m, beyond which all is sky
constexpr double kNearest = 0.3;    // m
constexpr double kStride = 0.016;   // of a ray, as a share of how far it has come
constexpr double kSkyLight = 0.16;  // of the sky, as a share of the sun's
constexpr double kStarLight = 0.002;
constexpr double kMiddleGrey = 0.46;  // of flat soil
constexpr double kMostGain = 40;
constexpr double kHaze = 220;       // m, after which a third of the contrast is left
constexpr double kShadowReach = 3;  // m

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

class Renderer {
 public:
  Renderer(const Ground& ground, const Pose& from, const View& view, temporal::Time at)
      : relief_(ground, {from.x, from.y}, kFarthest),
        from_(from),
        view_(view),
        sun_(world::toward(ground.surface.sun, at)) {
    eye_ = relief_.floor({from.x, from.y}) + view.mast_m;
    focal_ = view.width_px / 2.0 / std::tan(radians(view.view_deg) / 2);
    direct_ = sun_.up > 0 ? 1 : 0;
    ambient_ = kStarLight + kSkyLight * std::clamp(0.3 + 2 * sun_.up, 0.0, 1.0);
    const double flat = kSoilAlbedo * (ambient_ + direct_ * std::max(0.08, sun_.up));
    gain_ = std::min(kMostGain, kMiddleGrey / flat);
  }

  // Returns the light of a column's pixels, from the bottom up. A ray goes on where the one below it has hit, since
  // what hides the ground from the lower one lies nearer.
  std::vector<double> column(int index) const {
    std::vector<double> out;
    double start = kNearest;
    for (int row = view_.height_px - 1; row >= 0; --row) {
      const Direction ray = through(index, row);
      const double level = std::hypot(ray.east, ray.north);
      const auto hit = march(ray, level, start);
      if (hit) start = std::max(kNearest, 0.985 * *hit);
      out.push_back(hit ? ground(ray, level, *hit) : sky(ray));
    }
    return out;
  }

 private:
  // Returns the direction through the middle of a pixel.
  Direction through(int column, int row) const {
    const double right = (column + 0.5 - view_.width_px / 2.0) / focal_;
    const double down = (row + 0.5 - view_.height_px / 2.0) / focal_;
    const double tilt = radians(view_.tilt_deg);
    const double ahead = std::cos(tilt) - down * std::sin(tilt);
    const double up = -std::sin(tilt) - down * std::cos(tilt);
    const double length = std::sqrt(1 + right * right + down * down);
    const double c = std::cos(from_.heading), s = std::sin(from_.heading);
    return {(ahead * c + right * s) / length, (ahead * s - right * c) / length, up / length};
  }

  Point at(const Direction& ray, double level, double range) const {
    return {from_.x + ray.east / level * range, from_.y + ray.north / level * range};
  }

  bool below_ground(const Direction& ray, double level, double range) const {
    const Point p = at(ray, level, range);
    const double z = eye_ + ray.up / level * range;
    return z <= relief_.floor(p) + relief_.tallest() && z <= relief_.height(p);
  }

  // Returns how far away, along the ground, the ray meets it.
  std::optional<double> march(const Direction& ray, double level, double start) const {
    if (level < 1e-6) return kNearest;
    double last = start;
    for (double range = start; range <= kFarthest; range += std::max(0.02, kStride * range)) {
      if (!below_ground(ray, level, range)) {
        last = range;
        continue;
      }
      double above = last, below = range;
      for (int i = 0; i < 5; ++i) {
        const double middle = (above + below) / 2;
        (below_ground(ray, level, middle) ? below : above) = middle;
      }
      return below;
    }
    return std::nullopt;
  }

  bool in_shadow(Point p, double z) const {
    const double level = std::hypot(sun_.east, sun_.north);
    if (level < 1e-6) return false;
    const double climb = sun_.up / level;
    for (double far = 0.04; far < kShadowReach; far *= 1.45) {
      const double light = z + 0.01 + far * climb;
      const Point q{p.x + sun_.east / level * far, p.y + sun_.north / level * far};
      if (light > relief_.floor(q) + relief_.tallest()) return false;
      if (light < relief_.height(q)) return true;
    }
    return false;
  }

  double sky(const Direction& ray) const {
    const double day = std::clamp(0.1 + 3 * sun_.up, 0.0, 1.0);
    return std::clamp(0.8 - 0.5 * std::max(0.0, ray.up), 0.0, 1.0) * day;
  }

  double ground(const Direction& ray, double level, double range) const {
    const Point p = at(ray, level, range);
    const double slant = std::max(0.08, -ray.up / std::hypot(ray.up, level));
    const double footprint = range / focal_ / std::sqrt(slant);
    const Relief::Spot spot = relief_.spot(p, footprint);
    const double length =
        std::sqrt(1 + spot.slope.east * spot.slope.east + spot.slope.north * spot.slope.north);
    double facing = (sun_.up - spot.slope.east * sun_.east - spot.slope.north * sun_.north) / length;
    if (direct_ <= 0 || facing <= 0 || in_shadow(p, relief_.height(p))) facing = 0;
    const double light = gain_ * spot.albedo * (ambient_ + direct_ * facing);
    const double clear = std::exp(-range / kHaze);
    return light * clear + sky({0, 0, 0}) * (1 - clear);
  }

  Relief relief_;
  const Pose& from_;
  const View& view_;
  Direction sun_;
  double eye_ = 0;
  double focal_ = 1;
  double direct_ = 1;
  double ambient_ = 0;
  double gain_ = 1;
};

}  // namespace

std::vector<std::uint8_t> render_preview(const Ground& ground, const Pose& from, const View& view,
                                         temporal::Time at, RandomStream noise) {
  const Renderer renderer(ground, from, view, at);
  terrain::GreyImage image{view.width_px, view.height_px, 255, {}};
  image.pixels.resize(static_cast<std::size_t>(view.width_px) * static_cast<std::size_t>(view.height_px));
  for (int column = 0; column < view.width_px; ++column) {
    const std::vector<double> light = renderer.column(column);
    for (int up = 0; up < view.height_px; ++up) {
      const double grey = light[static_cast<std::size_t>(up)] + view.noise * noise.normal();
      const auto index =
          static_cast<std::size_t>(view.height_px - 1 - up) * static_cast<std::size_t>(view.width_px) +
          static_cast<std::size_t>(column);
      image.pixels[index] = static_cast<std::uint16_t>(std::lround(255 * std::clamp(grey, 0.0, 1.0)));
    }
  }
  const std::string file = terrain::to_pgm(image, "");
  return {file.begin(), file.end()};
}

}  // namespace roci::sim::components
