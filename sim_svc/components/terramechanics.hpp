// Terramechanics says what loose soil does to a vehicle on rigid wheels: how deep it sinks, what it must push,
// how much it slips.
#pragma once
#include "sim_svc/world/soil.hpp"

namespace roci::sim::components {

/// Holds what of a vehicle counts on soft soil. The weight is borne by all wheels alike.
struct WheeledVehicle {
  double weight_n = 0;
  double wheels = 0;            ///< how many; 0: it is not known, and no soil is felt
  double wheel_width_m = 0;     ///< above 0
  double wheel_diameter_m = 0;  ///< above 0
};

/// Says how a vehicle fares on a soil in steady motion.
struct Footing {
  double sinkage_m = 0;       ///< of a wheel; no more than its radius
  double resistance_n = 0;    ///< of all wheels together, from compacting the soil
  double traction_share = 0;  ///< what is needed of the thrust that the soil can bear at full slip
  double slip = 0;  ///< 0 … 1, at which the thrust balances resistance and grade; 1 where it does not bear
  bool bears = true;  ///< false: it sinks to its axles, or the soil gives less thrust than is needed
};

/// Gives the largest slip at which a wheel still makes way.
inline constexpr double kMostSoilSlip = 0.95;

/// Computes the footing by Bekker's formulas for a rigid wheel, as in Wong, "Theory of Ground Vehicles", 4th ed.
/// (2008), chapter 2. With b, D and W width, diameter and load of a wheel and k = k_c + b k_phi:
///
///   sinkage     z = (3 W / ((3 - n) k √D))^(2 / (2 n + 1))
///   resistance  R = k z^(n + 1) / (n + 1)
///   thrust      H(s) = (b l c + W tan φ) (1 - K / (s l) (1 - exp(-s l / K))), l the arc of the wheel in the soil
///
/// The slip s solves H(s) = R + W sin(pitch), by bisection; downhill it is 0 where nothing needs to be pushed. Slip
/// does not deepen the sinkage here, nor does a wheel profit from the rut of the one before.
/// `pitch` is the climb in the direction of travel and `slope` that of the ground, in rad.
Footing footing(const world::Soil&, const WheeledVehicle&, double pitch, double slope);

}  // namespace roci::sim::components
