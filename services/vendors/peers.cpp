#include "services/vendors/peers.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>

namespace roci::services {
namespace {

bool parse(const std::string& address, sockaddr_in& out) {
  out = {};
  out.sin_family = AF_INET;
  return inet_pton(AF_INET, address.c_str(), &out.sin_addr) == 1;
}

bool is_local(const sockaddr_in& address) {
  const int probe = socket(AF_INET, SOCK_DGRAM, 0);
  if (probe < 0) return false;
  const bool bound = bind(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(probe);
  return bound;
}

}  // namespace

bool is_loopback(const std::string& address) { return address.starts_with("127."); }

std::vector<std::string> peers_of(const TransportOptions& options) {
  std::vector<std::string> peers{options.address};
  for (const auto& peer : options.peers) {
    const bool reachable = is_loopback(peer) == is_loopback(options.address);
    if (reachable && std::find(peers.begin(), peers.end(), peer) == peers.end()) peers.push_back(peer);
  }
  return peers;
}

void require_usable_addresses(const TransportOptions& options) {
  sockaddr_in address;
  for (const auto& peer : options.peers) {
    if (!parse(peer, address))
      throw TransportError("peer \"" + peer + "\" is no IPv4 address; correct --peers");
  }
  if (!parse(options.address, address)) {
    throw TransportError("\"" + options.address + "\" is no IPv4 address; correct --address");
  }
  if (!is_local(address)) {
    throw TransportError("no network interface of this host has the address " + options.address +
                         "; give one of its own with --address (see: ip -4 address)");
  }
}

}  // namespace roci::services
