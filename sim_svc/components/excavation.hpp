// A trench is cut into ice as hard as rock: its depth follows from the energy that the cutter has brought
// into the ice.
#pragma once

#include <optional>
#include <vector>

#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

/// Describes the ice of one site.
struct Ice {
  /// Gives the energy that cuts a unit of its volume (Teale, "The concept of specific energy in rock
  /// drilling", 1965), in the middle.
  double specific_energy_j_m3 = 1e9;
  double layer_m = 0.01;              ///< within a layer it is equally hard
  double layer_noise = 0.1;           ///< standard deviation of the logarithm from layer to layer
  std::optional<double> deepest_m{};  ///< what lies below cannot be cut
};

/// Describes what cuts.
struct Cutter {
  double power_w = 100;   ///< at the ice, above 0
  double area_m2 = 0.03;  ///< of the trench, above 0
};

/// Models the ice below one site, layer by layer, down to the depth that a trench there is to have. Its rate of
/// cutting is power / (specific energy × area) in each layer, so that depth and time follow from each other exactly.
class IceColumn {
 public:
  /// Draws the layers down to `depth_m`, of which there are at most kMostLayers.
  IceColumn(const Ice&, double depth_m, world::RandomStream noise);
  static constexpr double kMostLayers = 10000;

  /// Returns how deep one can cut here: to the depth that is wanted, or to where the ice gives way no more.
  double bottom_m() const { return bottom_; }
  /// Returns whether the wanted depth can be reached.
  bool passable() const { return bottom_ >= wanted_; }
  /// Returns the energy that cuts a unit of volume there, in J/m³; below the last layer it is as hard as in it.
  double specific_energy_j_m3(double depth_m) const;
  /// Returns what it takes to cut from one depth down to another that is no higher.
  double cutting_s(double from_m, double to_m, const Cutter&) const;
  /// Returns how deep the trench is when it was `from_m` deep and was cut for so long; never below bottom_m().
  double depth_after(double from_m, double cutting_s, const Cutter&) const;

 private:
  // Returns the layer of the depth.
  std::size_t layer_at(double depth_m) const;

  double wanted_;
  double bottom_;
  double layer_m_;
  std::vector<double> energies_;  // J/m³ by layer
};

}  // namespace roci::sim::components
