// The mission report is what the ground hears of the mission as a whole, and the summary of a run.
#pragma once

#include <filesystem>
#include <string>

#include "exec_svc/reactor/reactor.hpp"
#include "roci_idl/plan.h"
#include "services/service.hpp"

namespace roci::exec {

/// Returns the mission's status without the trace's hash.
v1::MissionStatus mission_status(const reactor::Reactor& reactor, const mission::MissionModel& mission);

/// Holds what the executive alone knows; the launcher adds the rest.
struct RunFigures {
  double slowest_call_s = 0;
  double planner_peak_mb = 0;
  double sim_s = 0;
  std::string trace_sha256;
  std::filesystem::path journal;
  std::uint64_t epoch = 0;
};
/// Writes the summary of the run to `file` (run_file() in run_files_service.hpp).
void write_summary(const std::filesystem::path& file, const services::RunSettings& settings,
                   const mission::MissionModel& mission, const reactor::Reactor& reactor,
                   const RunFigures& figures);

}  // namespace roci::exec
