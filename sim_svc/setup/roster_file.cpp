#include "sim_svc/setup/roster_file.hpp"

#include <algorithm>
#include <array>

#include "core/words/nearest_word.hpp"

namespace roci::sim::setup {

using mission::Entry;

namespace {

constexpr double kShortestOrbit = 60;  // s

world::Orbit read_orbit(const Entry& entry) {
  entry.allow_only({"orbit_s", "eclipse_s", "first_eclipse_s", "solar_w", "window"});
  world::Orbit out;
  out.orbit_s = number(entry, "orbit_s", out.orbit_s, kShortestOrbit);
  out.eclipse_s = number(entry, "eclipse_s", out.eclipse_s);
  out.first_eclipse_s = number(entry, "first_eclipse_s", out.first_eclipse_s);
  out.solar_w = number(entry, "solar_w", out.solar_w);
  out.window = entry.text_or("window", out.window);
  if (out.eclipse_s >= out.orbit_s)
    entry.find("eclipse_s")
        .value_or(entry)
        .fail("the eclipse would last as long as the orbit; shorten it, or lengthen orbit_s");
  return out;
}

world::PowerParameters read_power(const Entry& entry) {
  entry.allow_only({"capacity_j", "idle_w", "solar_peak_w", "solar_noon_s", "day_s", "orbit"});
  world::PowerParameters out;
  if (const auto orbit = entry.find("orbit")) {
    for (const char* key : {"solar_peak_w", "solar_noon_s", "day_s"})
      if (const auto day = entry.find(key))
        day->fail("a robot in orbit has no day of a planet; drop " + std::string(key) + ", or orbit");
    out.orbit = read_orbit(*orbit);
  }
  out.capacity_j = number(entry, "capacity_j", out.capacity_j, 1);
  out.idle_w = number(entry, "idle_w", out.idle_w);
  out.solar_peak_w = number(entry, "solar_peak_w", out.solar_peak_w);
  out.solar_noon_s = number(entry, "solar_noon_s", out.solar_noon_s);
  out.day_s = number(entry, "day_s", out.day_s, 1);
  return out;
}

world::TelemetryParameters read_telemetry(const Entry& entry) {
  entry.allow_only({"moving_s", "idle_s"});
  world::TelemetryParameters out;
  out.moving_s = number(entry, "moving_s", out.moving_s, 0.1);
  out.idle_s = number(entry, "idle_s", out.idle_s, 0.1);
  return out;
}

// Reads a name, which becomes part of a timeline's.
std::string read_name(const Entry& entry) {
  std::string name = entry.text();
  check_name(name, entry);
  return name;
}

// The robot's own timelines and its start have these names.
constexpr std::array<std::string_view, 6> kTaken{"x", "y", "heading", "battery", "image", "sample"};

ComponentEntry read_component(const Entry& entry, const Registry& registry) {
  const Entry type = entry.at("type");
  if (!registry.find(type.text())) {
    type.fail("no component type '" + type.text() +
              "'; known: " + known_names(type.text(), registry.types()));
  }
  const Entry name = entry.at("name");
  if (std::find(kTaken.begin(), kTaken.end(), name.text()) != kTaken.end()) {
    name.fail("'" + name.text() + "' is taken by the robot itself; choose another name");
  }
  const ComponentType& known = *registry.find(type.text());
  return {read_name(name), type.text(), entry, known.can_be_slowed, known.can_be_hollow};
}

RobotEntry read_robot(const Entry& entry, const Registry& registry) {
  entry.allow_only({"name", "components", "power", "telemetry"});
  RobotEntry out;
  out.name = read_name(entry.at("name"));
  entry.at("components").each([&](const Entry& item) {
    ComponentEntry component = read_component(item, registry);
    if (out.has(component.name)) item.fail("'" + component.name + "' stands above already; rename one");
    out.on_ground = out.on_ground || registry.find(component.type)->on_ground;
    out.components.push_back(std::move(component));
  });
  if (const auto power = entry.find("power")) {
    out.power.emplace();
    power->attempt([&] { out.power = read_power(*power); });
  }
  if (const auto telemetry = entry.find("telemetry"))
    telemetry->attempt([&] { out.telemetry = read_telemetry(*telemetry); });
  return out;
}

}  // namespace

bool RobotEntry::has(std::string_view component) const {
  return std::any_of(components.begin(), components.end(),
                     [&](const ComponentEntry& one) { return one.name == component; });
}

std::vector<std::string> RobotEntry::component_names() const {
  std::vector<std::string> out;
  for (const ComponentEntry& one : components) out.push_back(one.name);
  return out;
}

Roster read_roster(const Entry& simulation, const Registry& registry) {
  simulation.allow_only({"robots", "surface"});  // the surface is read with the ground
  Roster out;
  const Entry robots = simulation.at("robots");
  robots.each([&](const Entry& item) {
    RobotEntry robot = read_robot(item, registry);
    const bool taken = std::ranges::find(out, robot.name, &RobotEntry::name) != out.end();
    if (taken) item.fail("robot '" + robot.name + "' stands above already; rename one");
    out.push_back(std::move(robot));
  });
  if (out.empty()) robots.fail("a world needs a robot; list one with its components");
  return out;
}

const RobotEntry* robot_named(const Roster& roster, std::string_view name) {
  if (name.empty()) return roster.size() == 1 ? &roster.front() : nullptr;
  const auto found =
      std::find_if(roster.begin(), roster.end(), [&](const RobotEntry& one) { return one.name == name; });
  return found == roster.end() ? nullptr : &*found;
}

std::vector<std::string> robot_names(const Roster& roster) {
  std::vector<std::string> out;
  for (const RobotEntry& one : roster) out.push_back(one.name);
  return out;
}

std::string known_names(std::string_view word, const std::vector<std::string>& known) {
  std::string out;
  for (const std::string& one : known) out += (out.empty() ? "" : ", ") + one;
  return (out.empty() ? "none" : out) + words::did_you_mean(word, known);
}

}  // namespace roci::sim::setup
