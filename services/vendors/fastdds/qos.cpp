#include "services/vendors/fastdds/qos.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include "services/transport/rtps_ports.hpp"
#include "services/vendors/fastdds/guarded_transport.hpp"
#include "services/vendors/fastdds/own_port.hpp"
#include "services/vendors/peers.hpp"

namespace roci::services::vendors::fastdds {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastrtps::Duration_t;
using eprosima::fastrtps::rtps::Locator_t;

namespace {

constexpr std::uint32_t kSocketBuffer = 4 * 1024 * 1024;  // bytes; the host may grant less
constexpr int kMillisecond = 1'000'000;                   // in nanoseconds

// Port 0 as a peer: the first kMaxParticipantsPerHost ports of the domain.
Locator_t udp_locator(const std::string& address, int port = 0) {
  Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  locator.port = static_cast<std::uint32_t>(port);
  rtps::IPLocator::setIPv4(locator, address);
  return locator;
}

// Fast DDS takes a "file://" before an absolute path.
void add_credentials(const transport::Credentials& own, rtps::PropertyPolicy& policy) {
  const auto add = [&policy](const char* name, const std::string& value) {
    policy.properties().emplace_back(name, value);
  };
  const auto file = [](const std::filesystem::path& path) { return "file://" + path.string(); };
  add("dds.sec.auth.plugin", "builtin.PKI-DH");
  add("dds.sec.auth.builtin.PKI-DH.identity_ca", file(own.identity_authority));
  add("dds.sec.auth.builtin.PKI-DH.identity_certificate", file(own.certificate));
  add("dds.sec.auth.builtin.PKI-DH.identity_crl", file(own.revoked));
  add("dds.sec.auth.builtin.PKI-DH.private_key", file(own.private_key));
  add("dds.sec.access.plugin", "builtin.Access-Permissions");
  add("dds.sec.access.builtin.Access-Permissions.permissions_ca", file(own.permissions_authority));
  add("dds.sec.access.builtin.Access-Permissions.governance", file(own.governance));
  add("dds.sec.access.builtin.Access-Permissions.permissions", file(own.permissions));
  add("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
}

dds::DomainParticipantQos profile_of(const std::string& xml) {
  auto* factory = dds::DomainParticipantFactory::get_instance();
  factory->load_profiles();
  if (factory->load_XML_profiles_file(xml) != ReturnCode_t::RETCODE_OK) {
    throw transport::TransportError("Fast DDS cannot use the profiles in " + xml +
                                    "; see its messages on standard error");
  }
  factory->set_default_participant_qos(dds::PARTICIPANT_QOS_DEFAULT);
  dds::DomainParticipantQos qos;
  factory->get_default_participant_qos(qos);
  return qos;
}

// Of what the profile asks for; other kinds than UDP stay as they are.
void guard_transports(const std::shared_ptr<guard::Guard>& guard, dds::TransportConfigQos& transport) {
  using eprosima::fastdds::rtps::UDPTransportDescriptor;
  if (transport.use_builtin_transports) {
    transport.use_builtin_transports = false;
    transport.user_transports.push_back(
        std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>());
  }
  for (auto& descriptor : transport.user_transports)
    if (dynamic_cast<UDPTransportDescriptor*>(descriptor.get()))
      descriptor = guarded(descriptor, guard, nullptr);
}

void set_history(const transport::QosSettings& settings, dds::HistoryQosPolicy& history,
                 dds::ResourceLimitsQosPolicy& limits) {
  history.kind = settings.history_depth > 0 ? dds::KEEP_LAST_HISTORY_QOS : dds::KEEP_ALL_HISTORY_QOS;
  if (settings.history_depth > 0) history.depth = settings.history_depth;
  limits.max_samples = 0;               // no limit: Fast DDS allows none together with unlimited instances
  limits.max_instances = 0;             // the default is 10
  limits.max_samples_per_instance = 0;  // no limit
  limits.allocated_samples = 16;
}

}  // namespace

dds::DomainParticipantQos participant_qos(const transport::TransportOptions& options,
                                          const std::shared_ptr<guard::Guard>& guard,
                                          const std::shared_ptr<KeySlots>& slots, std::uint16_t port) {
  auto qos = options.vendor_xml.empty() ? dds::DomainParticipantQos() : profile_of(options.vendor_xml);
  qos.name(options.participant.c_str());
  const std::string announcement = options.announcement.value_or("");
  qos.user_data().data_vec({announcement.begin(), announcement.end()});
  if (!options.vendor_xml.empty()) {
    guard_transports(guard, qos.transport());
    return qos;
  }

  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {options.address};
  udp->sendBufferSize = kSocketBuffer;
  udp->receiveBufferSize = kSocketBuffer;
  udp->m_output_udp_socket = port;
  udp->maxInitialPeersRange = transport::kMaxParticipantsPerHost;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports = {guarded(udp, guard, slots)};

  auto& wire = qos.wire_protocol();
  wire.prefix = options.credentials ? candidate_naming(port) : prefix_naming(port);
  if (options.credentials) add_credentials(*options.credentials, qos.properties());
  auto& discovery = wire.builtin.discovery_config;
  discovery.leaseDuration = Duration_t(kLeaseSeconds, 0);
  discovery.leaseDuration_announcementperiod = Duration_t(0, 500 * kMillisecond);
  discovery.initial_announcements.count = 10;
  discovery.initial_announcements.period = Duration_t(0, 100 * kMillisecond);
  // Naming unicast locators keeps Fast DDS from adding the multicast one. It goes on from these ports to the
  // first that are free; left to itself it would count on with each participant that this process ever had,
  // out of sight of peers.
  const int first_port = transport::first_participant_port(options.domain);
  wire.builtin.metatrafficUnicastLocatorList.push_back(udp_locator(options.address, first_port));
  wire.default_unicast_locator_list.push_back(udp_locator(options.address, first_port + 1));
  for (const auto& peer : peers_of(options)) wire.builtin.initialPeersList.push_back(udp_locator(peer));
  return qos;
}

Duration_t blocking_time(const transport::QosSettings& settings) {
  return {settings.max_blocking_ms / 1000,
          static_cast<std::uint32_t>(settings.max_blocking_ms % 1000 * kMillisecond)};
}

dds::DataWriterQos writer_qos(const transport::QosSettings& settings) {
  dds::DataWriterQos qos;
  qos.reliability().kind =
      settings.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.reliability().max_blocking_time = blocking_time(settings);
  qos.durability().kind =
      settings.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  set_history(settings, qos.history(), qos.resource_limits());
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
  qos.data_sharing().off();
  qos.writer_data_lifecycle().autodispose_unregistered_instances = true;  // what is forgotten has ended
  // The default of 3 s would delay the first samples and every repair by as much.
  qos.reliable_writer_qos().times.heartbeatPeriod = Duration_t(0, 100 * kMillisecond);
  qos.reliable_writer_qos().times.nackResponseDelay = Duration_t(0, kMillisecond);
  return qos;
}

dds::DataReaderQos reader_qos(const transport::QosSettings& settings) {
  dds::DataReaderQos qos;
  qos.reliability().kind =
      settings.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind =
      settings.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  set_history(settings, qos.history(), qos.resource_limits());
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  // What comes is taken at once: only keys pile up here. With max_instances Debian's 2.9 takes no further key as long
  // as the writers of all stay, confirms no sample of one, and so stops their writers for good:
  // slots bound them instead (key_slots.hpp).
  qos.data_sharing().off();
  qos.reliable_reader_qos().times.initialAcknackDelay = Duration_t(0, 10 * kMillisecond);
  qos.reliable_reader_qos().times.heartbeatResponseDelay = Duration_t(0, 2 * kMillisecond);
  return qos;
}

}  // namespace roci::services::vendors::fastdds
