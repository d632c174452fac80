#include "services/process/connection.hpp"

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/mission/entry.hpp"
#include "core/mission/mission_file.hpp"
#include "services/clock/wall.hpp"
#include "services/log/log.hpp"
#include "services/security/key_folder.hpp"

namespace roci::services::process {
namespace {

constexpr int kLargestDomain = 232;  // RTPS: the ports of larger ones do not exist
constexpr char kDefaultVendor[] = "fastdds";

int checked_domain(long long domain, const std::string& from) {
  if (domain >= 0 && domain <= kLargestDomain) return static_cast<int>(domain);
  throw std::invalid_argument(from + ": domain " + std::to_string(domain) + " is not between 0 and " +
                              std::to_string(kLargestDomain));
}

int parse_domain(const std::string& text, const std::string& from) {
  long long domain = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw std::invalid_argument(from + ": \"" + text + "\" is not a domain number");
  }
  return checked_domain(domain, from);
}

std::filesystem::path key_folder(const std::string& given) {
  const std::filesystem::path folder =
      given == kDefaultKeys ? security::default_key_folder() : std::filesystem::path(given);
  return std::filesystem::absolute(folder).lexically_normal();
}

void apply_mission_file(const std::filesystem::path& folder, Connection& connection) {
  if (folder.empty()) return;
  const auto mission = mission::load_mission_file(folder);
  connection.dds = mission.text_or("dds", connection.dds);
}

void apply_network_file(const std::filesystem::path& file, Connection& connection) {
  const auto network = mission::Entry::load(file);
  if (const auto partition = network.find("partition")) {
    partition->fail(
        "nobody sets a DDS partition: partitions follow from the robot that a service belongs to; remove "
        "'partition', and give runs that must not hear each other domains of their own");
  }
  network.allow_only({"dds", "domain", "address", "peers", "vendor_xml", "secure"});
  connection.dds = network.text_or("dds", connection.dds);
  auto& transport = connection.transport;
  if (const auto domain = network.find("domain")) {
    transport.domain = checked_domain(domain->integer(), domain->place());
  }
  transport.address = network.text_or("address", transport.address);
  if (const auto peers = network.find("peers")) transport.peers = peers->texts();
  if (const auto xml = network.find("vendor_xml")) transport.vendor_xml = xml->resolve(xml->text());
  if (const auto secure = network.find("secure"))
    connection.keys =
        key_folder(secure->text() == kDefaultKeys ? kDefaultKeys : secure->resolve(secure->text()).string());
  connection.network = std::filesystem::absolute(file).lexically_normal();
}

}  // namespace

Environment process_environment() {
  return [](const char* name) -> std::optional<std::string> {
    const char* value = std::getenv(name);
    return value == nullptr || *value == '\0' ? std::nullopt : std::optional<std::string>(value);
  };
}

std::vector<std::string> split_list(const std::string& list) {
  std::vector<std::string> parts;
  std::istringstream stream(list);
  for (std::string part; std::getline(stream, part, ',');) {
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

Connection resolve_connection(const ConnectionFlags& flags, const Environment& environment,
                              const std::filesystem::path& mission) {
  Connection connection;
  connection.dds = kDefaultVendor;
  apply_mission_file(mission, connection);

  const auto network = flags.network ? std::optional(flags.network->string()) : environment("ROCI_NETWORK");
  if (network) apply_network_file(*network, connection);

  const auto pick = [&](const std::optional<std::string>& flag, const char* variable) {
    return flag ? flag : environment(variable);
  };
  if (const auto dds = pick(flags.dds, "ROCI_DDS")) connection.dds = *dds;
  if (const auto address = pick(flags.address, "ROCI_ADDRESS")) connection.transport.address = *address;
  if (const auto peers = pick(flags.peers, "ROCI_PEERS")) connection.transport.peers = split_list(*peers);
  if (flags.domain) {
    connection.transport.domain = checked_domain(*flags.domain, "--domain");
  } else if (const auto domain = environment("ROCI_DOMAIN")) {
    connection.transport.domain = parse_domain(*domain, "ROCI_DOMAIN");
  }
  if (const auto secure = pick(flags.secure, "ROCI_SECURE")) connection.keys = key_folder(*secure);
  if (!connection.keys.empty() && !connection.transport.vendor_xml.empty()) {
    throw std::invalid_argument(
        "a secure run and vendor_xml: a vendor's own XML is used instead of all other settings, those of "
        "--secure included; "
        "leave one of them out");
  }
  if (!connection.keys.empty() && connection.dds == "inproc")
    throw std::invalid_argument(
        "a secure run over inproc: one process has no network; leave out --secure, or choose a vendor");
  return connection;
}

transport::TransportOptions admitted(const Connection& connection, const std::string& service) {
  transport::TransportOptions options = connection.transport;
  if (connection.keys.empty()) return options;
  const std::int64_t now_s = clock::unix_us() / 1'000'000;
  options.credentials = security::checked_credentials(connection.keys, service, connection.dds, now_s);
  if (const std::string warning = security::expiry_warning(*options.credentials, now_s); !warning.empty())
    log::warning(warning);
  return options;
}

}  // namespace roci::services::process
