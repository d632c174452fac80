// This file reads what the simulated robots of a mission are made of, and what they say of themselves.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim_svc/scenario/run_file.hpp"

namespace roci::rehearsal::check {

/// Describes a component of a simulated robot, as far as its settings say.
struct SimulatedComponent {
  std::string robot;
  std::string name;
  /// Whether its settings could be read; else nothing else is known of it.
  bool known = false;
  std::vector<sim::world::CommandForm> commands{};
  std::vector<sim::world::StateForm> states{};
  std::vector<std::string> windows{};  ///< timelines of those that it waits for

  std::string timeline() const { return robot + "." + name; }
};

/// State timelines of things, "rover.image." and the thing's name.
struct SimulatedFamily {
  std::string prefix;
  std::vector<sim::world::StateForm> states;
};

/// Holds the simulated world; it is empty for a mission whose world is not sim_svc's.
struct SimulatedWorld {
  std::string service;  ///< of the mission that simulates it; empty: none does
  std::vector<std::string> robots;
  std::vector<SimulatedComponent> components;
  std::vector<SimulatedFamily> families;
  std::vector<std::string> timelines;  ///< all but those of families and windows

  bool empty() const { return service.empty(); }
  /// `robot` empty: the only one's. Null if there is none.
  const SimulatedComponent* find(std::string_view robot, std::string_view component) const;
  const SimulatedComponent* on_timeline(std::string_view timeline) const;
  /// The family that the timeline (or the template of one) belongs to, or null.
  const SimulatedFamily* family_of(std::string_view timeline) const;
  std::vector<std::string> component_names(std::string_view robot) const;
};

/// What a run begins with. Components that could not be read are there by their names alone.
SimulatedWorld simulated_world(const sim::scenario::RunSetup& run, const std::string& service);

std::vector<std::string> names_of(const std::vector<sim::world::StateForm>& states);
std::vector<std::string> names_of(const std::vector<sim::world::CommandForm>& commands);

}  // namespace roci::rehearsal::check
