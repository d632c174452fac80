#include "pathplan_svc/rover_file.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>

#include "core/terrain/polygon_file.hpp"

namespace roci::pathplan {
namespace {

// Names a key, where its value goes, and the values that make sense: `above` is excluded, `most` included.
struct Key {
  std::string_view name;
  double* value;
  double above;
  double most;
};

constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kZeroToo = -1e-300;  // as `above`: zero is allowed, negative is not

void read_zone(const mission::Entry& entry, Rover& rover) {
  if (entry.is_mapping() && entry.find("polygon")) {
    rover.keep_out_polygons.push_back(terrain::read_polygon(entry));
    return;
  }
  entry.allow_only({"x", "y", "radius_m"});
  const Disc disc{{entry.at("x").number(), entry.at("y").number()}, entry.at("radius_m").number()};
  if (disc.radius < 0) entry.at("radius_m").fail("'radius_m' must not be negative");
  rover.keep_out.push_back(disc);
}

}  // namespace

Rover read_rover(const mission::Entry& section) {
  Rover rover;
  double max_slope_deg = rover.limits.max_slope / kDegree;
  const std::array keys{
      Key{"radius_m", &rover.limits.radius, 0, kAny},
      Key{"max_slope_deg", &max_slope_deg, 0, 60},
      Key{"rock_clearance_m", &rover.limits.rock_clearance, 0, kAny},
      Key{"max_roughness_m", &rover.limits.max_roughness, 0, kAny},
      Key{"max_step_m", &rover.limits.max_step, kZeroToo, kAny},
      Key{"speed_m_s", &rover.drive.speed, 0, kAny},
      Key{"slip_per_grade", &rover.drive.slip_per_grade, kZeroToo, kAny},
      Key{"max_slip", &rover.drive.max_slip, kZeroToo, 0.95},
      Key{"rough_slowdown", &rover.drive.rough_slowdown, kZeroToo, 0.95},
      Key{"turn_rate_rad_s", &rover.drive.turn_rate, 0, kAny},
      Key{"mass_kg", &rover.drive.mass, 0, kAny},
      Key{"gravity_m_s2", &rover.drive.gravity, 0, kAny},
      Key{"rolling_resistance", &rover.drive.rolling_resistance, kZeroToo, kAny},
      Key{"drive_efficiency", &rover.drive.drive_efficiency, 0, 1},
      Key{"idle_power_w", &rover.drive.idle_power, kZeroToo, kAny},
      Key{"turn_power_w", &rover.drive.turn_power, kZeroToo, kAny},
  };
  for (const auto& [name, value] : section.fields()) {
    if (name == "keep_out") {
      for (const mission::Entry& zone : value.items()) read_zone(zone, rover);
      continue;
    }
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.name == name; });
    if (key == keys.end()) {
      std::string known = "keep_out";
      for (const Key& k : keys) known += ", " + std::string(k.name);
      value.fail("unknown key '" + name + "'; known here: " + known);
    }
    *key->value = value.number();
    if (*key->value <= key->above || *key->value > key->most) {
      value.fail("'" + name + "' is out of range; correct the number");
    }
  }
  rover.limits.max_slope = max_slope_deg * kDegree;
  return rover;
}

void require_few_cells(const Rover& rover, const terrain::Grid& grid, const mission::Entry& mission) {
  if (rover.limits.radius <= Costmap::kMostRadiusCells * grid.resolution) return;
  std::ostringstream fault;
  fault << "the rover's radius of " << rover.limits.radius << " m is more than " << Costmap::kMostRadiusCells
        << " cells of the site's map, whose side is " << grid.resolution
        << " m; correct 'radius_m' of 'rover', or resample the map to larger cells";
  const auto section = mission.find("rover");
  const auto radius = section ? section->find("radius_m") : section;
  (radius ? *radius : mission.at("site")).fail(fault.str());
}

}  // namespace roci::pathplan
