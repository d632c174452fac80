// Identities say who speaks as whom: each GUID prefix belongs to the address and port that it was heard from
// first.
#pragma once

#include <array>
#include <chrono>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <unordered_map>
#include <vector>

#include "services/vendors/guard/datagram_admission.hpp"
#include "services/vendors/guard/endpoints.hpp"
#include "services/vendors/guard/parameters.hpp"

namespace roci::services::vendors::guard {

/// Holds an IPv4 address and a UDP port, in host byte order.
struct Source {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
  auto operator<=>(const Source&) const = default;
};

/// Returns the first four bytes of the GUID prefix of a participant of ours: they tell the one port that it speaks
/// from, even before it has said anything.
std::array<std::uint8_t, 4> prefix_start(std::uint16_t port);

/// Lets nobody speak for a participant that was heard before, unless they can forge addresses: both vendors send all
/// that a participant says through one socket, so another socket that uses its prefix is an impostor's. Prefixes are
/// forgotten only to make room, and only silent ones.
class Identities {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr std::size_t kPerAddress = 512;  ///< twelve times the participants that a host may have
  static constexpr std::size_t kPerSource = 64;    ///< participants of one process may share a socket
  /// Bounds the endpoints that one participant announces (a service of ours has some 25), and those of an address.
  static constexpr std::size_t kEndpoints = 1024, kEndpointsPerAddress = 8192;
  static constexpr std::chrono::seconds kSilent{kLongestLease + 1};  ///< the vendor has given it up

  /// Expects, in a secure run, prefixes that come of certificates and name the port in their seventh and
  /// eighth byte (certificate/guid_prefix.hpp), and refuses others; in a plain run our prefixes name it in
  /// the third and fourth byte.
  explicit Identities(bool secure = false) : secure_(secure) {}

  /// pass, taken_identity or crowd.
  DatagramAdmission claim(const GuidPrefix&, const Source&, Time now);

  /// Takes in what a participant that has its claim says of its endpoints, or returns false if it says too much. An end
  /// counts if it is newer than all that was said before: others a vendor passes over.
  bool announce(const GuidPrefix&, const std::vector<EndpointWord>&, Time now);

 private:
  struct HashPrefix {
    std::size_t operator()(const GuidPrefix&) const;
  };
  struct Owner {
    Source source;
    Time heard;
    std::set<std::array<std::uint8_t, 16>> endpoints{};
    std::map<std::uint32_t, std::int64_t> newest{};  // by writer of discovery, the number of its sample
  };

  bool is_borrowed(const GuidPrefix&, const Source&) const;
  bool make_room(const Source&, Time now);
  bool add_endpoint(Owner&, const EndpointWord&, Time now);
  void forget_silent(std::uint32_t address, Time now);
  void forget(const GuidPrefix&);

  bool secure_;
  std::unordered_map<GuidPrefix, Owner, HashPrefix> owners_;
  std::map<Source, std::size_t> of_source_;
  std::map<std::uint32_t, std::size_t> of_address_;
  std::map<std::uint32_t, std::size_t> endpoints_of_address_;
};

}  // namespace roci::services::vendors::guard
