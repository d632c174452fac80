#include "sim_svc/robot_file.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace roci::sim {
namespace {

using mission::Entry;

struct Number {
  std::string_view key;
  double* value;
  double least = 0;
};

struct Text {
  std::string_view key;
  std::string* value;
};

void read_section(const Entry& simulation, std::string_view section, const std::vector<Number>& numbers,
                  const std::vector<Text>& texts = {}) {
  const auto entry = simulation.find(section);
  if (!entry) return;
  for (const auto& [key, value] : entry->fields()) {
    const auto number =
        std::find_if(numbers.begin(), numbers.end(), [&](const Number& n) { return n.key == key; });
    const auto text = std::find_if(texts.begin(), texts.end(), [&](const Text& t) { return t.key == key; });
    if (number != numbers.end()) {
      *number->value = value.number();
      if (*number->value < number->least) {
        value.fail("'" + key + "' must be at least " + std::to_string(number->least) +
                   "; correct the number");
      }
    } else if (text != texts.end()) {
      *text->value = value.text();
    } else {
      std::string known;
      for (const Number& n : numbers) known += (known.empty() ? "" : ", ") + std::string(n.key);
      for (const Text& t : texts) known += (known.empty() ? "" : ", ") + std::string(t.key);
      value.fail("unknown key '" + key + "'; known here: " + known);
    }
  }
}

constexpr double kPositive = 1e-3;  // for what is divided by or would never end

}  // namespace

RobotParameters read_robot(const Entry& simulation) {
  simulation.allow_only({"drive", "arm", "camera", "gripper", "radio", "power", "telemetry", "names"});
  RobotParameters out;
  auto& drive = out.drive;
  read_section(simulation, "drive",
               {{"radius_m", &drive.radius_m},
                {"wheel_speed_m_s", &drive.wheel_speed_m_s, kPositive},
                {"turn_rate_rad_s", &drive.turn_rate_rad_s, kPositive},
                {"slip", &drive.slip},
                {"uphill_slip", &drive.uphill_slip},
                {"slip_noise", &drive.slip_noise},
                {"slope_slowdown", &drive.slope_slowdown},
                {"heading_noise", &drive.heading_noise},
                {"max_slope_deg", &drive.max_slope_deg, 1},
                {"rock_sight_m", &drive.rock_sight_m},
                {"detours", &drive.detours},
                {"look_s", &drive.look_s, kPositive},
                {"weight_n", &drive.weight_n},
                {"rolling_resistance", &drive.rolling_resistance},
                {"drive_efficiency", &drive.drive_efficiency, kPositive},
                {"drive_electronics_w", &drive.drive_electronics_w},
                {"turn_power_w", &drive.turn_power_w}});
  auto& arm = out.arm;
  read_section(simulation, "arm",
               {{"joint_lag_s", &arm.joint_lag_s, kPositive},
                {"speed_noise", &arm.speed_noise},
                {"settled_rad", &arm.settled_rad, 1e-6},
                {"base_power_w", &arm.base_power_w},
                {"power_per_speed_w", &arm.power_per_speed_w}});
  auto& camera = out.camera;
  read_section(simulation, "camera",
               {{"duration_s", &camera.duration_s},
                {"duration_noise", &camera.duration_noise},
                {"power_w", &camera.power_w},
                {"image_bytes", &camera.image_bytes},
                {"bytes_noise", &camera.bytes_noise},
                {"image_noise", &camera.image_noise}});
  auto& gripper = out.gripper;
  read_section(simulation, "gripper",
               {{"pick_s", &gripper.pick_s},
                {"drop_s", &gripper.drop_s},
                {"duration_noise", &gripper.duration_noise},
                {"power_w", &gripper.power_w}});
  auto& radio = out.radio;
  read_section(
      simulation, "radio",
      {{"rate_bit_s", &radio.rate_bit_s, 1}, {"rate_noise", &radio.rate_noise}, {"power_w", &radio.power_w}},
      {{"window", &radio.window}});
  auto& power = out.power;
  read_section(simulation, "power",
               {{"capacity_j", &power.capacity_j, 1},
                {"idle_w", &power.idle_w},
                {"solar_peak_w", &power.solar_peak_w},
                {"solar_noon_s", &power.solar_noon_s},
                {"day_s", &power.day_s, 1}});
  auto& telemetry = out.telemetry;
  read_section(simulation, "telemetry",
               {{"moving_s", &telemetry.moving_s, 0.1}, {"idle_s", &telemetry.idle_s, 0.1}});
  auto& names = out.names;
  read_section(simulation, "names", {},
               {{"stop_place", &names.stop_place},
                {"stop_pose", &names.stop_pose},
                {"stow_pose", &names.stow_pose},
                {"pick_pose", &names.pick_pose},
                {"drop_pose", &names.drop_pose}});
  return out;
}

}  // namespace roci::sim
