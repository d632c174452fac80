#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace roci::sim {

/// The true robot, which the estimators' models only resemble. Read from the section `simulation` of
/// mission.yaml; a scenario's section `world` may override the drive's slip and the camera's noise.
struct DriveParameters {
  double radius_m = 0.6;           ///< of the disc that the rover covers
  double wheel_speed_m_s = 0.105;  ///< on flat ground, before slip
  double turn_rate_rad_s = 0.19;
  double slip = 0.04;           ///< mean on flat ground, as a share of the wheel speed
  double uphill_slip = 2.5;     ///< added slip is this times sin²(pitch)
  double slip_noise = 0.35;     ///< standard deviation as a share of the mean
  double slope_slowdown = 0.3;  ///< the wheels turn slower by this times sin(slope)
  double heading_noise = 0.01;  ///< rad per square root of a second
  double max_slope_deg = 30;    ///< steeper ground holds the rover fast
  double rock_sight_m = 3;      ///< a rock on the way is seen this far ahead of the rover's edge
  double detours = 0;           ///< rocks that one drive looks at and asks a way around, before it gives up
  double look_s = 20;           ///< a look at such a rock takes this long
  double weight_n = 560;
  double rolling_resistance = 0.2;
  double drive_efficiency = 0.35;
  double drive_electronics_w = 28;
  double turn_power_w = 55;
};

struct ArmParameters {
  double joint_lag_s = 0.25;
  double speed_noise = 0.03;  ///< standard deviation of the speed of a whole motion, as a share of it
  double settled_rad = 0.005;
  double base_power_w = 12;
  double power_per_speed_w = 25;  ///< per rad/s, summed over the joints
};

struct CameraParameters {
  double duration_s = 38.5;
  double duration_noise = 0.02;
  double power_w = 15;
  double image_bytes = 1400000;
  double bytes_noise = 0.03;
  double image_noise = 0.02;  ///< standard deviation of a pixel, as a share of white
};

struct GripperParameters {
  double pick_s = 58;
  double drop_s = 29;
  double duration_noise = 0.03;
  double power_w = 15;
};

struct RadioParameters {
  double rate_bit_s = 98000;
  double rate_noise = 0.02;
  double power_w = 25;
  std::string window = "comm.window";  ///< timeline that says when the other side is in view
};

struct PowerParameters {
  double capacity_j = 1000000;
  double idle_w = 14;
  double solar_peak_w = 0;      ///< 0: no panel
  double solar_noon_s = 21600;  ///< mission time of the highest sun
  double day_s = 88775;         ///< a Martian one
};

struct TelemetryParameters {
  double moving_s = 10;  ///< numbers are reported this often while something moves
  double idle_s = 60;
};

/// Names of the mission's vocabulary that the robot itself must know.
struct RobotNames {
  std::string stop_place = "here";     ///< where the rover stands after a stop on the way
  std::string stop_pose = "arm-here";  ///< the arm's pose after a stop on the way
  std::string stow_pose = "stow";      ///< the only pose in which the rover drives
  std::string pick_pose = "sampling";
  std::string drop_pose = "deposit";
};

struct RobotParameters {
  DriveParameters drive;
  ArmParameters arm;
  CameraParameters camera;
  GripperParameters gripper;
  RadioParameters radio;
  PowerParameters power;
  TelemetryParameters telemetry;
  RobotNames names;
};

}  // namespace roci::sim
