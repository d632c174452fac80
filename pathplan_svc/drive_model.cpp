#include "pathplan_svc/drive_model.hpp"

#include <algorithm>
#include <cmath>

namespace roci::pathplan {

Pace DriveModel::pace(double grade, double roughness) const {
  const double slip = std::min(max_slip, slip_per_grade * std::max(0.0, grade));
  const double seconds = seconds_per_metre(grade, roughness);
  const double work = mass * gravity * std::max(0.0, rolling_resistance + grade) / (1 - slip);
  return {seconds, work / drive_efficiency + idle_power * seconds};
}

double DriveModel::least_energy(double slope, double roughness) const {
  const double seconds = 1 / (speed * (1 - rough_slowdown * roughness));
  return mass * gravity * std::max(0.0, rolling_resistance - slope) / drive_efficiency + idle_power * seconds;
}

double DriveModel::turn_time(double angle) const { return std::abs(angle) / turn_rate; }

double DriveModel::turn_energy(double angle) const { return turn_time(angle) * (idle_power + turn_power); }

}  // namespace roci::pathplan
