#include "services/process/service_main.hpp"

#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>

#include "core/mission/entry.hpp"
#include "services/health/namesake_watch.hpp"
#include "services/health/watchdog_notifier.hpp"
#include "services/node.hpp"
#include "services/process/clock_watch.hpp"
#include "services/process/forced_exit.hpp"
#include "services/process/incarnation.hpp"
#include "services/process/link_report.hpp"
#include "services/transport/plug_ins.hpp"

namespace roci::services::process {
namespace {

// docs/exit-codes.md lists these under "Services".
enum ExitCode { kStopped = 0, kFailed = 1, kBadInput = 2, kNoTransport = 3, kClockGone = 4, kSuperseded = 5 };

ExitCode code_for(const std::exception& error) {
  const auto is = [&]<class Error>() { return dynamic_cast<const Error*>(&error) != nullptr; };
  if (is.operator()<transport::TransportError>()) return kNoTransport;
  if (is.operator()<health::Superseded>()) return kSuperseded;
  if (is.operator()<mission::FileError>() || is.operator()<std::invalid_argument>()) return kBadInput;
  if (is.operator()<clock::ClockGone>()) return kClockGone;
  return kFailed;
}

int guarded(const std::string& name, const std::function<void()>& run) {
  try {
    run();
    return kStopped;
  } catch (const CommandLineEnd& end) {
    (end.exit_code == 0 ? std::cout : std::cerr) << end.what();
    return end.exit_code;
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << '\n';
    return code_for(error);
  }
}

// Whatever `run` leaves behind, the end of this process included, takes a bounded time from here.
void run_and_end(const std::string& name, const std::function<void()>& run) {
  try {
    run();
    force_exit_after(kExitLimit, kStopped, name + ": its work is done");
  } catch (const std::exception& error) {
    force_exit_after(kExitLimit, code_for(error), name + ": " + error.what());
    throw;
  }
}

}  // namespace

std::unique_ptr<transport::Transport> connect(const Connection& connection) {
  if (connection.dds == "inproc") {
    throw transport::TransportError(
        "inproc joins services inside one process: run roci-rehearse, or choose a DDS vendor with --dds");
  }
  return transport::open_transport(connection.dds, admitted(connection, connection.transport.participant));
}

void run_service(const ServiceOptions& options, StopSignals& signals, MakeService* make) {
  node::NodeOptions node_options = options.node;
  if (options.count_incarnation)
    node_options.incarnation = next_incarnation(options.run.run_folder, node_options.name);
  health::WatchdogNotifier watchdog(options.notify_socket);
  Node node(node_options, connect(options.connection));
  node.on_turn([&watchdog] { watchdog.notify(); });
  const TimeWatch time_watch(node, options.time);
  const ClockWatch clock_watch(node, options.run.run_folder);
  const auto service = make(node, options.run);
  const StopWatch stop(signals, [&node] { node.stop(); });
  run_and_end(node_options.name, [&] {
    node.run();
    write_link_report(node, options.run.run_folder);
  });
}

int service_main(int argc, char** argv, const std::string& name, RunProcess* run) {
  return guarded(name, [&] {
    StopSignals signals;
    run(parse_service_options(argc, argv, name, process_environment()), signals);
  });
}

int service_main(int argc, char** argv, const std::string& name, MakeService* make) {
  return guarded(name, [&] {
    StopSignals signals;
    run_service(parse_service_options(argc, argv, name, process_environment()), signals, make);
  });
}

}  // namespace roci::services::process
