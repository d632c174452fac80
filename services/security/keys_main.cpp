// roci-keys makes, renews, revokes and lists the keys of secure runs; docs/security.md tells how to use it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <iostream>

#include "core/mission/entry.hpp"
#include "core/mission/service_list.hpp"
#include "services/clock/wall.hpp"
#include "services/security/authority.hpp"
#include "services/security/key_folder.hpp"
#include "services/security/x509.hpp"

namespace {

namespace security = roci::services::security;
namespace fs = std::filesystem;

// docs/exit-codes.md lists these.
enum ExitCode { kDone = 0, kSomeDoNotHold = 1, kBadInput = 2 };

struct Line {
  std::string keys;
  std::string mission;
  std::vector<std::string> services;
  std::string host;
  std::string target;
  int days = 365;
  std::function<int(const Line&)> verb;
};

std::int64_t now_s() { return roci::services::clock::unix_us() / 1'000'000; }

fs::path folder_of(const Line& line) {
  return fs::absolute(line.keys.empty() ? security::default_key_folder() : fs::path(line.keys))
      .lexically_normal();
}

int make(const Line& line) {
  const auto list = roci::mission::load_service_list(line.mission);
  auto authority = security::Authority::make(folder_of(line), now_s());
  authority.learn(list);
  const auto made = authority.issue_missing(line.days, now_s());
  std::cout << "keys in " << folder_of(line).string() << "\n";
  for (const std::string& service : made) std::cout << "  " << service << "\n";
  if (made.empty()) std::cout << "  every service had its certificates; what they may do is signed anew\n";
  return kDone;
}

int renew(const Line& line) {
  auto authority = security::Authority::open(folder_of(line));
  std::vector<std::string> services = line.services;
  if (services.empty())
    for (const auto& [name, what] : authority.issued().services) services.push_back(name);
  for (const std::string& service : services) {
    authority.renew(service, line.days, now_s());
    std::cout << service << " has new certificates; it uses them from its next start on\n";
  }
  return kDone;
}

int revoke(const Line& line) {
  auto authority = security::Authority::open(folder_of(line));
  for (const std::string& service : line.services) {
    const int count = authority.revoke(service, line.host, now_s());
    std::cout << count << " certificates of " << service << " are revoked\n";
  }
  std::cout << "copy " << (folder_of(line) / "revoked.pem").string()
            << " to the other hosts, and start the run anew: who has shaken hands already stays\n";
  return kDone;
}

int export_keys(const Line& line) {
  auto authority = security::Authority::open(folder_of(line));
  const fs::path target = fs::absolute(line.target).lexically_normal();
  authority.export_to(target, line.host, line.services, line.days, now_s());
  std::cout << "keys for " << line.host << " in " << target.string() << "; carry them there safely\n";
  return kDone;
}

std::string state_of(const security::IssuedCertificate& one, bool& holds) {
  holds = one.revoked == 0 && one.end > now_s();
  if (one.revoked != 0) return "revoked on " + security::date_text(one.revoked);
  const std::string date = security::date_text(one.end);
  if (!holds) return "ran out on " + date + "; roci-keys renew " + one.service;
  const bool soon = one.end - now_s() < security::kWarnDays * 24 * 3600;
  return "holds until " + date + (soon ? ", soon; roci-keys renew " + one.service : "");
}

// The newest certificate of each service, vendor and host counts:
// those before it are listed only if somebody may still use them.
int list(const Line& line) {
  const auto authority = security::Authority::open(folder_of(line));
  const auto& all = authority.issued().certificates;
  int code = kDone;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto same = [&](const security::IssuedCertificate& other) {
      return other.service == all[i].service && other.vendor == all[i].vendor && other.host == all[i].host;
    };
    const bool newest = std::none_of(all.begin() + static_cast<std::ptrdiff_t>(i) + 1, all.end(), same);
    bool holds = false;
    const std::string state = state_of(all[i], holds);
    if (!newest && !holds) continue;
    if (newest && !holds) code = kSomeDoNotHold;
    std::cout << all[i].service << (all[i].host.empty() ? "" : " at " + all[i].host) << ", " << all[i].vendor
              << ": " << state << (newest ? "" : " (an earlier one)") << "\n";
  }
  return code;
}

CLI::App* add_verb(CLI::App& app, Line& line, const char* name, const char* help, int (*verb)(const Line&)) {
  CLI::App* command = app.add_subcommand(name, help);
  command->add_option("--keys", line.keys,
                      "The key folder (default: $ROCI_KEYS, else ~/.config/rocinante/keys)");
  command->callback([&line, verb] { line.verb = verb; });
  return command;
}

void add_days(CLI::App* command, Line& line) {
  command->add_option("--days", line.days, "How long a certificate holds")
      ->check(CLI::Range(1, 3650))
      ->capture_default_str();
}

}  // namespace

int main(int argc, char** argv) {
  Line line;
  CLI::App app("Makes, renews, revokes and lists the keys of secure runs", "roci-keys");
  app.require_subcommand(1);
  auto* making =
      add_verb(app, line, "make", "An authority, and certificates for the services of a mission", make);
  making->add_option("mission", line.mission, "Mission folder")->required();
  add_days(making, line);
  auto* renewing =
      add_verb(app, line, "renew", "New keys and certificates for services (default: all)", renew);
  renewing->add_option("services", line.services, "Names of services");
  add_days(renewing, line);
  auto* revoking = add_verb(app, line, "revoke", "Take all certificates of services back", revoke);
  revoking->add_option("services", line.services, "Names of services")->required();
  revoking->add_option("--host", line.host, "Those that were exported to this host alone");
  auto* exporting =
      add_verb(app, line, "export", "A key folder for the services of another host", export_keys);
  exporting->add_option("folder", line.target, "The folder to make")->required();
  exporting->add_option("--host", line.host, "A name for the host, by which its certificates can be revoked")
      ->required();
  exporting->add_option("--services", line.services, "What runs there, separated by commas")
      ->delimiter(',')
      ->required();
  add_days(exporting, line);
  add_verb(app, line, "list", "All certificates, and until when they hold; code 1 if some do not", list);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kBadInput;
  }
  try {
    return line.verb(line);
  } catch (const std::exception& error) {
    std::cerr << "roci-keys: " << error.what() << "\n";
    return kBadInput;
  }
}
