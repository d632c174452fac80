// The drive model gives time and energy of driving, by slope, friction and slip.
#pragma once

#include <algorithm>
#include <cmath>

namespace roci::pathplan {

/// Says what a metre of map (measured horizontally) costs.
struct Pace {
  double time = 0;    ///< s / m
  double energy = 0;  ///< J / m, from the battery
};

/// Computes time and energy of driving by a quasi-static model.
///
/// The energy follows the force along the slope, m g (mu cos a + sin a), and braking gives nothing back (Rowe
/// and Ross, "Optimal grid-free path planning across arbitrarily contoured terrain with anisotropic friction
/// and gravity effects", IEEE Trans. Robotics and Automation 6(5), 1990). Per horizontal metre that is m g
/// max(0, mu + grade). Wheels that slip by s turn 1 / (1 - s) times as far. To this the electronics add their
/// power for the time it takes.
///
/// The speed is nominal on level smooth ground; uphill, slip takes its share, growing in proportion to the
/// grade (a straight line through what Heverly et al., "Traverse performance characterization for the Mars
/// Science Laboratory rover", J. Field Robotics 30(6), 2013, show to grow with slope); rough ground is driven
/// more slowly, in proportion. Changes of direction are turns on the spot. The figures below are a 180 kg
/// rover of this project, not of these papers.
struct DriveModel {
  double speed = 0.10;          ///< m/s on level smooth ground, > 0
  double slip_per_grade = 0.8;  ///< share of wheel travel lost per unit of uphill grade (tangent)
  double max_slip = 0.6;        ///< 0 … 1, not included
  /// Holds the share of the speed lost on the roughest ground allowed, 0 … 1, not included.
  double rough_slowdown = 0.5;
  double turn_rate = 0.10;           ///< rad/s on the spot, > 0
  double mass = 180;                 ///< kg
  double gravity = 3.71;             ///< m/s²
  double rolling_resistance = 0.20;  ///< mu above
  double drive_efficiency = 0.5;     ///< mechanical work per electrical, 0 … 1, not 0
  double idle_power = 40;            ///< W, electronics while under way
  double turn_power = 60;            ///< W, drives and steering while turning, on top of idle_power

  /// Returns the pace. `grade` is the rise per horizontal metre along the direction of travel; `roughness`
  /// goes from 0 for smooth to 1 for the roughest allowed.
  Pace pace(double grade, double roughness) const;

  /// Returns the time of the pace alone.
  double seconds_per_metre(double grade, double roughness) const {
    const double slip = std::min(max_slip, slip_per_grade * std::max(0.0, grade));
    const double ground_speed = speed * (1 - slip) * (1 - rough_slowdown * roughness);
    return std::sqrt(1 + grade * grade) / ground_speed;
  }

  /// These return seconds and joules of a turn on the spot by `angle` radians, of either sign.
  double turn_time(double angle) const;
  double turn_energy(double angle) const;

  /// Returns the seconds per metre that no ground is driven faster than.
  double fastest() const { return 1 / speed; }
  /// Returns joules per metre that ground of this slope and roughness takes at least, whatever the direction: all
  /// of the slope helps, and nothing slips.
  double least_energy(double slope, double roughness) const;
};

}  // namespace roci::pathplan
