#include "exec_svc/pair_service.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "exec_svc/exec_service.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/run_files_service.hpp"
#include "exec_svc/standby/follower_service.hpp"
#include "exec_svc/standby/leader_service.hpp"
#include "exec_svc/standby/standby_wire_service.hpp"
#include "services/health/watchdog_notifier.hpp"
#include "services/log/log.hpp"
#include "services/node.hpp"
#include "services/process/clock_watch.hpp"
#include "services/process/disk_pause.hpp"
#include "services/process/link_report.hpp"
#include "services/process/service_options.hpp"
#include "services/process/stop_signals.hpp"
#include "services/publisher.hpp"
#include "services/transport/transport.hpp"

namespace roci::exec {

using journal::Durability;
using journal::Journal;
using mission::MissionModel;
using mission::owners_of;
using mission::read_mission;
using standby::FollowerService;
using standby::GoalsApart;
using standby::LeaderService;
using standby::Lease;
using standby::LeaseSettings;
using standby::Member;
using standby::member_of;
using standby::moment;
using standby::PersistedTermFile;
using standby::StandDown;

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kReconnectPause{500};

Durability durability_for(const services::node::NodeOptions& node) {
  return node.clock == services::clock::ClockMode::live ? Durability::power : Durability::process;
}

fs::path file_of(const services::process::ServiceOptions& options, const std::string& name) {
  services::RunSettings run = options.run;
  if (run.pair == "second") run.run_folder /= "standby";
  fs::create_directories(run.run_folder);
  return run_file(run, options.node.name, name);
}

// Holds the node that is open now, for the thread that hears of signals.
class StopRequest {
 public:
  void ask() {
    const std::scoped_lock lock(mutex_);
    asked_ = true;
    changed_.notify_all();
    if (node_ != nullptr) node_->stop();
  }
  bool asked() const {
    const std::scoped_lock lock(mutex_);
    return asked_;
  }
  // Waits for this time at most, and no longer than until somebody asks.
  void wait(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, longest, [this] { return asked_; });
  }
  void reach(services::Node* node) {
    const std::scoped_lock lock(mutex_);
    node_ = node;
    if (asked_ && node != nullptr) node->stop();
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  services::Node* node_ = nullptr;
  bool asked_ = false;
};

// Keeps the node within reach of signals for as long as it lives.
class InterruptibleNode {
 public:
  InterruptibleNode(StopRequest& stop, services::Node& node) : stop_(stop) { stop_.reach(&node); }
  ~InterruptibleNode() { stop_.reach(nullptr); }
  InterruptibleNode(const InterruptibleNode&) = delete;
  InterruptibleNode& operator=(const InterruptibleNode&) = delete;

 private:
  StopRequest& stop_;
};

class PairProcess {
 public:
  PairProcess(const services::process::ServiceOptions& options, services::process::StopSignals& signals)
      : options_(options),
        watchdog_(options.notify_socket),
        self_(member_of(options.run.pair)),
        mission_(read_mission(options.run.mission_file(), role_of(options.run, options.node))),
        lease_{mission_.executive.standby_term},
        journal_(usable_journal(file_of(options, journal::kJournalFile),
                                services::process::DiskPause([this] { watchdog_.notify(); })),
                 durability_for(options.node)),
        persisted_term_(file_of(options, "standing"), durability_for(options.node)),
        stop_watch_(signals, [this] { stop_.ask(); }) {
    journal_.watch_extent();
    persisted_term_.wait_for_disk({[this](const std::string& cause) {
                                     if (term_pause_.wait())
                                       services::log::error("exec_svc waits for its disk: " + cause);
                                   },
                                   [this] { term_pause_.over(); }});
  }

  void run() {
    bool superseded = false;
    for (bool told_split = false; !stop_.asked();) {
      Lease lease(self_, lease_, persisted_term(), superseded, moment(), owners_of(mission_));
      const auto lead = follow(lease);
      if (!lead) return;
      log(*lead, lease);
      const auto end = this->lead(lease, *lead, told_split);
      if (!end) return;
      superseded = end->superseded;
      told_split = end->told_split;
      services::log::warning("exec_svc (" + options_.run.pair + ") stands down: " + end->what());
    }
  }

 private:
  void log(const Lease::Turn& turn, const Lease& lease) const {
    services::log::info("exec_svc (" + options_.run.pair + ") leads in epoch " +
                        std::to_string(lease.epoch()) + ": " + turn.reason);
  }

  standby::PersistedTerm persisted_term() {
    try {
      return persisted_term_.read();
    } catch (const journal::JournalError& error) {
      const fs::path kept = persisted_term_.begin_anew(journal_.position());
      services::log::error(std::string(error.what()) + ", is kept as " + kept.string() +
                           ", and this member is in doubt who has led since its journal was written");
      return persisted_term_.read();
    }
  }

  // Opens the transport. A member that was connected before waits for its network to come back. Returns null
  // if it was asked to stop.
  std::unique_ptr<services::transport::Transport> connect() {
    for (bool told = false; !stop_.asked(); stop_.wait(kReconnectPause)) {
      watchdog_.notify();
      try {
        auto transport = services::process::connect(options_.connection);
        connected_before_ = true;
        return transport;
      } catch (const services::transport::TransportError& error) {
        if (!connected_before_) throw;
        if (!std::exchange(told, true))
          services::log::warning(std::string("exec_svc waits: ") + error.what());
      }
    }
    return nullptr;
  }

  // Follows until it is this member's turn to lead. Returns nothing if the run is over.
  std::optional<Lease::Turn> follow(Lease& lease) {
    auto transport = connect();
    if (!transport) return std::nullopt;
    services::node::NodeOptions options = options_.node;
    options.name += "." + options_.run.pair;
    options.clock = services::clock::ClockMode::observer;
    services::Node node(options, std::move(transport));
    FollowerService following(node, options_.node.name, lease, journal_, persisted_term_,
                              GoalsApart(journal_.file(), durability_for(options_.node)));
    node.on_turn([this] { watchdog_.notify(); });
    const InterruptibleNode reach(stop_, node);
    node.run();
    return following.run_is_over() || stop_.asked() ? std::nullopt : following.lead();
  }

  // Leads until another member does. Returns nothing if the run is over. Under the simulated clock the epoch
  // is the incarnation, so the clock drops who led before.
  std::optional<StandDown> lead(Lease& lease, const Lease::Turn& turn, bool told_split) {
    auto transport = connect();
    if (!transport) return std::nullopt;
    services::node::NodeOptions options = options_.node;
    options.incarnation = static_cast<std::uint32_t>(lease.epoch());
    options.sole = false;
    services::Node node(options, std::move(transport));
    node.on_turn([this] { watchdog_.notify(); });
    const services::TimeWatch time_watch(node, options_.time);
    const services::process::ClockWatch clock_watch(node, options_.run.run_folder);
    try {
      LeaderService leading(node, options_.node.name, lease, journal_, persisted_term_, told_split);
      const auto executive = make_executive(node, options_.run, journal_, leading, turn.doubtful,
                                            GoalsApart(journal_.file(), durability_for(options_.node)));
      const InterruptibleNode reach(stop_, node);
      node.run();
      services::process::write_link_report(node, options_.run.run_folder);
      return std::nullopt;
    } catch (const StandDown& end) {
      return end;
    } catch (const services::clock::ClockGone&) {
      throw;
    } catch (const services::clock::ClockError& error) {
      return StandDown(error.what(), true);
    }
  }

  const services::process::ServiceOptions& options_;
  services::health::WatchdogNotifier watchdog_;
  Member self_;
  MissionModel mission_;
  LeaseSettings lease_;
  Journal journal_;
  PersistedTermFile persisted_term_;
  services::process::DiskPause term_pause_{[this] { watchdog_.notify(); }};
  StopRequest stop_;
  services::process::StopWatch stop_watch_;
  bool connected_before_ = false;
};

}  // namespace

void run_pair(const services::process::ServiceOptions& options, services::process::StopSignals& signals) {
  PairProcess(options, signals).run();
}

}  // namespace roci::exec
