// The services of a mission stand in `services:` of mission.yaml. Launcher, roster of the simulated clock,
// supervisor, rehearsal and systemd units read this list; there is no other.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/mission/entry.hpp"

namespace roci::mission {

/// Describes one process of a run.
struct ServiceEntry {
  std::string name;  ///< logical name, unique in the mission; samples carry it as their sender
  /// Names a program beside the launcher, or a path seen from the mission's folder if it holds a '/'.
  std::string program;
  std::string robot;   ///< robot whose inner topics it shares; empty: the team's, with those of every robot
  std::string vendor;  ///< DDS vendor in a mixed run; empty: the run's first vendor
  std::filesystem::path settings;  ///< the mission file that it reads, mission.yaml unless another is named
  bool clock_master = false;       ///< it drives the simulated clock; at most one does
  bool paired = false;             ///< the run has a second process of it, a standby (program option --pair)
  bool essential = true;  ///< the run ends when it cannot be kept; else the mission goes on without it
  std::vector<std::string> arguments;  ///< appended to its command line
  /// Lists what it may do in a secure run, in the words of services/security/topic_rights.hpp; empty: what its program
  /// does.
  std::vector<std::string> rights{};
};

/// Holds the processes of a run in the order of the mission file.
struct ServiceList {
  std::vector<std::string> robots;  ///< in the order of `robots:`, as it names them
  std::vector<ServiceEntry> services;

  /// Returns the service of that name, or null if there is none.
  const ServiceEntry* find(std::string_view name) const;
  std::vector<std::string> names() const;
  /// Returns the service with `clock: master`, or null if there is none: then the mission can only be flown
  /// live.
  const ServiceEntry* clock_master() const;
  /// Returns the services that run this program, in the order of the list.
  std::vector<const ServiceEntry*> of_program(std::string_view program) const;
  /// Returns the name of a file of this service in the run folder, which all services share: `name` if no
  /// other service of the mission runs its program, else with the service's own name before it.
  std::string file_name(std::string_view service, const std::string& name) const;
  /// Returns the only service of a program that serves this robot: its own, else the team's. The name is
  /// empty if there is none, or several.
  std::string serving(std::string_view program, std::string_view robot) const;
};

/// Reads `robots:` and `services:`. Throws FileError with the place if there is no list, a name comes twice
/// or is not made of letters, digits, '_', '-' and '.', a robot is unknown, a settings file or a program path
/// does not exist, or there are two clock masters.
ServiceList read_service_list(const Entry& mission);

/// Reads the list of mission.yaml in that folder. Throws FileError.
ServiceList load_service_list(const std::filesystem::path& mission_folder);
/// Does the same, and returns an empty list where mission.yaml has none.
ServiceList load_service_list_if_any(const std::filesystem::path& mission_folder);

}  // namespace roci::mission
