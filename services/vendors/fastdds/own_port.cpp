#include "services/vendors/fastdds/own_port.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <random>
#include <system_error>

#include "services/certificate/guid_prefix.hpp"
#include "services/transport/transport.hpp"
#include "services/vendors/guard/identities.hpp"

namespace roci::services::vendors::fastdds {
namespace {

// 0 if it is no IPv4 socket that is bound.
std::uint16_t port_of(int socket) {
  sockaddr_in own{};
  socklen_t size = sizeof own;
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size) != 0 || own.sin_family != AF_INET)
    return 0;
  return ntohs(own.sin_port);
}

bool is_udp(int socket) {
  int type = 0;
  socklen_t size = sizeof type;
  return getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &size) == 0 && type == SOCK_DGRAM;
}

}  // namespace

std::uint16_t free_port(const std::string& address) {
  sockaddr_in own{};
  own.sin_family = AF_INET;
  inet_pton(AF_INET, address.c_str(), &own.sin_addr);
  const int udp = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  std::uint16_t port = 0;
  if (udp >= 0 && bind(udp, reinterpret_cast<const sockaddr*>(&own), sizeof own) == 0) port = port_of(udp);
  if (udp >= 0) close(udp);
  if (port == 0) throw transport::TransportError("no free UDP port at " + address);
  return port;
}

bool is_ours(std::uint16_t port) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const std::string name = entry.path().filename();
    int descriptor = -1;
    std::from_chars(name.data(), name.data() + name.size(), descriptor);
    if (is_udp(descriptor) && port_of(descriptor) == port) return true;
  }
  return false;
}

eprosima::fastrtps::rtps::GuidPrefix_t prefix_naming(std::uint16_t port) {
  eprosima::fastrtps::rtps::GuidPrefix_t prefix;
  std::random_device random;
  std::generate(std::begin(prefix.value), std::end(prefix.value),
                [&random] { return static_cast<eprosima::fastrtps::rtps::octet>(random()); });
  const auto start = guard::prefix_start(port);
  std::copy(start.begin(), start.end(), std::begin(prefix.value));
  return prefix;
}

eprosima::fastrtps::rtps::GuidPrefix_t candidate_naming(std::uint16_t port) {
  const auto found = certificate::candidate_naming(port, certificate::Hashed::guid);
  eprosima::fastrtps::rtps::GuidPrefix_t prefix;
  std::copy(found.begin(), found.end(), std::begin(prefix.value));
  return prefix;
}

}  // namespace roci::services::vendors::fastdds
