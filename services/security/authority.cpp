#include "services/security/authority.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "services/security/key_folder.hpp"
#include "services/security/private_file.hpp"

namespace roci::services::security {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kAuthorityDays = 20 * 365;
// Hosts whose clocks are somewhat behind take a certificate at once. The vendors do not agree about the time zone of
// permissions: these hold a day longer than the certificate at either end, which decides.
constexpr std::int64_t kEarlier = kDay;

fs::path book_of(const fs::path& folder) { return folder / "authority" / "issued.json"; }
fs::path identity_key(const fs::path& folder) { return folder / "authority" / "identity.key"; }
fs::path permissions_key(const fs::path& folder) { return folder / "authority" / "permissions.key"; }

// The files that all services share.
transport::Credentials shared_files(const fs::path& folder) { return files_of(folder, "", ""); }

std::set<Role> roles_of(const mission::ServiceEntry& entry) {
  std::set<Role> roles = roles_of_program(fs::path(entry.program).filename().string());
  if (!entry.rights.empty()) roles = {Role::service};
  for (const std::string& word : entry.rights) {
    const auto role = role_of(word);
    if (!role)
      throw KeyError("service " + entry.name + ": rights: " + word + " is none; see docs/security.md");
    roles.insert(*role);
  }
  if (roles.empty())
    throw KeyError("service " + entry.name + " runs a program of its own, " + entry.program +
                   "; say in the mission's list what it may do, e.g. rights: [owner]");
  if (entry.clock_master) roles.insert(Role::master);
  return roles;
}

}  // namespace

Authority Authority::make(const fs::path& folder, std::int64_t now_s) {
  make_private(folder);
  make_private(folder / "authority");
  make_private(folder / "services");
  if (fs::exists(book_of(folder))) return open(folder);
  const Validity validity{now_s - kEarlier, now_s + kAuthorityDays * kDay};
  const Signer identity = make_authority("identity authority", validity);
  const Signer permissions = make_authority("permissions authority", validity);
  const auto files = shared_files(folder);
  write_private(identity_key(folder), to_pem(identity.key));
  write_private(permissions_key(folder), to_pem(permissions.key));
  write_private(files.identity_authority, to_pem(*identity.certificate));
  write_private(files.permissions_authority, to_pem(*permissions.certificate));
  write_issued(book_of(folder), {});
  return open(folder);
}

Authority Authority::open(const fs::path& folder) { return Authority(folder); }

Authority::Authority(fs::path folder) : folder_(std::move(folder)), issued_(read_issued(book_of(folder_))) {
  const auto files = shared_files(folder_);
  identity_ = {read_key(identity_key(folder_)), read_certificate(files.identity_authority)};
  permissions_ = {read_key(permissions_key(folder_)), read_certificate(files.permissions_authority)};
}

void Authority::learn(const mission::ServiceList& list) {
  for (const mission::ServiceEntry& entry : list.services)
    issued_.services[entry.name] = {roles_of(entry), entry.robot};
  issued_.services["launcher"] = {{Role::launcher}, ""};
  issued_.services["roci"] = {{Role::console}, ""};
}

const KnownService& Authority::known(const std::string& service) const {
  const auto found = issued_.services.find(service);
  if (found != issued_.services.end()) return found->second;
  throw KeyError("the authority of " + folder_.string() + " knows no " + service +
                 "; roci-keys make MISSION makes it known");
}

void Authority::give(const fs::path& folder, const std::string& host, const std::string& service, int days,
                     std::int64_t now_s) {
  known(service);
  make_private(folder / "services" / service);
  const Validity validity{now_s - kEarlier, now_s + days * kDay};
  for (const std::string_view vendor : certificate::kVendors) {
    const auto files = files_of(folder, service, vendor);
    const Key key = make_key();
    const auto own = issue(identity_, certificate::subject_of(service, vendor), key, validity);
    write_private(files.private_key, to_pem(key));
    write_private(files.certificate, to_pem(*own));
    issued_.certificates.push_back({service, std::string(vendor), host, serial_of(*own), validity.end, 0});
  }
  sign_permissions(folder, service);
}

void Authority::sign_permissions(const fs::path& folder, const std::string& service) {
  const KnownService& what = known(service);
  for (const std::string_view vendor : certificate::kVendors) {
    const auto files = files_of(folder, service, vendor);
    Validity validity = validity_of(*read_certificate(files.certificate));
    validity = {validity.begin - kDay, validity.end + kDay};
    const std::string subject = certificate::subject_of(service, vendor).text();
    write_private(files.permissions, signed_document(permissions_, permissions(service, subject, what.roles,
                                                                               what.robot, validity)));
  }
}

// What every host needs beside its services' own files.
void Authority::publish(const fs::path& folder) const {
  std::vector<Revoked> revoked;
  for (const IssuedCertificate& one : issued_.certificates)
    if (one.revoked != 0) revoked.push_back({one.serial, one.revoked});
  const auto files = shared_files(folder);
  write_private(files.identity_authority, to_pem(*identity_.certificate));
  write_private(files.permissions_authority, to_pem(*permissions_.certificate));
  write_private(files.governance, signed_document(permissions_, governance()));
  write_private(files.revoked, to_pem(*make_revocation_list(identity_, revoked)));
  write_issued(book_of(folder_), issued_);
}

void Authority::renew(const std::string& service, int days, std::int64_t now_s) {
  give(folder_, "", service, days, now_s);
  publish(folder_);
}

std::vector<std::string> Authority::issue_missing(int days, std::int64_t now_s) {
  std::vector<std::string> made;
  for (const auto& [service, what] : issued_.services) {
    const bool has = std::ranges::all_of(certificate::kVendors, [&](std::string_view vendor) {
      return fs::exists(files_of(folder_, service, vendor).certificate);
    });
    if (has) {
      sign_permissions(folder_, service);
    } else {
      give(folder_, "", service, days, now_s);
      made.push_back(service);
    }
  }
  publish(folder_);
  return made;
}

void Authority::export_to(const fs::path& target, const std::string& host,
                          const std::vector<std::string>& services, int days, std::int64_t now_s) {
  for (const std::string& service : services) known(service);
  make_private(target);
  make_private(target / "services");
  for (const std::string& service : services) give(target, host, service, days, now_s);
  publish(target);
}

int Authority::revoke(const std::string& service, const std::string& host, std::int64_t now_s) {
  known(service);
  int count = 0;
  for (IssuedCertificate& one : issued_.certificates) {
    if (one.service != service || one.revoked != 0 || (!host.empty() && one.host != host)) continue;
    one.revoked = now_s;
    ++count;
  }
  publish(folder_);
  return count;
}

}  // namespace roci::services::security
