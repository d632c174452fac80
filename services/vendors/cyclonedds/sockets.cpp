#include "services/vendors/cyclonedds/sockets.hpp"

extern "C" {
#include <dds/dds.h>

#include "services/vendors/cyclonedds/session_start.h"
}

#include <netinet/in.h>
#include <sys/socket.h>

#include <cstring>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <utility>
#include <vector>

#include "services/certificate/guid_prefix.hpp"
#include "services/vendors/cyclonedds/imports.hpp"

namespace roci::services::vendors::cyclonedds {
namespace {

struct Opening {
  std::shared_ptr<guard::Guard> guard;
  std::optional<std::uint32_t> address;
  bool secure = false;
  int bound = 0;
  // The port of the one socket for which the vendor leaves the choice to the system.
  std::uint16_t sends_from = 0;
};
thread_local std::optional<Opening> opening;

// By file descriptor; one that the vendor has closed is overwritten when it is bound again.
struct Guards {
  std::shared_mutex mutex;
  std::map<int, std::shared_ptr<guard::Guard>> of_socket;
};
Guards& guards() {
  static auto* const table = new Guards;  // the vendor's threads may outlive main()
  return *table;
}

decltype(&::bind) real_bind = nullptr;
decltype(&::recvmsg) real_recvmsg = nullptr;
decltype(&::sendmsg) real_sendmsg = nullptr;
int (*real_initialize)(ddsi_domaingv*) = nullptr;
dds_return_t (*real_new_participant)(ddsi_guid*, ddsi_domaingv*, unsigned, const ddsi_plist*) = nullptr;
std::uint64_t (*real_number)() = nullptr;

// The ports that the secure domains of this process send from.
struct SecureDomains {
  std::mutex mutex;
  std::map<const ddsi_domaingv*, std::uint16_t> ports;
};
SecureDomains& secure_domains() {
  static auto* const table = new SecureDomains;
  return *table;
}
thread_local bool adds_nothing = false;  // to the prefix of the next participant

std::shared_ptr<guard::Guard> guard_of(int socket) {
  auto& table = guards();
  const std::shared_lock lock(table.mutex);
  const auto found = table.of_socket.find(socket);
  return found == table.of_socket.end() ? nullptr : found->second;
}

// Whom a message is from, or for.
std::optional<guard::Source> source_of(const msghdr& message) {
  sockaddr_in from{};
  if (message.msg_name == nullptr || message.msg_namelen < sizeof from) return std::nullopt;
  std::memcpy(&from, message.msg_name, sizeof from);
  if (from.sin_family != AF_INET) return std::nullopt;
  return guard::Source{ntohl(from.sin_addr.s_addr), ntohs(from.sin_port)};
}

void put_guard(int socket, std::shared_ptr<guard::Guard> guard) {
  auto& table = guards();
  const std::lock_guard lock(table.mutex);
  table.of_socket[socket] = std::move(guard);
}

// A vendor's own XML may ask for sockets of each participant, which are opened later.
extern "C" int guarded_bind(int socket, const sockaddr* address, socklen_t length) {
  static const auto any_peer = std::make_shared<guard::Guard>(guard::Policy{});
  put_guard(socket, opening ? opening->guard : any_peer);
  if (opening) ++opening->bound;
  sockaddr_in own{};
  if (!opening || !opening->address || length != sizeof own || address->sa_family != AF_INET)
    return real_bind(socket, address, length);
  std::memcpy(&own, address, sizeof own);
  if (own.sin_addr.s_addr == htonl(INADDR_ANY)) own.sin_addr.s_addr = htonl(*opening->address);
  const bool any_port = own.sin_port == 0;
  const int result = real_bind(socket, reinterpret_cast<const sockaddr*>(&own), sizeof own);
  socklen_t size = sizeof own;
  if (result == 0 && any_port && getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size) == 0)
    opening->sends_from = ntohs(own.sin_port);
  return result;
}

// The vendor has opened its sockets and not yet made a participant.
extern "C" int guarded_initialize(ddsi_domaingv* domain) {
  const int result = real_initialize(domain);
  if (result >= 0 && opening && opening->sends_from != 0)
    roci_begin_prefixes_with(domain, guard::prefix_start(opening->sends_from).data());
  auto& secure = secure_domains();
  const std::lock_guard lock(secure.mutex);
  secure.ports.erase(domain);
  if (opening && opening->secure) secure.ports[domain] = opening->sends_from;
  return result;
}

// The vendor takes the prefix of its domain, adds a number by chance, and lets the certificate make the prefix of the
// participant of that: here the prefix is chosen for what comes of it, and nothing added.
extern "C" dds_return_t guarded_new_participant(ddsi_guid* guid, ddsi_domaingv* domain, unsigned flags,
                                                const ddsi_plist* settings) {
  auto& secure = secure_domains();
  const std::lock_guard lock(secure.mutex);
  const auto found = secure.ports.find(domain);
  if (found == secure.ports.end()) return real_new_participant(guid, domain, flags, settings);
  roci_take_prefix(domain, certificate::candidate_naming(found->second, certificate::Hashed::prefix).data());
  adds_nothing = true;
  const dds_return_t result = real_new_participant(guid, domain, flags, settings);
  adds_nothing = false;
  return result;
}

// Numbers of the vendor's own; the first one that a new participant asks for becomes part of its prefix.
extern "C" std::uint64_t guarded_number() { return std::exchange(adds_nothing, false) ? 0 : real_number(); }

// What is refused becomes one zero byte, as the vendor itself sends to wake its threads; it reads nothing that is
// shorter than a header. It cannot be left out: the vendor may wait for other sockets in the same thread.
extern "C" ssize_t guarded_recvmsg(int socket, msghdr* message, int flags) {
  const ssize_t received = real_recvmsg(socket, message, flags);
  const bool one_part = message->msg_iovlen == 1 && message->msg_iov[0].iov_len > 0;
  if (received < 0 || received == 1 || !one_part) return received;
  const auto guard = guard_of(socket);
  if (!guard) return received;
  auto* const bytes = static_cast<std::uint8_t*>(message->msg_iov[0].iov_base);
  const std::size_t admitted = guard->admit({bytes, static_cast<std::size_t>(received)}, source_of(*message));
  if (admitted > 0) return static_cast<ssize_t>(admitted);
  bytes[0] = 0;
  message->msg_flags &= ~MSG_TRUNC;
  return 1;
}

extern "C" ssize_t guarded_sendmsg(int socket, const msghdr* message, int flags) {
  const auto guard = guard_of(socket);
  const auto destination = guard && guard->is_secure() ? source_of(*message) : std::nullopt;
  if (!destination) return real_sendmsg(socket, message, flags);
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < message->msg_iovlen; ++i) {
    const auto* const part = static_cast<const std::uint8_t*>(message->msg_iov[i].iov_base);
    bytes.insert(bytes.end(), part, part + message->msg_iov[i].iov_len);
  }
  if (guard->keeps_back(bytes, *destination)) return static_cast<ssize_t>(bytes.size());
  return real_sendmsg(socket, message, flags);
}

// Puts `ours` in the place of a function that Cyclone DDS imports, and keeps what it called before; null: it imports no
// such function.
template <class Ours, class Theirs>
void replace(const char* function, Ours* ours, Theirs& theirs) {
  const void* const library = reinterpret_cast<const void*>(&dds_create_domain);
  theirs = reinterpret_cast<Theirs>(replace_import(library, function, reinterpret_cast<void*>(ours)));
}

void stand_before_the_sockets() {
  replace("bind", guarded_bind, real_bind);
  replace("recvmsg", guarded_recvmsg, real_recvmsg);
  replace("sendmsg", guarded_sendmsg, real_sendmsg);
  replace("rtps_init", guarded_initialize, real_initialize);
  replace("ddsi_new_participant", guarded_new_participant, real_new_participant);
  replace("ddsi_iid_gen", guarded_number, real_number);
}

}  // namespace

GuardedOpening::GuardedOpening(std::shared_ptr<guard::Guard> guard, std::optional<std::uint32_t> address,
                               bool secure) {
  static std::once_flag once;
  std::call_once(once, stand_before_the_sockets);
  if (real_bind == nullptr || real_recvmsg == nullptr || real_sendmsg == nullptr ||
      real_initialize == nullptr || real_new_participant == nullptr || real_number == nullptr) {
    throw transport::TransportError(
        "this build of Cyclone DDS does not let its sockets be guarded (it imports no bind, "
        "recvmsg, sendmsg, rtps_init, ddsi_new_participant or ddsi_iid_gen); use the library of Debian 12, "
        "or another transport with --dds");
  }
  opening = Opening{std::move(guard), address, secure};
}

GuardedOpening::~GuardedOpening() { opening.reset(); }

int GuardedOpening::bound() const { return opening->bound; }

}  // namespace roci::services::vendors::cyclonedds
