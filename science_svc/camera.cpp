#include "science_svc/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roci::science {

using terrain::Point;

namespace {

constexpr double kStep = 0.1;  // m, along the ground

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

}  // namespace

double focal_px(const CameraModel& camera, int width) {
  return width / 2.0 / std::tan(radians(camera.view_deg) / 2);
}

std::optional<Point> ground_at(const MappedGround& ground, const CameraModel& camera, const Viewpoint& from,
                               int width, int height, double column, double row, double reach) {
  const double focal = focal_px(camera, width);
  const double right = (column - width / 2.0) / focal;
  const double down = (row - height / 2.0) / focal;
  const double tilt = radians(camera.tilt_deg);
  const double ahead = std::cos(tilt) - down * std::sin(tilt);
  const double up = -std::sin(tilt) - down * std::cos(tilt);
  const double level = std::hypot(ahead, right);
  if (level < 1e-9) return from.at;
  const double c = std::cos(from.heading), s = std::sin(from.heading);
  const double east = (ahead * c + right * s) / level, north = (ahead * s - right * c) / level,
               climb = up / level;
  const double eye = ground.elevation(from.at) + camera.mast_m;
  const auto place = [&](double range) { return Point{from.at.x + east * range, from.at.y + north * range}; };
  const auto height_above = [&](double range) {
    return eye + climb * range - ground.elevation(place(range));
  };
  double last = 0;
  for (double range = kStep; range <= reach + kStep; range += kStep) {
    if (height_above(range) > 0) {
      last = range;
      continue;
    }
    const double above = height_above(last), below = -height_above(range);
    const double hit = last + (range - last) * above / std::max(above + below, 1e-12);
    const Point out = place(hit);
    if (hit > reach || !ground.contains(out)) return std::nullopt;
    return out;
  }
  return std::nullopt;
}

}  // namespace roci::science
