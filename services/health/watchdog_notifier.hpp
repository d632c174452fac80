// The notifier feeds the watchdog of this process's supervisor while the loop turns, by systemd's
// notification protocol (sd_notify(3), WATCHDOG=1), which roci-launch speaks, too. It bypasses DDS, so that a
// locked-up transport cannot silence a process to its supervisor.
#pragma once

#include <string>

#include "services/clock/wall.hpp"

namespace roci::services::health {

/// Holds the socket to the supervisor.
class WatchdogNotifier {
 public:
  /// Takes the value of NOTIFY_SOCKET: a path, or @ and an abstract name; an empty one means that nobody
  /// listens. Throws std::invalid_argument if it is no address, std::system_error if nobody is reached there.
  explicit WatchdogNotifier(const std::string& address);
  ~WatchdogNotifier();
  WatchdogNotifier(const WatchdogNotifier&) = delete;
  WatchdogNotifier& operator=(const WatchdogNotifier&) = delete;

  /// The loop calls it in each of its turns. It sends at most four times a second and never waits.
  void notify();

 private:
  int socket_ = -1;
  clock::WallTime next_;
};

}  // namespace roci::services::health
