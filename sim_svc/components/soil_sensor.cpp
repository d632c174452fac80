#include "sim_svc/components/soil_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roci::sim::components {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSteepestFriction = 60;  // degrees

}  // namespace

SoilSensor::SoilSensor(const SoilSensorSettings& settings, const std::vector<MarkedDisc>& known,
                       world::RandomStream& noise)
    : settings_(settings), known_(known), noise_(noise), due_m_(settings.instruments.size(), 0.0) {}

std::optional<NoGo> SoilSensor::sense(const world::Ground& ground, const world::Pose& pose, double moved_m) {
  way_m_ += moved_m;
  std::optional<NoGo> first;
  for (std::size_t i = 0; i < due_m_.size(); ++i) {
    const SoilInstrument& instrument = settings_.instruments[i];
    if (way_m_ < due_m_[i]) continue;
    due_m_[i] = (std::floor(way_m_ / instrument.every_m) + 1) * instrument.every_m;
    const double east = std::cos(pose.heading), north = std::sin(pose.heading);
    const terrain::Point at{pose.x + instrument.ahead_m * east - instrument.beside_m * north,
                            pose.y + instrument.ahead_m * north + instrument.beside_m * east};
    auto verdict = measure(instrument, ground, at);
    if (verdict && !first) first = std::move(verdict);
  }
  return first;
}

std::optional<NoGo> SoilSensor::measure(const SoilInstrument& instrument, const world::Ground& ground,
                                        terrain::Point at) {
  const world::Soil* soil = world::soil_at(ground.surface.soil, at);
  if (!soil) return std::nullopt;
  world::Soil measured = *soil;
  measured.frictional_modulus *= std::exp(instrument.noise * noise_.normal());
  const double shear = instrument.noise * noise_.normal();
  if (instrument.shears) {
    const double friction = std::atan(std::tan(soil->friction_deg * kDegree) * std::exp(shear)) / kDegree;
    measured.friction_deg = std::min(friction, kSteepestFriction);
  } else {
    measured.cohesion_pa = settings_.believed.cohesion_pa;
    measured.friction_deg = settings_.believed.friction_deg;
    measured.shear_m = settings_.believed.shear_m;
  }
  const terrain::Gradient gradient = ground.site->gradient(at);
  const double slope = std::atan(std::hypot(gradient.east, gradient.north));
  const Footing expected = footing(measured, settings_.vehicle, slope, slope);
  const double sinkage = expected.sinkage_m / settings_.vehicle.wheel_diameter_m;
  const double margin = expected.bears ? 1 - std::max(sinkage / settings_.most_sinkage_share,
                                                      expected.traction_share / settings_.most_traction_share)
                                       : 0;
  ++record_.samples;
  record_.least_margin = std::min(record_.least_margin, margin);
  const bool no_news = std::ranges::any_of(
      known_, [&](const MarkedDisc& disc) { return terrain::distance(disc.centre, at) <= disc.radius; });
  if (margin > 0 || no_news) return std::nullopt;
  return NoGo{at, instrument.name, expected};
}

}  // namespace roci::sim::components
