#include "sim_svc/setup/roster_file.hpp"

#include <algorithm>
#include <array>

#include "core/words/nearest_word.hpp"
#include "sim_svc/setup/power_file.hpp"
#include "sim_svc/setup/thermal_file.hpp"

namespace roci::sim::setup {

using mission::Entry;

namespace {

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

constexpr double kDataBytes = 1e9;  // where data: says nothing else

// The robot's own timelines and its start have these names.
constexpr std::array<std::string_view, 7> kTaken{"x", "y", "heading", "battery", "image", "sample", "heat"};

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
  return {read_name(name), type.text(), entry, known.can_be_slowed, known.can_be_hollow, known.has_rate};
}

RobotEntry read_robot(const Entry& entry, const Registry& registry) {
  entry.allow_only({"name", "components", "power", "telemetry", "thermal", "data"});
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
  if (const auto thermal = entry.find("thermal")) {
    out.thermal.emplace();
    thermal->attempt([&] { out.thermal = read_thermal(*thermal); });
  }
  if (const auto data = entry.find("data")) {
    out.data_bytes = kDataBytes;
    data->attempt([&] {
      data->allow_only({"capacity_bytes"});
      out.data_bytes = number(*data, "capacity_bytes", kDataBytes, 1);
    });
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

const ComponentEntry& component_of(const Entry& name, const RobotEntry& robot) {
  const auto found = std::ranges::find(robot.components, name.text(), &ComponentEntry::name);
  if (found != robot.components.end()) return *found;
  name.fail("unknown component '" + name.text() +
            "'; known: " + known_names(name.text(), robot.component_names()));
}

std::string known_names(std::string_view word, const std::vector<std::string>& known) {
  std::string out;
  for (const std::string& one : known) out += (out.empty() ? "" : ", ") + one;
  return (out.empty() ? "none" : out) + words::did_you_mean(word, known);
}

}  // namespace roci::sim::setup
