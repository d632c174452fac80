#include "tests/contract/hostile/injector.hpp"

#include <arpa/inet.h>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "services/transport/rtps_ports.hpp"

namespace roci::services::contract::hostile {
namespace {

constexpr std::uint32_t kLoopback = 0x7f000001;
constexpr std::size_t kHeaderSize = 20;
constexpr std::size_t kKept = 4000;

std::uint16_t big_u16(const Bytes& bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

Prefix prefix_of(const Bytes& message) {
  Prefix prefix;
  std::copy_n(message.begin() + 8, prefix.size(), prefix.begin());
  return prefix;
}

}  // namespace

Listener::Listener(int domain)
    : first_port_(transport::first_participant_port(domain)),
      socket_(socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC, htons(ETH_P_IP))) {
  sockaddr_ll loopback{};
  loopback.sll_family = AF_PACKET;
  loopback.sll_protocol = htons(ETH_P_IP);
  loopback.sll_ifindex = static_cast<int>(if_nametoindex("lo"));
  if (socket_ < 0 || bind(socket_, reinterpret_cast<const sockaddr*>(&loopback), sizeof loopback) != 0)
    throw std::system_error(errno, std::generic_category(), "listening on the loopback");
}
Listener::~Listener() { close(socket_); }

void Listener::hear(std::vector<Datagram>& into, int wait_ms) {
  for (;;) {
    pollfd ready{socket_, POLLIN, 0};
    if (poll(&ready, 1, wait_ms) <= 0) return;
    wait_ms = 0;
    Bytes packet(65536);
    sockaddr_ll from{};
    socklen_t size = sizeof from;
    const auto length =
        recvfrom(socket_, packet.data(), packet.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
    if (length < 28 || from.sll_pkttype == PACKET_OUTGOING || packet[9] != 17) continue;
    packet.resize(static_cast<std::size_t>(length));
    const std::size_t header = (packet[0] & 15u) * 4u;
    if (packet.size() < header + 8 + kHeaderSize) continue;
    const int port = big_u16(packet, header + 2);
    if (port < first_port_ || port >= first_port_ + 2 * transport::kMaxParticipantsPerHost) continue;
    into.push_back(
        {big_u16(packet, header), port, Bytes(packet.begin() + static_cast<long>(header) + 8, packet.end())});
  }
}

Injector::Injector(int domain, std::uint64_t seed)
    : random_(seed), listener_(domain), own_(kLoopback, domain, kEprosima, 7, "") {}

void Injector::send(std::uint64_t count, const std::function<bool(bool)>& go_on) {
  constexpr int kBatch = 32;
  for (std::uint64_t sent = 0; go_on(sent >= count);) {
    hear();
    if (heard_.size() < 50) continue;
    own_.announce();
    for (int i = 0; i < kBatch; ++i, ++sent) {
      const Datagram datagram = next();
      sockets_[number(sockets_.size())].send(datagram.bytes, kLoopback, datagram.port);
    }
  }
}

// Not what was sent here.
void Injector::hear() {
  std::vector<Datagram> more;
  listener_.hear(more, 20);
  for (Datagram& datagram : more) {
    const bool own = datagram.from == own_.port() || std::ranges::any_of(sockets_, [&](const Socket& socket) {
                       return socket.port() == datagram.from;
                     });
    if (own) continue;
    if (heard_.size() < kKept)
      heard_.push_back(std::move(datagram));
    else
      heard_[number(kKept)] = std::move(datagram);
  }
}

Datagram Injector::next() {
  const Datagram& heard = heard_[number(heard_.size())];
  switch (number(5)) {
    case 0:
      return heard;
    case 1:
      return {0, heard.port, forged(heard.bytes)};
    case 2:
      return {0, heard.port, under_own_name(mutated(heard.bytes))};
    default:
      return {0, heard.port, mutated(heard.bytes)};
  }
}

Bytes Injector::mutated(const Bytes& heard) {
  Bytes bytes = heard;
  switch (number(4)) {
    case 0:
      bytes.resize(kHeaderSize + number(bytes.size() - kHeaderSize + 1));
      break;
    case 1:
      bytes.resize(bytes.size() + 4 * number(64));
      break;
    case 2:
      if (bytes.size() > kHeaderSize) {  // the first submessage becomes another
        static constexpr std::array<std::uint8_t, 12> kIds{1, 6, 7, 8, 9, 12, 14, 18, 19, 21, 22, 0x80};
        bytes[kHeaderSize] = kIds[number(kIds.size())];
      }
      break;
    default:
      break;
  }
  for (std::size_t flips = 1 + number(8); flips > 0 && bytes.size() > kHeaderSize; --flips) {
    static constexpr std::array<std::uint8_t, 5> kValues{0x00, 0x01, 0x7f, 0x80, 0xff};
    auto& byte = bytes[kHeaderSize + number(bytes.size() - kHeaderSize)];
    byte = number(2) == 0 ? kValues[number(kValues.size())] : static_cast<std::uint8_t>(number(256));
  }
  return bytes;
}

// As a participant of its own would say it. Samples of users are left to the writers of contract-hostile: well-formed
// ones would be a participant that is believed.
Bytes Injector::under_own_name(const Bytes& heard) {
  Bytes bytes = heard;
  if (bytes.size() < kHeaderSize) return bytes;
  const Prefix victim = prefix_of(bytes);
  for (auto at = bytes.begin();;) {
    at = std::search(at, bytes.end(), victim.begin(), victim.end());
    if (at == bytes.end()) break;
    std::copy(own_.prefix().begin(), own_.prefix().end(), at);
  }
  return bytes;
}

Bytes Injector::forged(const Bytes& heard) {
  const Prefix victim = prefix_of(heard);
  const bool as_victim = number(2) == 0;
  Message message(as_victim ? victim : own_.prefix(), number(2) == 0 ? kEprosima : kEclipse);
  const Parameters victims_end = Parameters().add_guid(0x0070, victim, 0x000001c1).add(0x0071, {0, 0, 0, 3});
  switch (number(9)) {
    case 0: {  // statistics of Fast DDS, at the end of the message or not
      Bytes body(56);
      for (auto& byte : body) byte = static_cast<std::uint8_t>(number(256));
      message.submessage(0x80, 0, body);
      if (number(2) == 0) message.submessage(0x01, 0, body);
      break;
    }
    case 1:  // the farewell of somebody else
      message.data(0x000100c7, 0x000100c2, 1000, kInlineQos, victims_end.list(), {});
      break;
    case 2:
      message.data(0x000100c7, 0x000100c2, 1001, kInlineQos | kKey, victims_end.list(),
                   Parameters().add_guid(0x0050, victim, 0x000001c1).sample());
      break;
    case 3: {  // speaking for somebody else from here on
      Bytes body{0, 0, 0, 0, 2, 2, 1, 15};
      put_bytes(body, victim);
      message.submessage(0x0c, 0, body);
      message.data(0x000100c7, 0x000100c2, 1002, kInlineQos, victims_end.list(), {});
      break;
    }
    case 4:
      message.gap(0, 0x00000102, 1, std::int64_t{1} << 40, 32);
      break;
    case 5:
      message.heartbeat(0, 0x000003c2, std::int64_t{1} << 40, std::int64_t{1} << 41, 1u << 30);
      break;
    case 6:
      message.acknack(0x00000107, 0x00000102, std::int64_t{1} << 40, 256);
      break;
    case 7:
      message.fragment(0, 0x00000102, 1, 1, 1, 65535, 0xffffffff, Bytes(16, 1));
      break;
    default:
      message.data(0x000200c7, 0x000200c2, 5, kData, {}, [&] {
        Bytes alive{0, 1, 0, 0};
        put_bytes(alive, victim);
        alive.resize(24);
        return alive;
      }());
      break;
  }
  return message.bytes();
}

}  // namespace roci::services::contract::hostile
