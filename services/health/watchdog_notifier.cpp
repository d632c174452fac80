#include "services/health/watchdog_notifier.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace roci::services::health {
namespace {

constexpr double kNotifyPeriodS = 0.25;
constexpr std::string_view kAlive = "READY=1\nWATCHDOG=1";

void connect_to(int socket, const std::string& address) {
  sockaddr_un name{};
  if (address.size() >= sizeof name.sun_path || (address[0] != '/' && address[0] != '@'))
    throw std::invalid_argument("NOTIFY_SOCKET is \"" + address +
                                "\", which is no address of a socket; unset it");
  name.sun_family = AF_UNIX;
  address.copy(name.sun_path, address.size());
  if (address[0] == '@') name.sun_path[0] = '\0';
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address.size());
  if (connect(socket, reinterpret_cast<const sockaddr*>(&name), size) == 0) return;
  throw std::system_error(errno, std::generic_category(), "cannot reach NOTIFY_SOCKET " + address);
}

}  // namespace

WatchdogNotifier::WatchdogNotifier(const std::string& address) {
  if (address.empty()) return;
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket_ < 0) throw std::system_error(errno, std::generic_category(), "socket");
  try {
    connect_to(socket_, address);
  } catch (...) {
    close(socket_);
    throw;
  }
}

WatchdogNotifier::~WatchdogNotifier() {
  if (socket_ >= 0) close(socket_);
}

void WatchdogNotifier::notify() {
  const clock::WallTime now = clock::wall_now();
  if (socket_ < 0 || now < next_) return;
  next_ = now + clock::wall_seconds(kNotifyPeriodS);
  [[maybe_unused]] const auto lost =
      send(socket_, kAlive.data(), kAlive.size(), MSG_NOSIGNAL);  // the next one follows
}

}  // namespace roci::services::health
