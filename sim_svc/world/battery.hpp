#pragma once
#include "core/temporal/duration.hpp"

namespace roci::sim::world {

/// Describes a robot's store of energy and what always draws from it or charges it.
struct PowerParameters {
  double capacity_j = 1000000;
  double idle_w = 14;           ///< drawn all the time
  double solar_peak_w = 0;      ///< 0: there is no panel
  double solar_noon_s = 21600;  ///< mission time of the highest sun
  double day_s = 88775;         ///< length of a day, by default a Martian one
};

/// Returns the power of the panel in W: the positive half of a cosine over the day.
double solar_power_w(const PowerParameters&, temporal::Time);

/// Is an ideal store between 0 and its capacity.
class Battery {
 public:
  Battery(double energy_j, double capacity_j);
  double energy_j() const { return energy_j_; }
  /// Adds (or, negative, takes) energy; what does not fit is lost.
  void add(double joules);
  /// Returns true from the moment the store is empty until it holds a hundredth of its capacity again.
  bool flat() const { return flat_; }

 private:
  double energy_j_;
  double capacity_j_;
  bool flat_ = false;
};

}  // namespace roci::sim::world
