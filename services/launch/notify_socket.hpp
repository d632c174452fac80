// This is the launcher's end of sd_notify(3), to which health/watchdog_notifier.hpp writes.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace roci::services::launch {

/// Owns a datagram socket with an abstract name of its own.
class NotifySocket {
 public:
  NotifySocket();  ///< Throws std::system_error.
  ~NotifySocket();
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  /// Returns the value of NOTIFY_SOCKET for the children.
  const std::string& address() const { return address_; }
  /// Returns the processes that have notified since the last call, each as often as it did.
  std::vector<pid_t> receive();

 private:
  int socket_ = -1;
  std::string address_;
};

}  // namespace roci::services::launch
