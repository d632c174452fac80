#include "sim_svc/components/drive_settings.hpp"

namespace roci::sim::components {
namespace {

using mission::Entry;

constexpr double kPositive = 1e-3;  // for what is divided by or would never end

double above_zero(const Entry& section, std::string_view key, double fallback) {
  return setup::number(section, key, fallback, kPositive);
}

SoilInstrument read_instrument(const Entry& entry) {
  entry.allow_only({"name", "ahead_m", "beside_m", "every_m", "noise", "shears"});
  SoilInstrument out;
  out.name = entry.at("name").text();
  out.ahead_m = entry.number_or("ahead_m", out.ahead_m);
  out.beside_m = entry.number_or("beside_m", out.beside_m);
  out.every_m = above_zero(entry, "every_m", out.every_m);
  out.noise = setup::number(entry, "noise", out.noise);
  out.shears = entry.truth_or("shears", out.shears);
  return out;
}

WheeledVehicle read_vehicle(const Entry& entry) {
  entry.allow_only({"name", "weight_n", "wheels", "wheel_width_m", "wheel_diameter_m"});
  WheeledVehicle out;
  for (const auto& [key, value] : {std::pair{"weight_n", &out.weight_n}, std::pair{"wheels", &out.wheels},
                                   std::pair{"wheel_width_m", &out.wheel_width_m},
                                   std::pair{"wheel_diameter_m", &out.wheel_diameter_m}}) {
    entry.at(key);  // there are no defaults for somebody else's vehicle
    *value = above_zero(entry, key, 0);
  }
  return out;
}

SoilSensorSettings read_soil_sensor(const Entry& entry) {
  entry.allow_only(
      {"for", "instruments", "believed", "most_sinkage_share", "most_traction_share", "mark_radius_m"});
  SoilSensorSettings out;
  const Entry vehicle = entry.at("for");
  out.vehicle = read_vehicle(vehicle);
  out.judges_for = vehicle.text_or("name", "the vehicle");
  entry.at("instruments").each([&](const Entry& one) { out.instruments.push_back(read_instrument(one)); });
  if (out.instruments.empty())
    entry.at("instruments").fail("the sensor has no instrument; name one, or drop soil_sensor");
  if (const auto believed = entry.find("believed")) {
    believed->allow_only({"cohesion_pa", "friction_deg", "shear_m"});
    out.believed.cohesion_pa = setup::number(*believed, "cohesion_pa", out.believed.cohesion_pa);
    out.believed.friction_deg = setup::number(*believed, "friction_deg", out.believed.friction_deg, 1);
    out.believed.shear_m = above_zero(*believed, "shear_m", out.believed.shear_m);
  }
  out.most_sinkage_share = above_zero(entry, "most_sinkage_share", out.most_sinkage_share);
  out.most_traction_share = above_zero(entry, "most_traction_share", out.most_traction_share);
  out.mark_radius_m = above_zero(entry, "mark_radius_m", out.mark_radius_m);
  return out;
}

}  // namespace

DriveSettings read_drive_settings(setup::Settings& in) {
  DriveSettings out;
  DriveParameters& p = out.motion;
  p.radius_m = in.number("radius_m", p.radius_m);
  p.wheel_speed_m_s = in.number("wheel_speed_m_s", p.wheel_speed_m_s, kPositive);
  p.turn_rate_rad_s = in.number("turn_rate_rad_s", p.turn_rate_rad_s, kPositive);
  p.slip = in.number("slip", p.slip);
  p.uphill_slip = in.number("uphill_slip", p.uphill_slip);
  p.slip_noise = in.number("slip_noise", p.slip_noise);
  p.slope_slowdown = in.number("slope_slowdown", p.slope_slowdown);
  p.heading_noise = in.number("heading_noise", p.heading_noise);
  p.max_slope_deg = in.number("max_slope_deg", p.max_slope_deg, 1);
  p.rock_sight_m = in.number("rock_sight_m", p.rock_sight_m);
  p.weight_n = in.number("weight_n", p.weight_n);
  p.rolling_resistance = in.number("rolling_resistance", p.rolling_resistance);
  p.drive_efficiency = in.number("drive_efficiency", p.drive_efficiency, kPositive);
  p.drive_electronics_w = in.number("drive_electronics_w", p.drive_electronics_w);
  p.turn_power_w = in.number("turn_power_w", p.turn_power_w);
  p.wheels = in.number("wheels", p.wheels);
  p.wheel_width_m = in.number("wheel_width_m", p.wheel_width_m, kPositive);
  p.wheel_diameter_m = in.number("wheel_diameter_m", p.wheel_diameter_m, kPositive);
  if (const auto sensor = in.find("soil_sensor")) out.soil_sensor = read_soil_sensor(*sensor);
  out.detours = in.number("detours", out.detours);
  out.look_s = in.number("look_s", out.look_s, kPositive);
  if (const auto own = in.find("own_map")) out.own_map = own->truth();
  out.planner = in.text("planner", out.planner);
  out.stop_place = in.text("stop_place", out.stop_place);
  return out;
}

}  // namespace roci::sim::components
