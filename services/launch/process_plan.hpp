// What roci-launch starts: one command line for each service. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/launch/options.hpp"

namespace roci::services::launch {

// Of a whole run: "mixed" means the planner, the standby and the console on one vendor, the rest on the
// other.
std::string vendor_of(const std::string& program, const std::string& dds);
inline constexpr char kConsole[] = "console";

// The program of a service, in the folder of this one.
std::string program_of(const std::string& service);

// Arguments of one service, its program first. `epoch_unix_us`: mission time 0 of a live run.
std::vector<std::string> service_arguments(const Options&, const std::string& service,
                                           std::uint32_t incarnation, std::int64_t epoch_unix_us);

// The same run in one process: arguments of roci-rehearse.
std::vector<std::string> rehearsal_arguments(const Options&);

// Simulated seconds per second.
double pace_of(const Options&);

}  // namespace roci::services::launch
