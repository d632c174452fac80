#pragma once
#include "sim_svc/parameters.hpp"
#include "sim_svc/values.hpp"

namespace roci::sim {

/// Power of the panel, W: the positive half of a cosine over the day.
double solar_power_w(const PowerParameters&, Time);

/// An ideal store between 0 and its capacity.
class Battery {
 public:
  Battery(double energy_j, double capacity_j);
  double energy_j() const { return energy_j_; }
  /// Adds (or, negative, takes) energy; what does not fit is lost.
  void add(double joules);
  /// True from the moment the store is empty until it holds a hundredth of its capacity again.
  bool flat() const { return flat_; }

 private:
  double energy_j_;
  double capacity_j_;
  bool flat_ = false;
};

}  // namespace roci::sim
