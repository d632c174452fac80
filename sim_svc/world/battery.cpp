#include "sim_svc/world/battery.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roci::sim::world {

double told_j(const Gauge& gauge, double energy_j) {
  if (energy_j >= gauge.below_j) return energy_j;
  return std::max(0.0, gauge.below_j - gauge.factor * (gauge.below_j - energy_j));
}

bool has_panel(const PowerParameters& parameters) {
  return parameters.orbit ? parameters.orbit->solar_w > 0 : parameters.solar_peak_w > 0;
}

double solar_power_w(const PowerParameters& parameters, temporal::Time t) {
  const double angle =
      2 * std::numbers::pi * (temporal::to_seconds(t) - parameters.solar_noon_s) / parameters.day_s;
  return parameters.solar_peak_w * std::max(0.0, std::cos(angle));
}

namespace {

// Returns how many seconds of eclipse lie before the time.
double shadow_s(const Orbit& orbit, temporal::Time t) {
  const double since = temporal::to_seconds(t) - orbit.first_eclipse_s;
  if (since <= 0) return 0;
  const double orbits = std::floor(since / orbit.orbit_s);
  return orbits * orbit.eclipse_s + std::min(orbit.eclipse_s, since - orbits * orbit.orbit_s);
}

}  // namespace

double sunlit_s(const Orbit& orbit, temporal::Time from, temporal::Time to) {
  return temporal::to_seconds(to - from) - (shadow_s(orbit, to) - shadow_s(orbit, from));
}

std::vector<std::pair<temporal::Time, temporal::Time>> sunlight(const Orbit& orbit, temporal::Time end) {
  std::vector<std::pair<temporal::Time, temporal::Time>> out;
  temporal::Time opens{};
  for (double eclipse = orbit.first_eclipse_s; opens < end; eclipse += orbit.orbit_s) {
    const temporal::Time closes = temporal::seconds(eclipse);
    if (closes > opens) out.emplace_back(opens, closes);
    opens = temporal::seconds(eclipse + orbit.eclipse_s);
  }
  return out;
}

double solar_energy_j(const PowerParameters& parameters, temporal::Time from, temporal::Time to) {
  if (parameters.orbit) return parameters.orbit->solar_w * sunlit_s(*parameters.orbit, from, to);
  return solar_power_w(parameters, from + (to - from) / 2) * temporal::to_seconds(to - from);
}

Battery::Battery(double energy_j, double capacity_j) : energy_j_(0), capacity_j_(capacity_j) {
  add(energy_j);
}

void Battery::add(double joules) {
  energy_j_ = std::clamp(energy_j_ + joules, 0.0, capacity_j_);
  flat_ = flat_ ? energy_j_ < 0.01 * capacity_j_ : energy_j_ <= 0;
}

}  // namespace roci::sim::world
