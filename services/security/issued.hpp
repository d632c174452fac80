// The book of the authority: which services it knows, and which certificates it has issued. It stands in
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

/// What a service is; its permissions follow.
struct KnownService {
  std::set<Role> roles;
  std::string robot;  ///< Empty: none.
  bool operator==(const KnownService&) const = default;
};

struct IssuedCertificate {
  std::string service;
  std::string vendor;
  std::string host;  ///< That it was exported to; empty: the ground's own.
  std::string serial;
  std::int64_t end = 0;      ///< In seconds since 1970.
  std::int64_t revoked = 0;  ///< In seconds since 1970; 0: it holds.
};

struct Issued {
  std::map<std::string, KnownService> services;
  std::vector<IssuedCertificate> certificates;
};

/// Throws KeyError where the file is missing or damaged.
Issued read_issued(const std::filesystem::path& file);
void write_issued(const std::filesystem::path& file, const Issued&);

}  // namespace roci::services::security
