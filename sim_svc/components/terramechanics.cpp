#include "sim_svc/components/terramechanics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roci::sim::components {
namespace {

constexpr int kHalvings = 40;  // of the slip, below a billionth

// Returns the share of the soil's shear strength that a slipping wheel brings up.
double mobilized(double slip, double arc_m, double shear_m) {
  const double x = slip * arc_m / shear_m;
  return x < 1e-9 ? 0 : 1 + std::expm1(-x) / x;
}

}  // namespace

Footing footing(const world::Soil& soil, const WheeledVehicle& vehicle, double pitch, double slope) {
  Footing out;
  const double n = soil.exponent;
  const double b = vehicle.wheel_width_m;
  const double diameter = vehicle.wheel_diameter_m;
  const double load = vehicle.weight_n * std::cos(slope) / vehicle.wheels;
  const double k = soil.cohesive_modulus + b * soil.frictional_modulus;
  const double sinkage = std::pow(3 * load / ((3 - n) * k * std::sqrt(diameter)), 2 / (2 * n + 1));
  out.sinkage_m = std::min(sinkage, diameter / 2);
  const double resistance = k * std::pow(out.sinkage_m, n + 1) / (n + 1);
  out.resistance_n = resistance * vehicle.wheels;
  const double arc = diameter / 2 * std::acos(1 - 2 * out.sinkage_m / diameter);
  const double strength =
      b * arc * soil.cohesion_pa + load * std::tan(soil.friction_deg * std::numbers::pi / 180);
  const double needed = resistance + vehicle.weight_n * std::sin(pitch) / vehicle.wheels;
  out.traction_share = std::max(0.0, needed / strength);
  out.bears = sinkage < diameter / 2 && out.traction_share < mobilized(kMostSoilSlip, arc, soil.shear_m);
  if (!out.bears) {
    out.slip = 1;
    return out;
  }
  double low = 0, high = kMostSoilSlip;
  for (int i = 0; i < kHalvings && out.traction_share > 0; ++i) {
    out.slip = (low + high) / 2;
    (mobilized(out.slip, arc, soil.shear_m) < out.traction_share ? low : high) = out.slip;
  }
  return out;
}

}  // namespace roci::sim::components
