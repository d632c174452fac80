// Two documents of DDS Security 1.1 (9.4.1) are written here: governance, which says how a domain is protected, and
// permissions, which say who may write and read what. Both are XML that the permissions authority signs
// (authority.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "services/security/topic_rights.hpp"

namespace roci::services::security {

/// Returns the governance of every domain and topic: nobody joins without a certificate; discovery, liveliness,
/// messages and submessages are encrypted; each write and read needs a right. Payloads are not encrypted once more
/// (data_protection_kind NONE), since the two vendors do not understand each other's.
std::string governance();
/// Returns whether a text is the governance of domains, and not other permissions.
bool is_governance(const std::string& document);

inline constexpr std::int64_t kDay = 24 * 60 * 60;  ///< seconds

/// Holds a right to a time, in seconds since 1970.
struct Validity {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

/// Returns the permissions of the service with the subject name `subject` (RFC 2253): the topics of its roles,
/// inner ones in the partitions of `robot` alone (transport/scope.hpp). All else is denied.
std::string permissions(const std::string& service, const std::string& subject, const std::set<Role>& roles,
                        const std::string& robot, const Validity&);

/// Says whose permissions these are, and for how long.
struct Grant {
  std::string subject;  ///< RFC 2253
  Validity validity;
};

/// Returns the grant of a text that permissions() wrote; none of any other.
std::optional<Grant> grant_of(const std::string& permissions);

}  // namespace roci::services::security
