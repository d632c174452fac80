#include "services/security/issued.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "services/security/key_folder.hpp"
#include "services/security/private_file.hpp"

namespace roci::services::security {
namespace {

using nlohmann::json;

constexpr int kFormat = 1;

KnownService service_of(const json& entry) {
  KnownService service;
  service.robot = entry.at("robot");
  for (const std::string word : entry.at("roles"))
    if (const auto role = role_of(word)) service.roles.insert(*role);
  return service;
}

json as_json(const KnownService& service) {
  json roles = json::array();
  for (const Role role : service.roles) roles.push_back(word_of(role));
  return {{"roles", roles}, {"robot", service.robot}};
}

}  // namespace

Issued read_issued(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in)
    throw KeyError("there is no authority in " + file.parent_path().parent_path().string() +
                   "; name the folder that roci-keys make made, on the machine where it did");
  const json kept = json::parse(in, nullptr, false);
  try {
    if (kept.at("format") != kFormat)
      throw KeyError(file.string() + " is of another version of roci-keys; use that one");
    Issued issued;
    for (const auto& [name, entry] : kept.at("services").items()) issued.services[name] = service_of(entry);
    for (const json& entry : kept.at("certificates"))
      issued.certificates.push_back({entry.at("service"), entry.at("vendor"), entry.at("host"),
                                     entry.at("serial"), entry.at("end"), entry.at("revoked")});
    return issued;
  } catch (const json::exception&) {
    throw KeyError(file.string() + " is damaged; restore it, or make another key folder");
  }
}

void write_issued(const std::filesystem::path& file, const Issued& issued) {
  json services = json::object(), certificates = json::array();
  for (const auto& [name, service] : issued.services) services[name] = as_json(service);
  for (const IssuedCertificate& one : issued.certificates) {
    certificates.push_back({{"service", one.service},
                            {"vendor", one.vendor},
                            {"host", one.host},
                            {"serial", one.serial},
                            {"end", one.end},
                            {"revoked", one.revoked}});
  }
  write_private(
      file, json{{"format", kFormat}, {"services", services}, {"certificates", certificates}}.dump(2) + "\n");
}

}  // namespace roci::services::security
