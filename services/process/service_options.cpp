#include "services/process/service_options.hpp"

#include <CLI/CLI.hpp>
#include <map>
#include <sstream>
#include <stdexcept>

#include "core/mission/mission_file.hpp"
#include "services/link/link_file.hpp"
#include "services/process/time_settings.hpp"

namespace roci::services::process {
namespace {

const std::map<std::string, clock::ClockMode> kClockNames{{"live", clock::ClockMode::live},
                                                          {"simulated", clock::ClockMode::simulated},
                                                          {"master", clock::ClockMode::master},
                                                          {"observer", clock::ClockMode::observer}};

void add_run(CLI::App& app, RunSettings& run) {
  app.add_option("--mission", run.mission, "Mission folder (with mission.yaml)")->required();
  app.add_option("--settings", run.settings,
                 "The mission file to read (default: mission.yaml of the folder)");
  app.add_option("--scenario", run.scenario, "scenarios/NAME.yaml of the mission")->capture_default_str();
  app.add_option("--seed", run.seed, "Seed of everything random")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--run-folder", run.run_folder, "Folder for journal, logs and summary of this run");
  app.add_option("--pair", run.pair,
                 "exec_svc: which of two processes that stand in for each other this is (or ROCI_PAIR)")
      ->check(CLI::IsMember({"first", "second"}));
}

void add_identity(CLI::App& app, node::NodeOptions& node) {
  app.add_option("--name", node.name, "Logical name of this service, unique in the run")
      ->capture_default_str();
  app.add_option("--robot", node.robot, "The robot that it belongs to (default: the team)");
  app.add_option("--run", node.run, "Identity of the run (or ROCI_RUN; default: the mission's name)");
}

void add_connection(CLI::App& app, ConnectionFlags& flags) {
  app.add_option("--dds", flags.dds, "DDS vendor: fastdds, cyclonedds (or ROCI_DDS)");
  app.add_option("--domain", flags.domain, "DDS domain id, 0 to 232 (or ROCI_DOMAIN)");
  app.add_option("--address", flags.address, "The one interface address to use (or ROCI_ADDRESS)");
  app.add_option("--peers", flags.peers, "Hosts of the run, separated by commas (or ROCI_PEERS)");
  app.add_option("--network", flags.network, "This host's network.yaml (or ROCI_NETWORK)");
  app.add_flag(kSecureFlag, flags.secure, kSecureHelp);
}

void add_clock(CLI::App& app, node::NodeOptions& node, std::string& roster, double& epoch_s) {
  app.add_option_function<std::string>(
         "--clock", [&node](const std::string& word) { node.clock = kClockNames.at(word); },
         "Which clock drives the service")
      ->check(CLI::IsMember(kClockNames))
      ->default_str("live");
  app.add_option("--scale", node.live_scale, "Live clock: mission seconds per wall second")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--epoch", epoch_s,
                 "Live clock: mission time 0 in seconds since 1970, the same for all services");
  app.add_option("--roster", roster,
                 "Master: services that must be ready before time 0, separated by commas");
  app.add_option("--pace", node.master.pace,
                 "Master: simulated seconds per wall second, 0 for as fast as possible")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--hang-limit", node.master.hang_limit_s,
                 "Master: seconds of silence until a service counts as hung")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--restart-hold", node.master.restart_hold_s,
                 "Master: seconds that mission time stands still for a killed service to return")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option(
         "--incarnation", node.incarnation,
         "How often this service was started in this run (default: counted in the run folder, else 1)")
      ->check(CLI::PositiveNumber);
}

std::string pair_of(const Environment& environment) {
  const std::string pair = environment("ROCI_PAIR").value_or("");
  if (pair.empty() || pair == "first" || pair == "second") return pair;
  throw std::invalid_argument("ROCI_PAIR is \"" + pair + "\": set it to first or second, or unset it");
}

}  // namespace

ServiceOptions parse_service_options(int argc, const char* const* argv, const std::string& name,
                                     const Environment& environment) {
  ServiceOptions options;
  options.node.name = name;
  ConnectionFlags flags;
  std::string roster;
  double epoch_s = 0;
  CLI::App app(name + ": a service of Rocinante", name);
  add_run(app, options.run);
  add_identity(app, options.node);
  add_connection(app, flags);
  add_clock(app, options.node, roster, epoch_s);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream text;
    const int code = app.exit(error, text, text);
    throw CommandLineEnd(code == 0 ? 0 : 2, text.str());
  }
  options.count_incarnation = app.count("--incarnation") == 0 && !options.run.run_folder.empty();
  options.node.master.roster = split_list(roster);
  options.node.epoch_unix_us = static_cast<std::int64_t>(epoch_s * 1e6);
  options.connection = resolve_connection(flags, environment, options.run.mission);
  options.run.secure = !options.connection.keys.empty();
  options.connection.transport.participant = options.node.name;
  options.node.mission =
      std::filesystem::absolute(options.run.mission).lexically_normal().filename().string();
  if (options.node.run.empty()) options.node.run = environment("ROCI_RUN").value_or(options.node.mission);
  options.node.vendor = options.connection.dds;
  if (options.node.clock == clock::ClockMode::live)
    options.time = read_time_settings(mission::load_mission_file(options.run.mission));
  options.node.links = link::load_links(options.run.mission, options.run.scenario, options.run.seed);
  options.notify_socket = environment("NOTIFY_SOCKET").value_or("");
  if (options.run.pair.empty()) options.run.pair = pair_of(environment);
  return options;
}

}  // namespace roci::services::process
