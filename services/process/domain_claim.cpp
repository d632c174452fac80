#include "services/process/domain_claim.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>

#include "services/transport/rtps_ports.hpp"
#include "services/transport/transport.hpp"

namespace roci::services::process {
namespace {

// The ports of higher domains are in the range that the system hands out freely.
constexpr int kLastDomain = 100;

std::uint16_t claim_port(int domain) {
  return static_cast<std::uint16_t>(transport::first_participant_port(domain) + 239);
}

// Returns a UDP socket that has the port for itself, or -1.
int bind_alone(std::uint16_t port) {
  const int udp = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (udp >= 0 && bind(udp, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return udp;
  if (udp >= 0) close(udp);
  return -1;
}

}  // namespace

// Participants need no claim (a run with --domain has none), and the first of them may have left.
bool has_participants(int domain) {
  for (int participant = 0; participant < transport::kMaxParticipantsPerHost; ++participant) {
    const int probe =
        bind_alone(static_cast<std::uint16_t>(transport::first_participant_port(domain) + 2 * participant));
    if (probe < 0) return true;
    close(probe);
  }
  return false;
}

DomainClaim::DomainClaim() {
  // Each process starts at another place, so that many at once seldom collide.
  const int start = static_cast<int>(getpid()) % kLastDomain;
  for (int i = 0; i < kLastDomain; ++i) {
    id_ = 1 + (start + i) % kLastDomain;
    socket_ = bind_alone(claim_port(id_));
    if (socket_ < 0) continue;
    if (!has_participants(id_)) return;
    close(socket_);
  }
  throw transport::TransportError(
      "no free DDS domain id from 1 to 100 on this host; end other missions or give one with --domain");
}

DomainClaim::~DomainClaim() { close(socket_); }

}  // namespace roci::services::process
