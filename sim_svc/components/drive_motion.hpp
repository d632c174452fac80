// This file says how the simulated wheels move over the true ground, step by step.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/components/soil_sensor.hpp"
#include "sim_svc/components/terramechanics.hpp"
#include "sim_svc/world/environment.hpp"
#include "sim_svc/world/random_stream.hpp"
#include "sim_svc/world/values.hpp"

namespace roci::sim::components {

/// Holds the true wheels and ground, which the estimators' models only resemble.
struct DriveParameters {
  double radius_m = 0.6;           ///< radius of the disc that the rover covers
  double wheel_speed_m_s = 0.105;  ///< on flat ground, before slip
  double turn_rate_rad_s = 0.19;
  double slip = 0.04;           ///< mean on flat ground, as a share of the wheel speed
  double uphill_slip = 2.5;     ///< added slip is this times sin²(pitch)
  double slip_noise = 0.35;     ///< standard deviation as a share of the mean
  double slope_slowdown = 0.3;  ///< the wheels turn slower by this times sin(slope)
  double heading_noise = 0.01;  ///< rad per square root of a second
  double max_slope_deg = 30;    ///< steeper ground holds the rover fast
  double rock_sight_m = 3;      ///< a rock on the way is seen this far ahead of the rover's edge
  double weight_n = 560;
  double rolling_resistance = 0.2;
  double drive_efficiency = 0.35;
  double drive_electronics_w = 28;
  double turn_power_w = 55;
  double wheels = 0;              ///< how many; 0: it feels no soil
  double wheel_width_m = 0.1;     ///< above 0
  double wheel_diameter_m = 0.3;  ///< above 0
};

/// Returns the parameters that count on soft soil.
inline WheeledVehicle vehicle_of(const DriveParameters& p) {
  return {p.weight_n, p.wheels, p.wheel_width_m, p.wheel_diameter_m};
}

/// Says how a drive ended: `bogged` if soil did not bear the body, which dug itself in; `no_go` if its sensor
/// says that another vehicle must not follow.
enum class DriveEnd { arrived, blocked, stuck, collision, bogged, no_go };

/// Holds where the body is at one time of a drive.
struct DriveSample {
  world::Pose pose;
  double energy_j = 0;            ///< used since the start of the drive
  std::size_t next_waypoint = 0;  ///< index into the way-points
};

/// Describes a whole drive as it happens if nobody interrupts it. Sample i holds at start + i * kDriveStep;
/// the last one at `end`.
struct DriveTrace {
  temporal::Time start{};
  temporal::Time end{};
  std::vector<DriveSample> samples;
  DriveEnd outcome = DriveEnd::arrived;
  std::optional<std::size_t> seen_rock;  ///< with `blocked`: index into Ground::hidden_rocks
  double peak_power_w = 0;
  double deepest_sinkage_m = 0;  ///< in soil
  double most_soil_slip = 0;
  std::optional<NoGo> no_go;  ///< with `no_go`
  SoilRecord soil;            ///< of the sensor

  /// Interpolates linearly between two samples. Before the start it is the first, after the end the last
  /// sample.
  DriveSample at(temporal::Time) const;
};

inline constexpr temporal::Duration kDriveStep{100000};

/// Integrates the rover along the way-points: point turns, speed by slope, slip by pitch and noise, drift of
/// the heading, electrical energy. In soil that bears it, a body with wheels slips and pushes by its footing
/// (terramechanics.hpp) on top; where it does not, the wheels spin in place. `sensor` may be null. The ground has a
/// site; `way` has at least one point; `first` is the index of the one it heads for.
DriveTrace simulate_drive(const world::Ground&, const DriveParameters&, temporal::Time start,
                          const world::Pose& from, const std::vector<terrain::Point>& way, std::size_t first,
                          world::RandomStream& noise, SoilSensor* sensor = nullptr);

/// Integrates a turn in place until the body heads for the point: at its turn rate, with the drift of the heading over
/// that time. It ends `arrived`.
DriveTrace simulate_turn(const DriveParameters&, temporal::Time start, const world::Pose& from,
                         terrain::Point towards, world::RandomStream& noise);

}  // namespace roci::sim::components
