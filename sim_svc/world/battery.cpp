#include "sim_svc/world/battery.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roci::sim::world {

double solar_power_w(const PowerParameters& parameters, temporal::Time t) {
  const double angle =
      2 * std::numbers::pi * (temporal::to_seconds(t) - parameters.solar_noon_s) / parameters.day_s;
  return parameters.solar_peak_w * std::max(0.0, std::cos(angle));
}

Battery::Battery(double energy_j, double capacity_j) : energy_j_(0), capacity_j_(capacity_j) {
  add(energy_j);
}

void Battery::add(double joules) {
  energy_j_ = std::clamp(energy_j_ + joules, 0.0, capacity_j_);
  flat_ = flat_ ? energy_j_ < 0.01 * capacity_j_ : energy_j_ <= 0;
}

}  // namespace roci::sim::world
