#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>

#include "core/mission/entry.hpp"
#include "services/incarnation.hpp"
#include "services/service.hpp"
#include "services/service_options.hpp"
#include "services/stop_signals.hpp"
#include "services/transport.hpp"

namespace roci::services {
namespace {

// docs/exit-codes.md, "Services".
enum ExitCode { kStopped = 0, kFailed = 1, kBadInput = 2, kNoTransport = 3, kClockGone = 4 };

int report(const std::string& name, const std::exception& error, int code) {
  std::cerr << name << ": " << error.what() << '\n';
  return code;
}

int guarded(const std::string& name, const std::function<void()>& run) {
  try {
    run();
    return kStopped;
  } catch (const CommandLineEnd& end) {
    (end.exit_code == 0 ? std::cout : std::cerr) << end.what();
    return end.exit_code;
  } catch (const TransportError& error) {
    return report(name, error, kNoTransport);
  } catch (const mission::FileError& error) {
    return report(name, error, kBadInput);
  } catch (const std::invalid_argument& error) {
    return report(name, error, kBadInput);
  } catch (const ClockGone& error) {
    return report(name, error, kClockGone);
  } catch (const std::exception& error) {
    return report(name, error, kFailed);
  }
}

}  // namespace

std::unique_ptr<Transport> connect(const Connection& connection) {
  if (connection.dds == "inproc") {
    throw TransportError(
        "inproc joins services inside one process: run roci-rehearse, or choose a DDS vendor with --dds");
  }
  return open_transport(connection.dds, connection.transport);
}

void run_service(const ServiceOptions& options, StopSignals& signals, MakeService* make) {
  NodeOptions node_options = options.node;
  if (options.count_incarnation)
    node_options.incarnation = next_incarnation(options.run.run_folder, node_options.name);
  Node node(node_options, connect(options.connection));
  const auto service = make(node, options.run);
  signals.watch([&node] { node.stop(); });
  node.run();
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

}  // namespace roci::services
