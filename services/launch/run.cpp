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
constexpr clock::WallDuration kLookAtFolder = std::chrono::seconds(10);
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
          services::process::start_of_process(getpid()),
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

// Says when the run began, by the clock that all its services go by.
struct Beginning {
  clock::HostAnchor anchor;
  std::int64_t unix_us = 0;
};

// Who goes on with a run keeps its beginning, and its anchor while the host is up.
Beginning beginning_of(const Options& options) {
  if (!options.continued) {
    const clock::HostAnchor anchor = clock::anchor_host();
    return {anchor, anchor.unix_us};
  }
  const auto& earlier = options.continued->anchor;
  return {earlier ? *earlier : clock::anchor_host(), options.continued->epoch_unix_us};
}

void settle_run_folder(Options& options, std::int64_t started_unix_us) {
  if (options.run_folder.empty()) options.run_folder = choose_run_folder(options, started_unix_us);
  options.run_folder = fs::absolute(options.run_folder);
  refuse_used_folder(options);
  services::process::make_own_folder(options.run_folder);
}

// Joins the run's domain as an observer, unless it is another run's.
std::unique_ptr<services::Node> join(const Options& options, const std::function<int()>& stop_asked) {
  const bool may_be_held = domain_may_be_held(options);
  services::process::Connection own = options.connection;
  own.dds = console_vendor(options.connection.dds);
  auto node = std::make_unique<services::Node>(observer_options(own.dds, options.run),
                                               connect_on(own, options, stop_asked));
  if (may_be_held) refuse_held_domain(*node, options);
  return node;
}

ExitCode exit_code(const std::optional<RunFailure>& failure, bool good) {
  if (failure) return failure->bad_input ? kBadInput : kServiceFailed;
  return good ? kAchieved : kNotAchieved;
}

// The launcher from the first process of the run to its summary.
class Flight {
 public:
  Flight(const Options& options, const Beginning& beginning, const std::function<int()>& stop_asked)
      : options_(options),
        beginning_(beginning),
        stop_asked_(stop_asked),
        node_(join(options, stop_asked)),
        progress_(*node_, !options.headless),
        published_(services::process::runtime_folder(), record_of(options, beginning.unix_us)),
        notifications_(services::process::runtime_folder()),
        supervisor_(options.services, clock_master(), !options.live, Watchdog(options.watchdog_s), hooks(),
                    options.continued ? options.continued->incarnations() : 0) {
    node_->on_peer_change([this](const services::health::PeerChange& change) { hear(change); });
  }

  void run() {
    look_at_folder_ = clock::wall_now();
    supervisor_.start(clock::wall_now());
    while (!supervisor_.finished()) {
      node_->spin_once(kTurn);
      pass_on_stop();
      for (const pid_t sender : notifications_.receive())
        supervisor_.watchdog().kick(sender, clock::wall_now());
      supervisor_.turn(clock::wall_now());
      look_at_clock();
      progress_.show();
      if (clock::wall_now() < look_at_folder_) continue;
      look_at_folder_ = clock::wall_now() + kLookAtFolder;
      look_at_folder();
    }
    progress_.end();
  }

  // Prints the outcome.
  ExitCode conclude(clock::WallDuration flown) const {
    const std::optional<RunFailure>& failure = supervisor_.failure();
    if (failure) print_failure(*failure, options_.run_folder);
    const Summary summary =
        complete_summary(options_, std::chrono::duration<double>(flown).count(), !failure.has_value());
    if (stops_ > 0 && !summary.good)
      std::cerr
          << "roci-launch: stopped by a signal before the mission had ended; goals that were open stay so\n";
    std::cout << (options_.json ? summary.json + "\n" : summary.text) << std::flush;
    return exit_code(failure, summary.good);
  }

 private:
  std::string clock_master() const {
    const mission::ServiceEntry* master = options_.list.clock_master();
    return master == nullptr ? "" : master->name;
  }

  Supervisor::Hooks hooks() {
    Supervisor::Hooks out;
    out.start = [this](const std::string& service, std::uint32_t incarnation) {
      return start(service, incarnation);
    };
    out.may_be_missed = [this](const std::string& service) {
      const mission::ServiceEntry* entry = entry_of(options_, service);
      return entry != nullptr && !entry->essential;
    };
    out.on_missed = [this](const std::string& service, const std::string& what) {
      progress_.report(v1::SEVERITY_ERROR, "service.missed", service + " " + what);
    };
    out.on_death = [this](const std::string& service, const std::string& what) {
      progress_.report(v1::SEVERITY_WARNING, "service.died", service + " " + what);
    };
    return out;
  }

  std::unique_ptr<Child> start(const std::string& service, std::uint32_t incarnation) const {
    return std::make_unique<Child>(path_of(options_, service),
                                   service_arguments(options_, service, incarnation, beginning_.unix_us),
                                   options_.run_folder / (service + ".log"),
                                   std::vector<std::string>{"NOTIFY_SOCKET=" + notifications_.address(),
                                                            kPluginPath + transport::plugin_path(),
                                                            kAnchor + to_text(beginning_.anchor)});
  }

  // Who leads a pair counts its epochs as incarnations, so it cannot be told which process this is.
  void hear(const services::health::PeerChange& change) {
    const mission::ServiceEntry* entry = options_.list.find(change.service);
    if (options_.standby && entry != nullptr && entry->paired) return;
    supervisor_.watchdog().heard(change, clock::wall_now());
  }

  void pass_on_stop() {
    if (stop_asked_() <= stops_) return;
    ++stops_;
    supervisor_.stop(clock::wall_now());
  }

  void look_at_clock() {
    if (!options_.live) return;
    const auto set = clock_watch_.judge(unix_us(beginning_.anchor), clock::unix_us());
    if (set) progress_.report(v1::SEVERITY_WARNING, "clock.set", *set);
  }

  void look_at_folder() {
    for (const std::string& service : options_.services) bound_log(options_.run_folder / (service + ".log"));
    std::error_code error;
    const fs::space_info space = fs::space(options_.run_folder, error);
    if (error) return;
    if (const auto disk = disk_watch_.judge(space.available, options_.run_folder.string()))
      progress_.report(disk->severity, disk->code, disk->text);
  }

  const Options& options_;
  const Beginning& beginning_;
  const std::function<int()>& stop_asked_;
  std::unique_ptr<services::Node> node_;
  Progress progress_;
  const services::process::PublishedRun published_;
  NotifySocket notifications_;
  Supervisor supervisor_;
  clock::SystemClockWatch clock_watch_;
  DiskWatch disk_watch_;
  clock::WallTime look_at_folder_;  // next
  int stops_ = 0;                   // that were passed on
};

}  // namespace

ExitCode fly(Options options, const std::function<int()>& stop_asked) {
  const auto begun = clock::wall_now();
  const Beginning beginning = beginning_of(options);
  std::optional<services::process::DomainClaim> claim;
  auto& transport = options.connection.transport;
  if (!options.domain_given) transport.domain = claim.emplace().id();
  settle_run_folder(options, beginning.unix_us);
  const FolderLock lock(options.run_folder);
  require_keys(options);  // before the run forgets how it was started, and how it ended
  keep_command_line_on(options, beginning.anchor, beginning.unix_us, stop_asked);
  if (options.continued) remove_outcome(options.run_folder);

  transport.participant = "launcher";
  Flight flight(options, beginning, stop_asked);
  flight.run();
  const ExitCode code = flight.conclude(clock::wall_now() - begun);
  services::process::force_exit_after(services::process::kExitLimit, code, "roci-launch: the run is over");
  return code;
}

}  // namespace roci::services::launch
