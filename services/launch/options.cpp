#include "services/launch/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "services/process/mission_folder.hpp"
#include "services/process/service_options.hpp"

namespace roci::services::launch {
namespace {

std::optional<double> parse_speed(const std::string& text) {
  if (text.empty()) return std::nullopt;
  if (text == "max") return 0;
  std::size_t used = 0;
  double speed = 0;
  try {
    speed = std::stod(text, &used);
  } catch (const std::logic_error&) {
    used = 0;
  }
  if (used != text.size() || !(speed > 0)) {
    throw std::invalid_argument("--speed " + text + ": give mission seconds per second, like 60, or max");
  }
  return speed;
}

std::vector<std::string> checked_services(const std::string& list, bool standby) {
  auto names = services::process::split_list(list);
  for (const std::string& name : names) {
    if (standby && name == kStandby) continue;
    if (std::ranges::find(kAllServices, name) != kAllServices.end()) continue;
    std::string known;
    for (const std::string& service : kAllServices) known += " " + service;
    throw std::invalid_argument("unknown service " + name + "; there are:" + known);
  }
  return names.empty() ? kAllServices : names;
}

}  // namespace

Options parse_options(int argc, const char* const* argv, const services::process::Environment& environment) {
  Options options;
  services::process::ConnectionFlags flags;
  std::string mission;
  std::string speed;
  std::string clock = "simulated";
  std::string service_list;
  std::string roster;
  CLI::App app("Flies a mission: starts every service, watches them, and reports the outcome", "roci-launch");
  app.add_option("mission", mission, "Mission folder, or the name of an installed mission")->required();
  app.add_option("--scenario", options.scenario, "Scenario of the mission")->capture_default_str();
  app.add_option("--dds", flags.dds, "fastdds, cyclonedds, mixed, or inproc (one process)");
  app.add_option("--speed", speed, "Mission seconds per second, or max (default: 60 simulated, 1 live)");
  app.add_option("--seed", options.seed, "Seed of everything random")->capture_default_str();
  app.add_option("--clock", clock, "simulated or live")
      ->check(CLI::IsMember({"simulated", "live"}))
      ->capture_default_str();
  app.add_flag("--headless", options.headless, "No progress display");
  app.add_flag("--json", options.json, "The last line of standard output is the summary as JSON");
  app.add_flag("--standby", options.standby,
               "A second exec_svc follows the first one and takes over from it");
  app.add_option("--watchdog", options.watchdog_s,
                 "Seconds of silence until a service counts as hung and is replaced; 0: never")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--services", service_list,
                 "Services to start on this host, separated by commas (default: all)");
  app.add_option("--roster", roster, "Services of the whole run, on all hosts (default: all)");
  app.add_option("--domain", flags.domain, "DDS domain id (default: a free one)");
  app.add_option("--address", flags.address, "The one interface address to use (default: loopback)");
  app.add_option("--peers", flags.peers, "Hosts of the run, separated by commas");
  app.add_option("--network", flags.network, "This host's network.yaml");
  app.add_option("--run-folder", options.run_folder, "Folder for journal, logs and summary");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream text;
    const int code = app.exit(error, text, text);
    throw services::process::CommandLineEnd(code == 0 ? 0 : 2, text.str());
  }
  options.mission = services::process::mission_folder(mission);
  options.live = clock == "live";
  options.speed = parse_speed(speed);
  if (options.live && options.speed == 0.0)
    throw std::invalid_argument("--speed max needs the simulated clock");
  options.services = checked_services(service_list, options.standby);
  if (options.standby && service_list.empty()) options.services.emplace_back(kStandby);
  options.roster = checked_services(roster, false);
  options.connection = services::process::resolve_connection(flags, environment, options.mission);
  if (options.standby && options.connection.dds == "inproc")
    throw std::invalid_argument("--standby needs processes: choose another transport than inproc");
  options.domain_given = options.connection.transport.domain != 0;
  return options;
}

}  // namespace roci::services::launch
