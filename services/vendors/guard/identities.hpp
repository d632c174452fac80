// Who speaks as whom: each GUID prefix belongs to the address and port that it was heard from first.
#pragma once

#include <array>
#include <chrono>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <unordered_map>

#include "services/vendors/guard/datagram_admission.hpp"
#include "services/vendors/guard/parameters.hpp"

namespace roci::services::vendors::guard {

/// An IPv4 address and a UDP port, in host byte order.
struct Source {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
  auto operator<=>(const Source&) const = default;
};

/// The first four bytes of the GUID prefix of a participant of ours: who sees it knows the one port that it speaks
/// from, also before it has said anything.
std::array<std::uint8_t, 4> prefix_start(std::uint16_t port);

/// Both vendors send all that a participant says through one socket, so that whoever else uses its prefix is somebody
/// else: without the right to forge addresses nobody can speak for a participant that was heard before. Prefixes are
/// forgotten only to make room, and only those that are silent.
class Identities {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr std::size_t kPerAddress = 256;     ///< Six times the participants that a host may have.
  static constexpr std::size_t kPerSource = 64;       ///< Participants of one process may share a socket.
  static constexpr std::chrono::seconds kSilent{10};  ///< Three leases: the vendor has given it up.

  /// In a secure run a prefix comes of a certificate and names the port in its seventh and eighth byte
  /// (certificate/guid_prefix.hpp), and no other is heard; in a plain one those of ours name it
  /// in the third and fourth.
  explicit Identities(bool secure = false) : secure_(secure) {}

  /// pass, taken_identity or crowd.
  DatagramAdmission claim(const GuidPrefix&, const Source&, Time now);

 private:
  struct HashPrefix {
    std::size_t operator()(const GuidPrefix&) const;
  };
  struct Owner {
    Source source;
    Time heard;
  };

  bool is_borrowed(const GuidPrefix&, const Source&) const;
  bool make_room(const Source&, Time now);
  void forget(const GuidPrefix&);

  bool secure_;
  std::unordered_map<GuidPrefix, Owner, HashPrefix> owners_;
  std::map<Source, std::size_t> of_source_;
  std::map<std::uint32_t, std::size_t> of_address_;
};

}  // namespace roci::services::vendors::guard
