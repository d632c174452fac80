// The watchdog tells which services of a launcher are hung. It is pure.
//
// Two signs are watched for each process: that its loop turns (health/watchdog_notifier.hpp), and that it is
// heard over DDS. A service whose loop turns but whose DDS has locked up is dead to all others, and only a
// new process mends it.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "services/clock/wall.hpp"
#include "services/node.hpp"

namespace roci::services::launch {

/// Keeps for each process when its loop last turned and whether it is heard.
class Watchdog {
 public:
  /// Bounds how long a service may read files and journals before the first turn of its loop.
  static constexpr double kStartLimitS = 60;

  /// `limit_s` bounds the silence of a service, in seconds; 0 means that nobody ever counts as hung.
  explicit Watchdog(double limit_s) : limit_(clock::wall_seconds(limit_s)) {}

  void started(const std::string& service, std::uint32_t incarnation, pid_t, clock::WallTime now);
  void ended(const std::string& service) { watched_.erase(service); }
  void kick(pid_t, clock::WallTime now);
  /// Takes what the launcher's own node hears of the services of all hosts.
  void heard(const services::health::PeerChange&, clock::WallTime now);
  /// Returns whether the service's loop has turned since it was started.
  bool ran(const std::string& service) const;

  struct Hung {
    std::string service;
    std::string reason;
  };
  /// Returns who is hung; each is named once. A launcher that stood still itself (stopped, swapped out)
  /// begins to count anew.
  std::vector<Hung> check(clock::WallTime now);

 private:
  struct Watched {
    std::uint32_t incarnation = 0;
    pid_t pid = -1;
    bool ran = false;
    clock::WallTime seen;                    // the last sign, or the start
    std::optional<clock::WallTime> unheard;  // since when the transport has lost it
  };
  std::optional<std::string> reason_hung(const Watched&, clock::WallTime now) const;
  void count_anew(clock::WallTime now);

  clock::WallDuration limit_;
  std::map<std::string, Watched> watched_;
  std::set<std::string> heard_;  // alive, on any host
  std::optional<clock::WallTime> last_check_;
};

}  // namespace roci::services::launch
