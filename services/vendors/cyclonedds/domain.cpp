#include "services/vendors/cyclonedds/domain.hpp"

extern "C" {
#include <dds/ddsrt/log.h>
}

#include <filesystem>
#include <iostream>
#include <map>
#include <mutex>

#include "services/transport/rtps_ports.hpp"
#include "services/vendors/peers.hpp"

namespace roci::services::vendors::cyclonedds {
namespace {

dds_entity_t create(int id, const std::string& config) {
  const dds_entity_t handle = dds_create_domain(static_cast<dds_domainid_t>(id), config.c_str());
  if (handle < 0) {
    throw transport::TransportError(
        "Cyclone DDS cannot open domain " + std::to_string(id) + ": " + dds_strretcode(handle) +
        "; the domain id must be from 0 to 230, its configuration must be valid: " + config);
  }
  return handle;
}

// While a link is cut, every datagram to every port of every peer that cannot be sent would be a line of its
// own.
void log_to_standard_error(void*, const dds_log_data_t* entry) {
  const std::string_view message(entry->message, entry->size);
  if (message.find("conn_write") == message.npos) std::cerr << "cyclonedds: " << message;
}

}  // namespace

std::string configuration(const transport::TransportOptions& options) {
  std::string peers;
  for (const auto& peer : peers_of(options)) peers += "<Peer address=\"" + peer + "\"/>";
  // One datagram per 64 kB sample is fastest on loopback; on a network it would be fragmented by IP.
  const std::string message_size =
      is_loopback(options.address) ? "<MaxMessageSize>65500B</MaxMessageSize>" : "";
  return "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface address=\"" +
         options.address + "\" multicast=\"false\"/></Interfaces><AllowMulticast>false</AllowMulticast>" +
         message_size +
         "</General><Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>" +
         std::to_string(transport::kMaxParticipantsPerHost - 1) + "</MaxAutoParticipantIndex><Peers>" +
         peers + "</Peers><SPDPInterval>500ms</SPDPInterval><LeaseDuration>" + std::to_string(kLeaseSeconds) +
         "s</LeaseDuration></Discovery><Internal><GenerateKeyhash>true</"
         "GenerateKeyhash></Internal>"
         "</Domain></CycloneDDS>";
}

Domain::Domain(int id, std::string config) : config_(std::move(config)), handle_(create(id, config_)) {}

Domain::~Domain() { dds_delete(handle_); }

std::shared_ptr<Domain> join_domain(const transport::TransportOptions& options) {
  static std::mutex mutex;
  static std::map<int, std::weak_ptr<Domain>> domains;
  if (options.vendor_xml.empty()) require_usable_addresses(options);
  if (!options.vendor_xml.empty() && !std::filesystem::exists(options.vendor_xml)) {
    throw transport::TransportError("Cyclone DDS configuration " + options.vendor_xml + " does not exist");
  }
  const auto config = options.vendor_xml.empty() ? configuration(options) : options.vendor_xml;
  const std::lock_guard lock(mutex);
  auto domain = domains[options.domain].lock();
  if (domain && domain->config() != config) {
    throw transport::TransportError(
        "domain " + std::to_string(options.domain) +
        " is open in this process with another address, other peers or another configuration; "
        "Cyclone DDS keeps one per domain and process");
  }
  dds_set_log_sink(log_to_standard_error, nullptr);
  if (!domain) domains[options.domain] = domain = std::make_shared<Domain>(options.domain, config);
  return domain;
}

}  // namespace roci::services::vendors::cyclonedds
