// Loaded before a process it puts three encrypted submessages (SEC_PREFIX, SEC_BODY, SEC_POSTFIX) before the last
// message of each handshake that the process sends, as Cyclone DDS does when an acknowledgement is due in the same
// moment. Nobody can decrypt them yet.
#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "tests/contract/secure/interpose.hpp"

using roci::contract::next;

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::string_view kFinal = "DDS:Auth:PKI-DH:1.0+Final";
constexpr std::size_t kHeader = 20, kDestination = 16;  // bytes of the message's header and of INFO_DST

void add_submessage(Bytes& to, std::uint8_t id, const Bytes& body) {
  to.insert(to.end(), {id, 0, 0, static_cast<std::uint8_t>(body.size())});
  to.insert(to.end(), body.begin(), body.end());
}

// Empty if the message is to be sent as it is.
Bytes packed(const Bytes& message) {
  if (std::search(message.begin(), message.end(), kFinal.begin(), kFinal.end()) == message.end()) return {};
  const bool for_one = message[kHeader] == 0x0e;  // INFO_DST
  const auto begin = message.begin() + static_cast<std::ptrdiff_t>(kHeader + (for_one ? kDestination : 0));
  Bytes out(message.begin(), begin);
  Bytes prefix(20), body(36), postfix(20);
  prefix[3] = 4;  // AES256_GCM
  body[3] = 32;
  add_submessage(out, 0x31, prefix);
  add_submessage(out, 0x30, body);
  add_submessage(out, 0x32, postfix);
  out.insert(out.end(), begin, message.end());
  return out;
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) ssize_t sendmsg(int socket, const msghdr* message, int flags) {
  static auto* const real = next<decltype(::sendmsg)>("sendmsg");
  Bytes bytes;
  for (std::size_t i = 0; i < message->msg_iovlen; ++i) {
    const auto* part = static_cast<const std::uint8_t*>(message->msg_iov[i].iov_base);
    bytes.insert(bytes.end(), part, part + message->msg_iov[i].iov_len);
  }
  Bytes changed = packed(bytes);
  if (changed.empty()) return real(socket, message, flags);
  iovec part{changed.data(), changed.size()};
  msghdr other = *message;
  other.msg_iov = &part;
  other.msg_iovlen = 1;
  return real(socket, &other, flags) < 0 ? -1 : static_cast<ssize_t>(bytes.size());
}

__attribute__((visibility("default"))) ssize_t sendto(int socket, const void* data, std::size_t size,
                                                      int flags, const sockaddr* address, socklen_t length) {
  static auto* const real = next<decltype(::sendto)>("sendto");
  const auto* begin = static_cast<const std::uint8_t*>(data);
  const Bytes changed = packed(Bytes(begin, begin + size));
  if (changed.empty()) return real(socket, data, size, flags, address, length);
  return real(socket, changed.data(), changed.size(), flags, address, length) < 0
             ? -1
             : static_cast<ssize_t>(size);
}
}
