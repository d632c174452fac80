#include "services/vendors/cyclonedds/domain.hpp"

extern "C" {
#include <dds/ddsrt/log.h>
}

#include <arpa/inet.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <mutex>
#include <string_view>

#include "services/transport/rtps_ports.hpp"
#include "services/vendors/cyclonedds/sockets.hpp"
#include "services/vendors/peers.hpp"

namespace roci::services::vendors::cyclonedds {
namespace {

// A vendor's own XML says itself where its sockets are.
std::optional<std::uint32_t> address_of(const transport::TransportOptions& options) {
  in_addr address{};
  if (!options.vendor_xml.empty() || inet_pton(AF_INET, options.address.c_str(), &address) != 1)
    return std::nullopt;
  return ntohl(address.s_addr);
}

dds_entity_t create(const transport::TransportOptions& options, const std::string& config,
                    const std::shared_ptr<guard::Guard>& guard) {
  const GuardedOpening opening(guard, address_of(options), options.credentials.has_value());
  const dds_entity_t handle = dds_create_domain(static_cast<dds_domainid_t>(options.domain), config.c_str());
  if (handle < 0) {
    throw transport::TransportError(
        "Cyclone DDS cannot open domain " + std::to_string(options.domain) + ": " + dds_strretcode(handle) +
        "; the domain id must be from 0 to 230, its configuration must be valid: " + config);
  }
  if (opening.bound() > 0) return handle;
  dds_delete(handle);
  throw transport::TransportError(
      "Cyclone DDS opened sockets that nothing guards; use another transport with --dds");
}

// While a link is cut, every datagram to every port of every peer that cannot be sent would be a line of its own; so
// would every sample that does not decode: of each ten seconds the first twenty lines are logged.
void log_to_standard_error(void*, const dds_log_data_t* entry) {
  constexpr int kLines = 20;
  constexpr std::chrono::seconds kWindow{10};
  static std::mutex mutex;
  static std::chrono::steady_clock::time_point begin;
  static int lines = 0;
  std::string_view message(entry->message, entry->size);
  if (message.find("conn_write") != message.npos) return;
  while (message.ends_with('\n')) message.remove_suffix(1);
  const std::lock_guard lock(mutex);
  const auto now = std::chrono::steady_clock::now();
  if (now - begin > kWindow) {
    if (lines > kLines) std::cerr << "cyclonedds: and " << lines - kLines << " lines more" << std::endl;
    begin = now;
    lines = 0;
  }
  if (++lines <= kLines) std::cerr << "cyclonedds: " << message << std::endl;
}

}  // namespace

std::string configuration(const transport::TransportOptions& options) {
  std::string peers;
  for (const auto& peer : peers_of(options)) peers += "<Peer address=\"" + peer + "\"/>";
  // One datagram per 64 kB sample is fastest on loopback, and one fragment spares Fast DDS readers what they cannot do
  // (docs/dds.md, "Quirks of these versions", 22); on a network it would be fragmented by IP. There a datagram has up
  // to 14,720 B, and a fragment is large enough for discovery in one piece, or the guard would refuse it.
  const std::string message_size =
      is_loopback(options.address)
          ? "<MaxMessageSize>65500B</MaxMessageSize><FragmentSize>60000B</FragmentSize>"
          : "<FragmentSize>8000B</FragmentSize>";
  return "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface address=\"" +
         options.address + "\" multicast=\"false\"/></Interfaces><AllowMulticast>false</AllowMulticast>" +
         message_size +
         "</General><Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>" +
         std::to_string(transport::kMaxParticipantsPerHost - 1) + "</MaxAutoParticipantIndex><Peers>" +
         peers + "</Peers><SPDPInterval>500ms</SPDPInterval><LeaseDuration>" + std::to_string(kLeaseSeconds) +
         "s</LeaseDuration></Discovery><Internal><GenerateKeyhash>true</GenerateKeyhash></Internal></Domain>"
         "</CycloneDDS>";
}

Domain::Domain(const transport::TransportOptions& options, std::string config)
    : guard_(std::make_shared<guard::Guard>(guard::policy_of(options))),
      config_(std::move(config)),
      secure_(options.credentials.has_value()),
      handle_(create(options, config_, guard_)) {}

Domain::~Domain() { dds_delete(handle_); }

std::shared_ptr<Domain> join_domain(const transport::TransportOptions& options) {
  static std::mutex mutex;
  static std::map<int, std::weak_ptr<Domain>> domains;
  if (options.vendor_xml.empty()) require_usable_addresses(options);
  if (!options.vendor_xml.empty() && !std::filesystem::exists(options.vendor_xml)) {
    throw transport::TransportError("Cyclone DDS configuration " + options.vendor_xml + " does not exist");
  }
  const auto config = options.vendor_xml.empty() ? configuration(options) : options.vendor_xml;
  const bool secure = options.credentials.has_value();
  const std::lock_guard lock(mutex);
  auto domain = domains[options.domain].lock();
  if (domain && (domain->config() != config || domain->secure() != secure)) {
    throw transport::TransportError("domain " + std::to_string(options.domain) +
                                    " is open in this process with another address, other peers or another "
                                    "configuration, or one is secure and the other is not; Cyclone DDS keeps "
                                    "one per domain and process");
  }
  dds_set_log_sink(log_to_standard_error, nullptr);
  if (!domain) domains[options.domain] = domain = std::make_shared<Domain>(options, config);
  return domain;
}

}  // namespace roci::services::vendors::cyclonedds
