// The process plan says what roci-launch starts: one command line for each service. It is pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/launch/options.hpp"

namespace roci::services::launch {

/// Returns the vendor of a process. In a "mixed" run it is what the service's entry names, else the first
/// vendor; a standby is on another than its service.
std::string vendor_of(const Options&, const std::string& process);
/// Returns the vendor of a console: in a mixed run it is another one than most services have.
std::string console_vendor(const std::string& dds);

/// Returns the program of a process: a name in the folder of this one, or a path.
std::string program_of(const Options&, const std::string& process);

/// Returns the arguments of one service, its program first. `epoch_unix_us` is mission time 0 of a live run.
/// An incarnation of 0 is not told: the service counts its starts in the run folder.
std::vector<std::string> service_arguments(const Options&, const std::string& service,
                                           std::uint32_t incarnation, std::int64_t epoch_unix_us);

/// Returns the arguments with which roci-rehearse flies the same run in one process.
std::vector<std::string> rehearsal_arguments(const Options&);

/// Returns the simulated seconds per second of the run.
double pace_of(const Options&);

}  // namespace roci::services::launch
