// A key folder holds what the services of one host need for secure runs. Its files:
//
//   identity_authority.pem, permissions_authority.pem   who signs certificates, and who signs documents
//   revoked.pem, governance.p7s                         certificates taken back (a CRL), how domains are protected
//   services/NAME/VENDOR.pem, .key, .permissions.p7s    certificate, private key and rights of a service at a vendor
//   authority/                                          on the ground's machine alone: the authorities' keys
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "services/transport/transport.hpp"

namespace roci::services::security {

/// Says what is wrong with the keys and what to do about it. Nothing was opened.
class KeyError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Returns $ROCI_KEYS, else rocinante/keys in $XDG_CONFIG_HOME or ~/.config.
std::filesystem::path default_key_folder();

/// Returns the names of the files, whether they are there or not.
transport::Credentials files_of(const std::filesystem::path& folder, const std::string& service,
                                std::string_view vendor);

/// Returns the credentials of a service at a vendor at `now_s` (seconds since 1970). Throws KeyError where a file is
/// missing or damaged, others than its owner may read a private key, the certificate has run out or been revoked, or a
/// file is of another authority, service or vendor.
transport::Credentials checked_credentials(const std::filesystem::path& folder, const std::string& service,
                                           std::string_view vendor, std::int64_t now_s);

/// Says how many days before its end a certificate is warned of.
inline constexpr int kWarnDays = 30;

/// Returns what to log at the start of a service whose certificate soon runs out, or an empty text if it does
/// not.
std::string expiry_warning(const transport::Credentials&, std::int64_t now_s);

/// Formats a time as "2027-01-31 12:00 UTC".
std::string date_text(std::int64_t unix_s);

}  // namespace roci::services::security
