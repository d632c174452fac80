// GUID prefixes of participants with a certificate. DDS Security (1.1, 9.3.3) makes them: a bit 1, the first 47 bits of
// the SHA-256 of the certificate's subject name, and the first 48 bits of the SHA-256 of the GUID that the participant
// would have had. Both vendors refuse a participant whose certificate does not fit its GUID, so that after the
// handshake the first six bytes say whose it is.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "services/certificate/subject.hpp"
#include "services/transport/transport.hpp"

namespace roci::services::certificate {

/// Holds the first six bytes of a GUID prefix.
using Start = std::array<std::uint8_t, 6>;
using Prefix = std::array<std::uint8_t, 12>;

Start start_of(const Subject&);

/// Says what a vendor hashes of the GUID that a participant would have had: its prefix alone, or the prefix
/// with the entity id of participants.
enum class Hashed { prefix, guid };

/// Returns a random prefix whose hash begins with `port`: the seventh and eighth byte of the GUID prefix made of it
/// name the port that the participant sends from, as prefixes of plain runs do (vendors/guard/identities.hpp). It
/// takes some 65,000 hashes, hundredths of a second.
Prefix candidate_naming(std::uint16_t port, Hashed);

/// Returns whether `guid` belongs to a participant with the certificate of the service that may call itself `sender`,
/// at either vendor: the service itself, one of a pair (`exec_svc.first`), or one of many consoles (`roci-…`). Any
/// thread may ask.
bool speaks_as(const transport::Guid& guid, std::string_view sender);

/// Returns the service under whose name `sender` has its certificate, e.g. exec_svc for exec_svc.second.
std::string_view service_of(std::string_view sender);

/// Throws TransportError unless a participant's GUID begins as `service`'s certificate for `vendor` requires,
/// which shows that the vendor has switched on its security.
void require_certified(const transport::Guid& guid, std::string_view service, std::string_view vendor);

}  // namespace roci::services::certificate
