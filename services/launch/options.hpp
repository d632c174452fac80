// This file reads the command line of roci-launch.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/mission/service_list.hpp"
#include "services/launch/continuation.hpp"
#include "services/process/connection.hpp"

namespace roci::services::launch {

/// Holds what the command line and the mission say of a run.
struct Options {
  std::filesystem::path mission;  ///< folder with mission.yaml
  mission::ServiceList list;      ///< services of the mission
  std::string scenario = "nominal";
  std::uint64_t seed = 1;
  bool live = false;
  /// Holds mission seconds per second; 0 means as fast as possible.
  std::optional<double> speed;
  bool headless = false;
  bool json = false;
  bool standby = false;               ///< services that can be paired have a second process
  double watchdog_s = 10;             ///< silence after which a service counts as hung; 0: never
  std::vector<std::string> services;  ///< services and standbys that are started here
  std::vector<std::string> roster;    ///< services of the whole run
  std::string run;                    ///< identity of the run; every host's launcher has the same
  /// Names the one service that this process turns into; if it is empty, the launcher stays.
  std::string become;
  double epoch_s = 0;                       ///< with `become`: mission time 0 of the live run, s since 1970
  std::filesystem::path run_folder;         ///< if empty, the launcher chooses one
  std::optional<Continuation> continued{};  ///< set if an earlier launcher began the run
  bool domain_given = false;
  bool shared_domain = false;                ///< another run may be on the domain
  services::process::Connection connection;  ///< its `dds` may be "mixed" or "inproc"
};

/// Returns the name of the second process of a paired service; it is no member of the roster of its own.
std::string standby_of(const std::string& service);
/// Returns the service that a process is one of, or null if there is no such process; `standby` says whether
/// it is the second one.
const mission::ServiceEntry* entry_of(const Options&, const std::string& process, bool* standby = nullptr);

/// Reads the command line. Throws process::CommandLineEnd, std::invalid_argument, mission::FileError.
Options parse_options(int argc, const char* const* argv, const services::process::Environment&);

}  // namespace roci::services::launch
