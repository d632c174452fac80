// The authority of secure runs: it issues certificates, signs what their owners may do, and takes certificates back.
// Its keys are in authority/ of the ground's key folder and nowhere else.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/mission/service_list.hpp"
#include "services/security/issued.hpp"
#include "services/security/x509.hpp"

namespace roci::services::security {

/// Issues and revokes the certificates of one key folder, and writes what it did into its book (issued.hpp).
class Authority {
 public:
  /// Makes an authority in the folder if there is none, for twenty years from `now_s` on (seconds since 1970). Throws
  /// KeyError, std::runtime_error.
  static Authority make(const std::filesystem::path& folder, std::int64_t now_s);
  /// Opens the authority of a folder. Throws KeyError where there is none.
  static Authority open(const std::filesystem::path& folder);

  /// Learns what the services of a mission are, and the launcher and the console. A service that is known already
  /// by its name takes on what this mission says. Throws KeyError for a program that is not ours and has no
  /// `rights:`.
  void learn(const mission::ServiceList&);

  /// Gives the service a key, a certificate and permissions for each vendor; earlier ones stay valid until they run
  /// out. Throws KeyError if it is not known.
  void renew(const std::string& service, int days, std::int64_t now_s);
  /// Gives certificates to those known services that have none,
  /// and signs the permissions of all anew. Returns the new ones.
  std::vector<std::string> issue_missing(int days, std::int64_t now_s);

  /// Makes a key folder for another host: keys and certificates of its own for these services, and no authority.
  void export_to(const std::filesystem::path& target, const std::string& host,
                 const std::vector<std::string>& services, int days, std::int64_t now_s);

  /// Revokes all certificates of a service, or those of one host alone, and returns how many. A participant that
  /// has completed its handshake is not excluded: the list is read at start.
  int revoke(const std::string& service, const std::string& host, std::int64_t now_s);

  const Issued& issued() const { return issued_; }

 private:
  explicit Authority(std::filesystem::path folder);

  void give(const std::filesystem::path& folder, const std::string& host, const std::string& service,
            int days, std::int64_t now_s);
  void sign_permissions(const std::filesystem::path& folder, const std::string& service);
  void publish(const std::filesystem::path& folder) const;
  const KnownService& known(const std::string& service) const;

  std::filesystem::path folder_;
  Signer identity_;
  Signer permissions_;
  Issued issued_;
};

}  // namespace roci::services::security
