// The subject name of a service's certificate follows from the service and the vendor alone, so that everybody can work
// out by himself how the GUIDs of that service's participants begin (guid_prefix.hpp).
//
// Of two participants the one with the lower GUID starts the handshake of DDS Security (1.1, 9.3.2.1). Fast DDS 2.9
// starts it with a key agreement that Cyclone DDS 0.10 does not take in answer to a certificate with an elliptic curve;
// the other way round it works. A number in the subject name is therefore counted up until the GUIDs of Cyclone DDS are
// below those of Fast DDS.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace roci::services::certificate {

/// Names the vendors, each of which has certificates of its own.
inline constexpr std::string_view kVendors[] = {"fastdds", "cyclonedds"};

/// Holds a subject name: O=Rocinante, OU=<vendor>-<number>, CN=<service>, all of them UTF-8 strings.
struct Subject {
  std::string service;
  std::string unit;

  /// Returns the name as permissions have it (RFC 2253), e.g. "CN=exec_svc,OU=fastdds-0,O=Rocinante".
  std::string text() const;
  /// Returns the name as the certificate has it.
  std::vector<std::uint8_t> der() const;
};

/// Returns the subject of a service's certificate at a vendor. A service's name consists of letters, digits, '_', '-'
/// and '.' (core/mission/service_list.hpp); throws std::invalid_argument otherwise.
Subject subject_of(std::string_view service, std::string_view vendor);

}  // namespace roci::services::certificate
