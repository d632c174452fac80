// The roster has the simulated robots and their components as the mission file lists them.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim_svc/setup/registry.hpp"

namespace roci::sim::setup {

/// Describes a component as `simulation.robots` of mission.yaml lists it.
struct ComponentEntry {
  std::string name;
  std::string type;
  mission::Entry entry;
  bool can_be_slowed = false;
  bool can_be_hollow = false;
  bool has_rate = false;
};

/// Describes a robot as `simulation.robots` of mission.yaml lists it.
struct RobotEntry {
  std::string name;
  std::vector<ComponentEntry> components;
  std::optional<world::PowerParameters> power;  ///< empty: it has no battery
  world::TelemetryParameters telemetry;
  std::optional<world::ThermalParameters> thermal{};  ///< empty: it is warm enough everywhere
  std::optional<double> data_bytes{};                 ///< room for data products; empty: it makes none
  bool on_ground = false;                             ///< one of its components is

  bool has(std::string_view component) const;
  std::vector<std::string> component_names() const;
};

/// Holds the robots of a mission, in the order of the file; it is never empty.
using Roster = std::vector<RobotEntry>;

/// Reads `simulation` of mission.yaml: which robots there are and what they are made of. The components' own
/// settings stay unread. Throws mission::FileError with place and remedy.
Roster read_roster(const mission::Entry& simulation, const Registry&);

/// Returns the robot of that name, or the only one when the name is empty. Returns null if there is none.
const RobotEntry* robot_named(const Roster&, std::string_view name);
std::vector<std::string> robot_names(const Roster&);
/// Returns the component that the entry names; throws mission::FileError if the robot has none of that name.
const ComponentEntry& component_of(const mission::Entry& name, const RobotEntry&);
/// Returns "rover, scout; did you mean 'scout'?", to be put behind "known: ".
std::string known_names(std::string_view word, const std::vector<std::string>& known);

}  // namespace roci::sim::setup
