// The command line of roci-launch.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/process/connection.hpp"

namespace roci::services::launch {

struct Options {
  std::filesystem::path mission;  ///< A folder with mission.yaml.
  std::string scenario = "nominal";
  std::uint64_t seed = 1;
  bool live = false;
  /// Mission seconds per second; 0 means as fast as possible.
  std::optional<double> speed;
  bool headless = false;
  bool json = false;
  bool standby = false;               ///< exec_svc is one of a pair.
  double watchdog_s = 10;             ///< Silence after which a service counts as hung; 0: never.
  std::vector<std::string> services;  ///< Those that are started here.
  std::vector<std::string> roster;    ///< Those of the whole run.
  std::filesystem::path run_folder;   ///< If empty, the launcher chooses one.
  bool domain_given = false;
  services::process::Connection connection;  ///< Its `dds` may be "mixed" or "inproc".
};

inline const std::vector<std::string> kAllServices{"arm_svc",     "exec_svc",    "pathplan_svc",
                                                   "planner_svc", "science_svc", "sim_svc"};
inline constexpr char kClockMaster[] = "sim_svc";
/// A second process of exec_svc, which stands by; it is no member of the roster of its own.
inline constexpr char kExecutive[] = "exec_svc";
inline constexpr char kStandby[] = "exec_svc.standby";

/// Throws process::CommandLineEnd, std::invalid_argument, mission::FileError.
Options parse_options(int argc, const char* const* argv, const services::process::Environment&);

}  // namespace roci::services::launch
