// This is the process of one member of a pair: it follows, leads, follows again, until the run is over.
#pragma once

#include "services/process/service_options.hpp"
#include "services/process/stop_signals.hpp"

namespace roci::exec {

/// Runs one member; RunSettings::pair says which one it is, and both may have the same run folder.
void run_pair(const services::process::ServiceOptions& options, services::process::StopSignals& signals);

}  // namespace roci::exec
