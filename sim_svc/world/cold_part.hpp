// Cold parts are outside of all thermal zones, and start at the temperature of the surroundings whenever
// their work begins.
#pragma once
#include <optional>

namespace roci::sim::world {

/// Describes a part of a robot that nobody keeps warm: when its work begins it is as cold as the surroundings, its own
/// heater brings it to work_k, and holds that until the work is over.
struct ColdPart {
  double capacity_j_k = 2000;  ///< above 0
  double loss_w_k = 0.4;       ///< to the surroundings, above 0
  double heater_w = 100;       ///< above 0
  double work_k = 200;
  double usual_k = 100;  ///< surroundings for which durations and powers of its work are given
};

/// Says what the warmth of such a part asks for.
struct Warming {
  double seconds = 0;    ///< until it is at work_k
  double holding_w = 0;  ///< from then on
};

/// Returns that in such surroundings, where all losses are `loss_factor` times the part's own: with capacity C, loss k
/// and heater P the temperature follows C dT/dt = P - k (T - T0) (Newton's law of cooling with a source), so that it is
/// warm after C/k ln(P / (P - k (work_k - T0))). Returns nothing where the heater is too weak for that.
std::optional<Warming> warming(const ColdPart&, double surroundings_k, double loss_factor = 1);

}  // namespace roci::sim::world
