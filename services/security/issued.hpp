// The authority's book lists which services it knows, and which certificates it has issued. It stands in
// authority/issued.json of the key folder on the ground's machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "services/security/topic_rights.hpp"

namespace roci::services::security {

/// Says what a service is; its permissions follow from that.
struct KnownService {
  std::set<Role> roles;
  std::string robot;  ///< empty: none
  bool operator==(const KnownService&) const = default;
};

/// Describes a certificate that was issued.
struct IssuedCertificate {
  std::string service;
  std::string vendor;
  std::string host;  ///< host that it was exported to; empty: the ground's own
  std::string serial;
  std::int64_t end = 0;      ///< seconds since 1970
  std::int64_t revoked = 0;  ///< seconds since 1970; 0: not revoked
};

/// Holds the whole book.
struct Issued {
  std::map<std::string, KnownService> services;
  std::vector<IssuedCertificate> certificates;
};

/// Reads the book. Throws KeyError where the file is missing or damaged.
Issued read_issued(const std::filesystem::path& file);
void write_issued(const std::filesystem::path& file, const Issued&);

}  // namespace roci::services::security
