// Tells the supervisor of this process that its loop turns, by systemd's notification protocol
// (sd_notify(3)), which roci-launch speaks, too. It bypasses DDS, so that a locked-up transport cannot
// silence a supervisor.
#pragma once

#include <string>

#include "services/clock/wall.hpp"

namespace roci::services::health {

class SignOfLife {
 public:
  // NOTIFY_SOCKET: a path, or @ and an abstract name; empty: nobody listens. Throws std::invalid_argument if
  // it is no address.
  explicit SignOfLife(const std::string& address);
  ~SignOfLife();
  SignOfLife(const SignOfLife&) = delete;
  SignOfLife& operator=(const SignOfLife&) = delete;

  // In each turn of the loop; sent at most four times a second, and never waited for.
  void give();

 private:
  int socket_ = -1;
  clock::WallTime next_;
};

}  // namespace roci::services::health
