// This is the launcher's end of sd_notify(3), to which health/watchdog_notifier.hpp writes.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace roci::services::launch {

/// Owns a datagram socket.
class NotifySocket {
 public:
  /// Binds it to a name in `folder`, where nobody else can fill it if that is this user's alone, or without one (or
  /// with one of too long a name) to an abstract name of its own. Throws std::system_error.
  explicit NotifySocket(const std::filesystem::path& folder = {});
  ~NotifySocket();
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  /// Returns the value of NOTIFY_SOCKET for the children.
  const std::string& address() const { return address_; }
  /// Returns the processes of this user that have notified since the last call, each as often as it did.
  std::vector<pid_t> receive();

 private:
  int socket_ = -1;
  std::string address_;  // begins with '/' or '@'
};

}  // namespace roci::services::launch
