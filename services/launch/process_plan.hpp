// What roci-launch starts: one command line for each service. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/launch/options.hpp"

namespace roci::services::launch {

/// The vendor of one program of a run: "mixed" puts the planner, the standby and the console on one vendor,
/// the rest on the other.
std::string vendor_of(const std::string& program, const std::string& dds);
inline constexpr char kConsole[] = "console";

/// Names the program of a service; it stands in the folder of this one.
std::string program_of(const std::string& service);

/// Returns the arguments of one service, its program first. `epoch_unix_us` is mission time 0 of a live run.
std::vector<std::string> service_arguments(const Options&, const std::string& service,
                                           std::uint32_t incarnation, std::int64_t epoch_unix_us);

/// Returns the arguments with which roci-rehearse flies the same run in one process.
std::vector<std::string> rehearsal_arguments(const Options&);

/// Returns the simulated seconds per second of the run.
double pace_of(const Options&);

}  // namespace roci::services::launch
