#include "services/launch/process_plan.hpp"

#include <sstream>

namespace roci::services::launch {
namespace {

constexpr char kFirstVendor[] = "fastdds";  // of a mixed run
constexpr char kSecondVendor[] = "cyclonedds";
constexpr double kDefaultPace = 60;
constexpr double kRestartS = 10;  // more than the first pauses of RestartPolicy and a start take together

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const auto& part : parts) text += (text.empty() ? "" : ",") + part;
  return text;
}

std::string to_text(double number) {
  std::ostringstream text;
  text.precision(17);
  text << number;
  return text.str();
}

// The master of the clock goes on without a helper that does not come; its name is marked with "?".
std::vector<std::string> marked(const Options& options) {
  std::vector<std::string> roster = options.roster;
  for (std::string& service : roster)
    if (const mission::ServiceEntry* entry = options.list.find(service);
        entry != nullptr && !entry->essential)
      service += "?";
  return roster;
}

void add_clock(const Options& options, const std::string& service, std::int64_t epoch_unix_us,
               std::vector<std::string>& arguments) {
  const auto add = [&](const char* option, const std::string& value) {
    arguments.emplace_back(option);
    arguments.push_back(value);
  };
  if (options.live) {
    add("--clock", "live");
    add("--scale", to_text(options.speed.value_or(1)));
    add("--epoch", to_text(static_cast<double>(epoch_unix_us) / 1e6));
  } else if (entry_of(options, service)->clock_master) {
    add("--clock", "master");
    add("--roster", joined(marked(options)));
    add("--pace", to_text(pace_of(options)));
    add("--restart-hold", to_text(options.watchdog_s + kRestartS));
  } else {
    add("--clock", "simulated");
  }
}

}  // namespace

double pace_of(const Options& options) { return options.speed.value_or(kDefaultPace); }

std::string vendor_of(const Options& options, const std::string& process) {
  const std::string& dds = options.connection.dds;
  if (dds != "mixed") return dds;
  bool standby = false;
  const mission::ServiceEntry& entry = *entry_of(options, process, &standby);
  const std::string vendor = entry.vendor.empty() ? kFirstVendor : entry.vendor;
  if (!standby) return vendor;
  return vendor == kFirstVendor ? kSecondVendor : kFirstVendor;
}

std::string console_vendor(const std::string& dds) { return dds == "mixed" ? kSecondVendor : dds; }

std::string program_of(const Options& options, const std::string& process) {
  return entry_of(options, process)->program;
}

std::vector<std::string> service_arguments(const Options& options, const std::string& service,
                                           std::uint32_t incarnation, std::int64_t epoch_unix_us) {
  const auto& transport = options.connection.transport;
  bool standby = false;
  const mission::ServiceEntry& entry = *entry_of(options, service, &standby);
  std::vector<std::string> arguments{entry.program,
                                     "--name",
                                     entry.name,
                                     "--run",
                                     options.run,
                                     "--mission",
                                     options.mission.string(),
                                     "--settings",
                                     entry.settings.string(),
                                     "--scenario",
                                     options.scenario,
                                     "--seed",
                                     std::to_string(options.seed),
                                     "--run-folder",
                                     options.run_folder.string(),
                                     "--dds",
                                     vendor_of(options, service),
                                     "--domain",
                                     std::to_string(transport.domain),
                                     "--address",
                                     transport.address,
                                     "--peers",
                                     joined(transport.peers)};
  const services::process::Connection& connection = options.connection;
  if (!connection.network.empty()) {
    arguments.emplace_back("--network");
    arguments.push_back(connection.network.string());
  }
  if (!connection.keys.empty()) arguments.push_back("--secure=" + connection.keys.string());
  if (incarnation != 0) {
    arguments.emplace_back("--incarnation");
    arguments.push_back(std::to_string(incarnation));
  }
  add_clock(options, service, epoch_unix_us, arguments);
  if (!entry.robot.empty()) {
    arguments.emplace_back("--robot");
    arguments.push_back(entry.robot);
  }
  if (options.standby && entry.paired) {
    arguments.emplace_back("--pair");
    arguments.emplace_back(standby ? "second" : "first");
  }
  arguments.insert(arguments.end(), entry.arguments.begin(), entry.arguments.end());
  return arguments;
}

std::vector<std::string> rehearsal_arguments(const Options& options) {
  const double pace = pace_of(options);
  std::vector<std::string> arguments{
      "roci-rehearse", options.mission.string(),     "--scenario", options.scenario,
      "--seed",        std::to_string(options.seed), "--speed",    pace == 0 ? "max" : to_text(pace)};
  if (!options.run_folder.empty()) {
    arguments.emplace_back("--run-folder");
    arguments.push_back(options.run_folder.string());
  }
  if (options.json) arguments.emplace_back("--json");
  return arguments;
}

}  // namespace roci::services::launch
