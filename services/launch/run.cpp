#include "services/launch/run.hpp"

#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "services/clock/host_anchor.hpp"
#include "services/clock/wall.hpp"
#include "services/launch/continuation.hpp"
#include "services/launch/disk_watch.hpp"
#include "services/launch/domain_guard.hpp"
#include "services/launch/log_files.hpp"
#include "services/launch/notify_socket.hpp"
#include "services/launch/process_plan.hpp"
#include "services/launch/progress.hpp"
#include "services/launch/summary.hpp"
#include "services/launch/supervisor.hpp"
#include "services/process/disk_pause.hpp"
#include "services/process/domain_claim.hpp"
#include "services/process/forced_exit.hpp"
#include "services/process/private_folder.hpp"
#include "services/process/run_record.hpp"
#include "services/process/service_options.hpp"
#include "services/service.hpp"
#include "services/transport/plug_ins.hpp"

namespace roci::services::launch {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kTurn{20};
constexpr std::size_t kShownLogLines = 8;
constexpr clock::WallDuration kLookAtNetwork = std::chrono::seconds(1);
constexpr clock::WallDuration kLookAtLogs = std::chrono::seconds(10);
// A user's own program stands elsewhere and loads the same vendors.
const std::string kPluginPath = "ROCI_PLUGIN_PATH=";
const std::string kAnchor = std::string(clock::kHostAnchorVariable) + "=";

fs::path path_of(const Options& options, const std::string& process) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / program_of(options, process);
  if (access(program.c_str(), X_OK) == 0) return program;
  throw std::system_error(errno, std::generic_category(), "cannot start " + program.string());
}

fs::path state_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state != '\0') return state;
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".local/state";
  return services::process::runtime_folder();  // never in a folder where everybody may write
}

fs::path choose_run_folder(const Options& options, std::int64_t started_unix_us) {
  const std::time_t seconds = started_unix_us / 1'000'000;
  char stamp[32];
  std::strftime(stamp, sizeof stamp, "%Y%m%dT%H%M%SZ", std::gmtime(&seconds));
  const std::string name = std::string(stamp) + "-" + options.mission.filename().string() + "-" +
                           options.scenario + "-" + std::to_string(getpid());
  return state_folder() / "rocinante" / "runs" / name;
}

// A service that starts takes up the journal that it finds, so an earlier run's would go on in this one.
void refuse_used_folder(const Options& options) {
  if (options.continued) return;
  for (const std::string& service : options.services) {
    if (!fs::exists(options.run_folder / (service + ".log"))) continue;
    throw std::invalid_argument("--run-folder " + options.run_folder.string() +
                                " holds an earlier run; remove it or choose another folder");
  }
}

// What an earlier launcher of the run has said of its end no longer holds.
void remove_outcome(const fs::path& run_folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(run_folder)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(kSummaryFile) || name == kExpectedFile) fs::remove(entry.path());
  }
}

services::node::NodeOptions observer_options(const std::string& vendor, const std::string& run) {
  services::node::NodeOptions options;
  options.name = "launcher";
  options.run = run;
  options.clock = services::clock::ClockMode::observer;
  options.vendor = vendor;
  return options;
}

services::process::RunRecord record_of(const Options& options, std::int64_t started_unix_us) {
  const auto& transport = options.connection.transport;
  return {getpid(),
          transport.domain,
          options.mission,
          options.scenario,
          options.connection.dds,
          transport.address,
          transport.peers,
          options.run_folder,
          options.live ? "live" : "simulated",
          started_unix_us,
          options.run,
          options.connection.keys,
          options.connection.network};
}

// Before anything starts: of a secure run no service starts without its keys.
void require_keys(const Options& options) {
  for (const std::string& process : options.services) {
    services::process::Connection connection = options.connection;
    connection.dds = vendor_of(options, process);
    services::process::admitted(connection, entry_of(options, process)->name);
  }
}

void print_failure(const RunFailure& failure, const fs::path& run_folder) {
  std::cerr << "roci-launch: " << failure.service << " " << failure.reason << "\n";
  const fs::path log = run_folder / (failure.service + ".log");
  std::ifstream in(log);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  const std::size_t first = lines.size() > kShownLogLines ? lines.size() - kShownLogLines : 0;
  for (std::size_t i = first; i < lines.size(); ++i) std::cerr << "  " << lines[i] << "\n";
  std::cerr << "  (" << log.string() << ")\n";
}

bool is_full(const std::system_error& error) {
  return error.code().value() == ENOSPC || error.code().value() == EDQUOT;
}

// Who goes on with a run waits for its disk as the services of the run would have; what an earlier launcher wrote down
// holds until then.
void keep_command_line_on(const Options& options, const clock::HostAnchor& anchor,
                          std::int64_t started_unix_us, const std::function<int()>& stop_asked) {
  for (process::DiskPause pause;;) {
    try {
      return keep_command_line(options, anchor, started_unix_us);
    } catch (const std::system_error& error) {
      if (!options.continued || !is_full(error) || stop_asked() > 0) throw;
      if (pause.wait())
        std::cerr << "roci-launch: waits for its disk: " << error.what() << "\n" << std::flush;
    }
  }
}

// Who goes on with a run waits for its network as the services of the run would have: they are started again for as
// long as it is out. The vendor is there, as it flew the run before.
std::unique_ptr<transport::Transport> connect_on(const process::Connection& own, const Options& options,
                                                 const std::function<int()>& stop_asked) {
  for (bool told = false;;) {
    try {
      auto transport = process::connect(own);
      if (told) std::cerr << "roci-launch: its network is back\n" << std::flush;
      return transport;
    } catch (const transport::TransportError& error) {
      if (!options.continued || stop_asked() > 0) throw;
      if (!std::exchange(told, true))
        std::cerr << "roci-launch: waits for its network, and looks every second (Ctrl-C ends it): "
                  << error.what() << "\n"
                  << std::flush;
    }
    const clock::WallTime again = clock::wall_now() + kLookAtNetwork;
    while (clock::wall_now() < again && stop_asked() == 0) std::this_thread::sleep_for(kTurn);
  }
}

ExitCode exit_code(const std::optional<RunFailure>& failure, bool good) {
  if (failure) return failure->bad_input ? kBadInput : kServiceFailed;
  return good ? kAchieved : kNotAchieved;
}

}  // namespace

ExitCode fly(Options options, const std::function<int()>& stop_asked) {
  const auto begun = clock::wall_now();
  const auto earlier = options.continued ? options.continued->anchor : std::nullopt;
  const clock::HostAnchor anchor = earlier.value_or(clock::anchor_host());
  const std::int64_t started_unix_us = options.continued ? options.continued->epoch_unix_us : anchor.unix_us;
  std::optional<services::process::DomainClaim> claim;
  auto& transport = options.connection.transport;
  if (!options.domain_given) transport.domain = claim.emplace().id();
  if (options.run_folder.empty()) options.run_folder = choose_run_folder(options, started_unix_us);
  options.run_folder = fs::absolute(options.run_folder);
  refuse_used_folder(options);
  services::process::make_own_folder(options.run_folder);
  const FolderLock lock(options.run_folder);
  keep_command_line_on(options, anchor, started_unix_us, stop_asked);
  if (options.continued) remove_outcome(options.run_folder);

  require_keys(options);
  const bool may_be_held = domain_may_be_held(options);
  const std::string vendor = console_vendor(options.connection.dds);
  transport.participant = "launcher";
  services::process::Connection own = options.connection;
  own.dds = vendor;
  services::Node node(observer_options(vendor, options.run), connect_on(own, options, stop_asked));
  if (may_be_held) refuse_held_domain(node, options);
  Progress progress(node, !options.headless);
  const services::process::PublishedRun published(services::process::runtime_folder(),
                                                  record_of(options, started_unix_us));

  NotifySocket notifications(services::process::runtime_folder());
  Supervisor::Hooks hooks;
  hooks.start = [&](const std::string& service, std::uint32_t incarnation) {
    return std::make_unique<Child>(
        path_of(options, service), service_arguments(options, service, incarnation, started_unix_us),
        options.run_folder / (service + ".log"),
        std::vector<std::string>{"NOTIFY_SOCKET=" + notifications.address(),
                                 kPluginPath + transport::plugin_path(), kAnchor + to_text(anchor)});
  };
  hooks.may_be_missed = [&](const std::string& service) {
    const mission::ServiceEntry* entry = entry_of(options, service);
    return entry != nullptr && !entry->essential;
  };
  hooks.on_missed = [&](const std::string& service, const std::string& what) {
    progress.report(v1::SEVERITY_ERROR, "service.missed", service + " " + what);
  };
  hooks.on_death = [&](const std::string& service, const std::string& what) {
    progress.report(v1::SEVERITY_WARNING, "service.died", service + " " + what);
  };
  const mission::ServiceEntry* master = options.list.clock_master();
  Supervisor supervisor(options.services, master == nullptr ? "" : master->name, !options.live,
                        Watchdog(options.watchdog_s), std::move(hooks),
                        options.continued ? options.continued->incarnations() : 0);
  node.on_peer_change([&](const services::health::PeerChange& change) {
    // Who leads a pair counts its epochs as incarnations, so it cannot be told which process this is.
    const mission::ServiceEntry* entry = options.list.find(change.service);
    if (options.standby && entry != nullptr && entry->paired) return;
    supervisor.watchdog().heard(change, clock::wall_now());
  });
  clock::SystemClockWatch clock_watch;
  DiskWatch disk_watch;
  clock::WallTime look_at_logs = begun;
  supervisor.start(clock::wall_now());
  int stops = 0;
  while (!supervisor.finished()) {
    node.spin_once(kTurn);
    if (stop_asked() > stops) {
      ++stops;
      supervisor.stop(clock::wall_now());
    }
    for (const pid_t sender : notifications.receive()) supervisor.watchdog().kick(sender, clock::wall_now());
    supervisor.turn(clock::wall_now());
    if (const auto set = options.live ? clock_watch.judge(unix_us(anchor), clock::unix_us()) : std::nullopt)
      progress.report(v1::SEVERITY_WARNING, "clock.set", *set);
    progress.show();
    if (clock::wall_now() < look_at_logs) continue;
    look_at_logs = clock::wall_now() + kLookAtLogs;
    for (const std::string& service : options.services) bound_log(options.run_folder / (service + ".log"));
    std::error_code error;
    const fs::space_info space = fs::space(options.run_folder, error);
    const auto disk = error ? std::nullopt : disk_watch.judge(space.available, options.run_folder.string());
    if (disk) progress.report(disk->severity, disk->code, disk->text);
  }

  progress.end();
  if (supervisor.failure()) print_failure(*supervisor.failure(), options.run_folder);
  const Summary summary =
      complete_summary(options, std::chrono::duration<double>(clock::wall_now() - begun).count(),
                       !supervisor.failure().has_value());
  if (stops > 0 && !summary.good)
    std::cerr
        << "roci-launch: stopped by a signal before the mission had ended; goals that were open stay so\n";
  std::cout << (options.json ? summary.json + "\n" : summary.text) << std::flush;
  const ExitCode code = exit_code(supervisor.failure(), summary.good);
  services::process::force_exit_after(services::process::kExitLimit, code, "roci-launch: the run is over");
  return code;
}

}  // namespace roci::services::launch
