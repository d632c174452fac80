// This file reads the command line of every service process.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "services/node.hpp"
#include "services/process/connection.hpp"
#include "services/service.hpp"
#include "services/time_watch.hpp"

namespace roci::services::process {

/// Holds what a service process is told.
struct ServiceOptions {
  RunSettings run;
  node::NodeOptions node;
  Connection connection;
  TimeWatchSettings time{};        ///< live: how its host's clock is compared with the mission clock
  std::string notify_socket;       ///< its supervisor's, for WatchdogNotifier; empty: there is none
  bool count_incarnation = false;  ///< nobody gave one: it is counted in the run folder
};

/// Ends the program by its command line: by --help (code 0) or a mistake (code 2). what() is text for the
/// user.
class CommandLineEnd : public std::runtime_error {
 public:
  CommandLineEnd(int code, const std::string& text) : std::runtime_error(text), exit_code(code) {}
  const int exit_code;
};

/// Reads the command line. Throws CommandLineEnd, and what resolve_connection throws.
ServiceOptions parse_service_options(int argc, const char* const* argv, const std::string& name,
                                     const Environment&);

/// Opens the transport. Throws transport::TransportError, also for inproc, which joins no processes.
std::unique_ptr<transport::Transport> connect(const Connection&);

}  // namespace roci::services::process
