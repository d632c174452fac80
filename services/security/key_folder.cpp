#include "services/security/key_folder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

#include "services/certificate/subject.hpp"
#include "services/security/documents.hpp"
#include "services/security/x509.hpp"

namespace roci::services::security {
namespace {

namespace fs = std::filesystem;

std::string remedy(const char* verb, const fs::path& folder) {
  return std::string("roci-keys ") + verb + " --keys " + folder.string();
}

void require_private(const fs::path& path, const char* what) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0)
    throw KeyError(std::string("there is no ") + what + " " + path.string() + "; make it with " +
                   remedy("make MISSION", path));
  if (status.st_uid != geteuid() && status.st_uid != 0)
    throw KeyError(std::string("the ") + what + " " + path.string() +
                   " belongs to another user; have keys of your own");
  if ((status.st_mode & 077) != 0)
    throw KeyError("others may read the " + std::string(what) + " " + path.string() + "; run chmod go= " +
                   path.string() + ", and renew the keys in it if somebody may have read them");
}

// What is wrong with a file that cannot be read is the reader's own text.
template <class Read>
auto read_or_refuse(const fs::path& file, const fs::path& folder, Read read) {
  try {
    return read(file);
  } catch (const std::runtime_error& error) {
    throw KeyError(std::string(error.what()) + "; make what is missing with " +
                   remedy("make MISSION", folder));
  }
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw std::runtime_error("cannot read " + file.string());
  return text.str();
}

std::string signed_text(const fs::path& document, const X509& authority, const fs::path& folder) {
  const std::string message = read_or_refuse(document, folder, text_of);
  try {
    return verified_document(message, authority);
  } catch (const std::runtime_error&) {
    throw KeyError(document.string() + " is not signed by the authority of " + folder.string() +
                   "; sign it with " + remedy("make MISSION", folder));
  }
}

// Both vendors would find what is wrong with these files themselves, but only once the run has begun.
void require_documents_of(const std::string& service, std::string_view vendor,
                          const transport::Credentials& files, const X509& signer, const fs::path& folder,
                          std::int64_t now_s) {
  const std::string make = remedy("make MISSION", folder);
  if (!is_governance(signed_text(files.governance, signer, folder)))
    throw KeyError(files.governance.string() + " is another document; sign the right one with " + make);
  const auto grant = grant_of(signed_text(files.permissions, signer, folder));
  if (!grant || grant->subject != certificate::subject_of(service, vendor).text())
    throw KeyError(files.permissions.string() + " does not hold the permissions of " + service + " for " +
                   std::string(vendor) + "; sign them with " + make);
  if (now_s < grant->validity.begin || now_s >= grant->validity.end)
    throw KeyError(files.permissions.string() + " holds from " + date_text(grant->validity.begin) + " to " +
                   date_text(grant->validity.end) + ", and not as long as the certificate; sign it with " + make);
}

}  // namespace

fs::path default_key_folder() {
  const auto variable = [](const char* name) -> std::optional<std::string> {
    const char* value = std::getenv(name);
    return value == nullptr || *value == '\0' ? std::nullopt : std::optional<std::string>(value);
  };
  if (const auto keys = variable("ROCI_KEYS")) return *keys;
  if (const auto config = variable("XDG_CONFIG_HOME")) return fs::path(*config) / "rocinante/keys";
  if (const auto home = variable("HOME")) return fs::path(*home) / ".config/rocinante/keys";
  throw KeyError("there is neither ROCI_KEYS nor a home folder; name the key folder: --secure=FOLDER");
}

transport::Credentials files_of(const fs::path& folder, const std::string& service, std::string_view vendor) {
  const fs::path own = folder / "services" / service / vendor;
  const auto with = [&own](const char* ending) { return fs::path(own).concat(ending); };
  return {service,
          folder / "identity_authority.pem",
          with(".pem"),
          with(".key"),
          folder / "revoked.pem",
          folder / "permissions_authority.pem",
          folder / "governance.p7s",
          with(".permissions.p7s")};
}

transport::Credentials checked_credentials(const fs::path& given, const std::string& service,
                                           std::string_view vendor, std::int64_t now_s) {
  const fs::path folder = fs::absolute(given).lexically_normal();
  const auto files = files_of(folder, service, vendor);
  const std::string whose = "the certificate of " + service + " for " + std::string(vendor);
  require_private(folder, "key folder");
  std::error_code none;
  if (!fs::exists(files.certificate, none))
    throw KeyError(service + " has no certificate for " + std::string(vendor) + " in " + folder.string() +
                   "; make those of all services of a mission with " + remedy("make MISSION", folder));
  require_private(files.private_key, "private key");
  const auto authority = read_or_refuse(files.identity_authority, folder, read_certificate);
  const auto signer = read_or_refuse(files.permissions_authority, folder, read_certificate);
  const auto own = read_or_refuse(files.certificate, folder, read_certificate);
  const auto key = read_or_refuse(files.private_key, folder, read_key);
  const auto revoked = read_or_refuse(files.revoked, folder, read_revocation_list);
  const std::string renew = remedy(("renew " + service).c_str(), folder);
  if (!is_signed_by(*own, *authority))
    throw KeyError(whose + " is not from the authority of " + folder.string() + "; make another with " +
                   renew);
  if (!belongs_to(*own, key))
    throw KeyError(whose + " does not belong to its private key; make both with " + renew);
  if (subject_der(*own) != certificate::subject_of(service, vendor).der())
    throw KeyError(files.certificate.string() + " is the certificate of somebody else; make another with " +
                   renew);
  const Validity validity = validity_of(*own);
  if (now_s < validity.begin)
    throw KeyError(whose + " holds from " + date_text(validity.begin) + " on, and this host's clock shows " +
                   date_text(now_s) + "; set the clock");
  if (now_s >= validity.end)
    throw KeyError(whose + " ran out on " + date_text(validity.end) + "; make a new one with " + renew);
  if (now_s >= validity_of(*authority).end)
    throw KeyError("the authority of " + folder.string() + " ran out on " +
                   date_text(validity_of(*authority).end) + "; make another key folder");
  if (!is_signed_by(*revoked, *authority))
    throw KeyError(files.revoked.string() + " is not from the authority of " + folder.string() +
                   "; copy " + files.revoked.filename().string() + " from the ground's key folder");
  if (is_revoked(*own, *revoked)) throw KeyError(whose + " was revoked; make a new one with " + renew);
  require_documents_of(service, vendor, files, *signer, folder, now_s);
  return files;
}

std::string expiry_warning(const transport::Credentials& files, std::int64_t now_s) {
  const std::int64_t end = validity_of(*read_certificate(files.certificate)).end;
  const std::int64_t days = (end - now_s) / kDay;
  if (days >= kWarnDays) return "";
  return "the certificate of " + files.service + " runs out in " + std::to_string(days) + " days, on " +
         date_text(end) + "; from then on it does not start: roci-keys renew " + files.service;
}

std::string date_text(std::int64_t unix_s) {
  const std::time_t time = unix_s;
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &utc);
  return text;
}

}  // namespace roci::services::security
