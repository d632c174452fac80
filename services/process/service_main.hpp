// This is the main() of a service process.
#pragma once

#include <string>

#include "services/process/service_options.hpp"
#include "services/process/stop_signals.hpp"
#include "services/service.hpp"

namespace roci::services::process {

/// Reads the command line (`x_svc --help`), opens the transport, and runs the service until it is stopped;
/// SIGTERM and SIGINT stop it cleanly. Returns a process exit code (docs/exit-codes.md); errors go to
/// standard error with their remedy.
int service_main(int argc, char** argv, const std::string& name, MakeService* make);

using RunProcess = void(const ServiceOptions&, StopSignals&);

/// Does the same for a process that opens its nodes itself, one after the other.
int service_main(int argc, char** argv, const std::string& name, RunProcess* run);

/// Runs one service on one node until it is stopped.
void run_service(const ServiceOptions&, StopSignals&, MakeService* make);

}  // namespace roci::services::process
