#include "services/launch/options.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "services/clock/wall.hpp"
#include "services/link/link_file.hpp"
#include "services/process/mission_folder.hpp"
#include "services/process/number_checks.hpp"
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
  if (used != text.size() || !(speed > 0) || std::isinf(speed)) {
    throw std::invalid_argument("--speed " + text + ": give mission seconds per second, like 60, or max");
  }
  return speed;
}

constexpr std::string_view kStandbySuffix = ".standby";

std::vector<std::string> checked_services(const std::string& list, const Options& options, bool processes) {
  auto names = process::split_list(list);
  for (const std::string& name : names) {
    bool standby = false;
    const bool known = entry_of(options, name, &standby) != nullptr;
    if (known && (!standby || (processes && options.standby))) continue;
    std::string all;
    for (const std::string& service : options.list.names()) all += " " + service;
    throw std::invalid_argument("unknown service " + name + "; this mission has:" + all);
  }
  return names.empty() ? options.list.names() : names;
}

// Is what the command line says in words of its own, before it is looked up.
struct Words {
  std::string mission;
  std::string speed;
  std::string clock = "simulated";
  std::string services;
  std::string roster;
  process::ConnectionFlags connection;
};

void declare_options(CLI::App& app, Options& options, Words& words) {
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.add_option("mission", words.mission, "Mission folder, or the name of an installed mission")->required();
  app.add_option("--scenario", options.scenario, "Scenario of the mission")->capture_default_str();
  app.add_option("--dds", words.connection.dds, "fastdds, cyclonedds, mixed, or inproc (one process)");
  app.add_option("--speed", words.speed,
                 "Mission seconds per second, or max (default: 60 simulated, 1 live)");
  app.add_option("--seed", options.seed, "Seed of everything random")
      ->check(process::from_zero())
      ->capture_default_str();
  app.add_option("--clock", words.clock, "simulated or live")
      ->check(CLI::IsMember({"simulated", "live"}))
      ->capture_default_str();
  app.add_flag("--headless", options.headless, "No progress display");
  app.add_flag("--json", options.json, "The last line of standard output is the summary as JSON");
  app.add_flag("--standby", options.standby,
               "A second process follows each service that allows it (standby: true) and takes over from it");
  app.add_option("--watchdog", options.watchdog_s,
                 "Seconds of silence until a service counts as hung and is replaced; 0: never")
      ->check(process::from_zero())
      ->capture_default_str();
  app.add_option("--services", words.services,
                 "Services to start on this host, separated by commas (default: all)");
  app.add_option("--become", options.become,
                 "Turn into this one service of the mission's list, for a supervisor such as systemd; live, "
                 "with --epoch");
  app.add_option("--epoch", options.epoch_s,
                 "With --become: mission time 0 in seconds since 1970, the same for all services");
  app.add_option("--roster", words.roster, "Services of the whole run, on all hosts (default: all)");
  app.add_option(
      "--run", options.run,
      "Identity of the run, the same on all of its hosts (or ROCI_RUN; default: one of its own, or the "
      "mission's name where only some of its services start here)");
  app.add_option("--domain", words.connection.domain, "DDS domain id (default: a free one)");
  app.add_flag("--shared-domain", options.shared_domain,
               "With --domain: start although another run is on it; neither obeys the other");
  app.add_option("--address", words.connection.address,
                 "The one interface address to use (default: loopback)");
  app.add_option("--peers", words.connection.peers, "Hosts of the run, separated by commas");
  app.add_option("--network", words.connection.network, "This host's network.yaml");
  app.add_flag(process::kSecureFlag, words.connection.secure, process::kSecureHelp);
  app.add_option("--run-folder", options.run_folder, "Folder for journal, logs and summary");
  app.add_option("--resume",
                 "Go on with the live run of this run folder, whose launcher has ended, as it was started; "
                 "other options replace those of then, but for what makes it another run (scenario, seed, "
                 "clock, run)")
      ->type_name("RUN_FOLDER");
}

// Reads the command line; what it says wrongly ends the program.
Words read_words(std::vector<std::string> arguments, Options& options) {
  Words words;
  CLI::App app("Flies a mission: starts every service, watches them, and reports the outcome", "roci-launch");
  declare_options(app, options, words);
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    std::ostringstream text;
    const int code = app.exit(error, text, text);
    throw process::CommandLineEnd(code == 0 ? 0 : 2, text.str());
  }
  return words;
}

void choose_services(Options& options, Words words) {
  if (!options.become.empty()) {
    if (!options.live)
      throw std::invalid_argument("--become: only live services start one by one; add --clock live");
    words.services = checked_services(options.become, options, false).front();
  }
  options.services = checked_services(words.services, options, true);
  options.roster = checked_services(words.roster, options, false);
  if (options.standby && words.services.empty()) {
    for (const mission::ServiceEntry& entry : options.list.services)
      if (entry.paired) options.services.push_back(standby_of(entry.name));
  }
  if (options.standby && options.services.size() == options.roster.size() && words.services.empty())
    throw std::invalid_argument("--standby: no service of this mission has standby: true");
}

// Who goes on with a run flies that run: what makes it another one is refused.
void refuse_another_run(const std::vector<std::string>& earlier, const Options& options, const Words& words) {
  Options before;
  const Words said = read_words(earlier, before);
  const auto require = [](const std::string& option, const std::string& then, const std::string& now) {
    if (then != now)
      throw std::invalid_argument("--resume: the run was started with " + option + " " + then +
                                  ", and cannot go on with " + now + "; leave it out, or start a new run");
  };
  require("--scenario", before.scenario, options.scenario);
  require("--seed", std::to_string(before.seed), std::to_string(options.seed));
  require("--clock", said.clock, words.clock);
  require("--run", before.run, options.run);
  if (!options.become.empty())
    throw std::invalid_argument("--resume goes on with a whole run, and --become with one service; choose one");
}

// A run that one launcher flies alone is like no other; hosts that share one are told its name, or take the
// mission's.
std::string default_run(const Options& options) {
  const std::string mission = options.mission.filename().string();
  if (options.services.size() < options.list.services.size()) return mission;
  return mission + "-" + std::to_string(clock::unix_us()) + "-" + std::to_string(getpid());
}

}  // namespace

std::string standby_of(const std::string& service) { return service + std::string(kStandbySuffix); }

const mission::ServiceEntry* entry_of(const Options& options, const std::string& process, bool* standby) {
  const mission::ServiceEntry* entry = options.list.find(process);
  const bool second = entry == nullptr && process.ends_with(kStandbySuffix);
  if (second) entry = options.list.find(process.substr(0, process.size() - kStandbySuffix.size()));
  if (second && entry != nullptr && !entry->paired) entry = nullptr;
  if (standby != nullptr) *standby = second;
  return entry;
}

Options parse_options(int argc, const char* const* argv, const services::process::Environment& environment) {
  ContinuedCommandLine line = continued_command_line(argc, argv);
  Options options;
  options.continued = line.continued;
  const Words words = read_words(std::move(line.arguments), options);
  if (options.continued) refuse_another_run(line.earlier, options, words);
  options.mission = process::mission_folder(words.mission);
  options.live = words.clock == "live";
  options.speed = parse_speed(words.speed);
  if (options.live && options.speed == 0.0)
    throw std::invalid_argument("--speed max needs the simulated clock");
  options.list = mission::load_service_list(options.mission);
  if (!options.live && options.list.clock_master() == nullptr)
    throw std::invalid_argument("no service of this mission has clock: master; fly it with --clock live");
  link::load_links(options.mission, options.scenario,
                   options.seed);  // a mistake is told before anything starts
  choose_services(options, words);
  if (options.run.empty()) options.run = environment("ROCI_RUN").value_or(default_run(options));
  options.connection = process::resolve_connection(words.connection, environment, options.mission);
  if (options.connection.dds == "mixed" && !options.connection.transport.vendor_xml.empty())
    throw std::invalid_argument(
        "--dds mixed and vendor_xml: the file is of one vendor, and reaches every process");
  if (options.standby && options.connection.dds == "inproc")
    throw std::invalid_argument("--standby needs processes: choose another transport than inproc");
  options.domain_given = options.connection.transport.domain != 0;
  return options;
}

}  // namespace roci::services::launch
