// The supervisor keeps the service processes of one host running until the run is over.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/clock/wall.hpp"
#include "services/launch/child.hpp"
#include "services/launch/restart_policy.hpp"
#include "services/launch/watchdog.hpp"

namespace roci::services::launch {

/// Lists exit codes of services (docs/exit-codes.md) that mean more than that it died.
enum ServiceExit {
  kServiceStopped = 0,
  kServiceBadInput = 2,
  kServiceNoTransport = 3,
  kServiceClockGone = 4,
  kServiceSuperseded = 5
};

/// Says why a run cannot go on.
struct RunFailure {
  std::string service;
  std::string reason;
  bool bad_input = false;  ///< The user must mend the mission file or the command line.
};

/// Starts the services, starts dead ones again by the RestartPolicy, and winds the run up.
class Supervisor {
 public:
  struct Hooks {
    std::function<std::unique_ptr<Child>(const std::string& service, std::uint32_t incarnation)> start;
    std::function<void(const std::string& service, const std::string& what)> on_death;
    /// Says whether the mission goes on without a service that cannot be kept; null: never.
    std::function<bool(const std::string& service)> may_be_missed{};
    /// Hears of each service that the mission goes on without; null: nobody does.
    std::function<void(const std::string& service, const std::string& what)> on_missed{};
  };
  /// With the clean end of `master` the run is over; if `master_is_clock`, with any end of it. The first start of each
  /// service is the incarnation after `incarnations`.
  Supervisor(const std::vector<std::string>& services, std::string master, bool master_is_clock, Watchdog,
             Hooks, std::uint32_t incarnations = 0);

  void start(clock::WallTime now);  ///< Throws what Hooks::start throws.
  /// Looks after ended and hung children, due restarts, and the end of the run. It is to be called often. A restart for
  /// which Hooks::start throws std::system_error is told as a death and tried again later.
  void turn(clock::WallTime now);
  /// Asks the run to end; the second time less politely.
  void stop(clock::WallTime now);

  /// Returns the watchdog, which must be told of every notification, and of whom the launcher hears.
  Watchdog& watchdog() { return watchdog_; }

  bool finished() const;
  const std::optional<RunFailure>& failure() const { return failure_; }

 private:
  struct Service {
    std::unique_ptr<Child> child;
    std::uint32_t incarnation = 0;
    clock::WallTime started;
    std::optional<clock::WallTime> restart;
    RestartPolicy policy;
    bool ran = false;         // any incarnation of it got as far as its loop, also of an earlier launcher
    bool missed = false;      // the mission goes on without it
    std::string hung_reason;  // empty: it was not killed as hung
  };
  void launch(const std::string& name, Service&, clock::WallTime now);
  void launch_again(const std::string& name, Service&, clock::WallTime now);
  void look_after(std::pair<const std::string, Service>&, clock::WallTime now);
  void after_end(const std::string& name, Service&, const Ending&, clock::WallTime now);
  void start_again(const std::string& name, Service&, const std::string& what, clock::WallDuration pause,
                   clock::WallTime now);
  void miss(const std::string& name, Service& service, const std::string& what, const std::string& how_often,
            clock::WallTime now);
  void kill_hung(clock::WallTime now);
  void fail(const std::string& name, std::string what, bool bad_input, clock::WallTime now);
  void wind_up(clock::WallTime now);
  void signal_all(int number);

  std::map<std::string, Service> services_;
  std::string master_;
  bool master_is_clock_;
  Watchdog watchdog_;
  Hooks hooks_;
  std::optional<RunFailure> failure_;
  // The run ends in three stages: services leave by themselves, then SIGTERM comes, then SIGKILL.
  std::optional<clock::WallTime> terminate_at_;
  std::optional<clock::WallTime> kill_at_;
};

}  // namespace roci::services::launch
