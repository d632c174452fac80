#include "services/vendors/peers.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>

namespace roci::services::vendors {
namespace {

bool parse(const std::string& text, in_addr& address) {
  return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

// Asking to bind would not do: the vendors look for a running interface that has this very address, and Fast
// DDS goes on in silence without one.
bool is_on_running_interface(const in_addr& address) {
  ifaddrs* interfaces = nullptr;
  if (getifaddrs(&interfaces) != 0) return false;
  bool found = false;
  for (const ifaddrs* entry = interfaces; entry; entry = entry->ifa_next) {
    if (!entry->ifa_addr || entry->ifa_addr->sa_family != AF_INET) continue;
    const auto* own = reinterpret_cast<const sockaddr_in*>(entry->ifa_addr);
    found = found || (own->sin_addr.s_addr == address.s_addr && (entry->ifa_flags & IFF_RUNNING));
  }
  freeifaddrs(interfaces);
  return found;
}

}  // namespace

bool is_loopback(const std::string& address) { return address.starts_with("127."); }

std::vector<std::string> peers_of(const transport::TransportOptions& options) {
  std::vector<std::string> peers{options.address};
  for (const auto& peer : options.peers) {
    const bool reachable = is_loopback(peer) == is_loopback(options.address);
    if (reachable && std::find(peers.begin(), peers.end(), peer) == peers.end()) peers.push_back(peer);
  }
  return peers;
}

void require_usable_addresses(const transport::TransportOptions& options) {
  in_addr address;
  for (const auto& peer : options.peers) {
    if (!parse(peer, address))
      throw transport::TransportError("peer \"" + peer + "\" is no IPv4 address; correct --peers");
  }
  if (!parse(options.address, address)) {
    throw transport::TransportError("\"" + options.address + "\" is no IPv4 address; correct --address");
  }
  if (!is_on_running_interface(address)) {
    throw transport::TransportError("no running network interface of this host has the address " +
                                    options.address +
                                    "; bring it up, or give another with --address (see: ip -4 address)");
  }
}

}  // namespace roci::services::vendors
