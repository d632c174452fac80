#include "participant.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <stdexcept>
#include <string_view>

#include "contract.h"

namespace borehole {
namespace {

template <class Entity>
Entity* checked(Entity* entity) {
  if (entity == nullptr) throw std::runtime_error("Fast DDS refused an entity");
  return entity;
}

// Loopback; docs/dds.md says what to change for several hosts.
dds::DomainParticipantQos settings() {
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {"127.0.0.1"};
  udp->maxInitialPeersRange = 40;
  qos.transport().user_transports = {udp};
  qos.transport().use_builtin_transports = false;
  eprosima::fastrtps::rtps::Locator_t loopback;
  eprosima::fastrtps::rtps::IPLocator::setIPv4(loopback, "127.0.0.1");
  auto& wire = qos.wire_protocol();
  wire.builtin.metatrafficUnicastLocatorList.push_back(loopback);
  wire.builtin.initialPeersList.push_back(loopback);
  wire.default_unicast_locator_list.push_back(loopback);
  auto& discovery = wire.builtin.discovery_config;
  discovery.leaseDuration = {3, 0};
  discovery.leaseDuration_announcementperiod = {1, 0};
  discovery.initial_announcements = {10, {0, 100'000'000}};
  constexpr std::string_view contract = ROCI_ANNOUNCEMENT;  // the types that we know
  qos.user_data().data_vec({contract.begin(), contract.end()});
  return qos;
}

template <class Qos>
Qos qos_of(Durability durability, bool barriered) {
  Qos qos;
  const bool state = durability == Durability::state;
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind =
      barriered || state ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  // The simulated clock loses nothing and overwrites nothing.
  qos.history().kind = barriered || state ? dds::KEEP_LAST_HISTORY_QOS : dds::KEEP_ALL_HISTORY_QOS;
  qos.history().depth = barriered ? 512 : 1;
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.resource_limits().max_instances = 0;  // without bound, as are the others
  qos.resource_limits().max_samples = 0;
  qos.resource_limits().max_samples_per_instance = 0;
  qos.data_sharing().off();
  return qos;
}

}  // namespace

void Inbox::wait(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, longest, [this] { return something_; });
  something_ = false;
}

void Inbox::on_data_available(dds::DataReader*) {
  const std::lock_guard lock(mutex_);
  something_ = true;
  changed_.notify_one();
}

Participant::Participant(const Options& options) : options_(options) {
  participant_ =
      checked(dds::DomainParticipantFactory::get_instance()->create_participant(options.domain, settings()));
  for (const bool inner : {false, true}) {
    auto publisher = dds::PUBLISHER_QOS_DEFAULT;
    auto subscriber = dds::SUBSCRIBER_QOS_DEFAULT;
    const std::string partition = "roci.inner." + options.robot;
    if (inner) publisher.partition().push_back(partition.c_str());
    if (inner) subscriber.partition().push_back(partition.c_str());
    publishers_[inner] = checked(participant_->create_publisher(publisher));
    subscribers_[inner] = checked(participant_->create_subscriber(subscriber));
  }
}

Participant::~Participant() {
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

dds::Topic* Participant::open_topic(const dds::TypeSupport& type, const std::string& name) {
  type.register_type(participant_);
  return checked(participant_->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT));
}

dds::DataWriter* Participant::open_writer(const dds::TypeSupport& type, const std::string& topic,
                                          Durability durability, bool clocked) {
  auto qos = qos_of<dds::DataWriterQos>(durability, clocked && options_.simulated);
  qos.reliable_writer_qos().times.heartbeatPeriod = {0, 100'000'000};  // its default makes first samples late
  return checked(publishers_[clocked]->create_datawriter(open_topic(type, topic), qos));
}

dds::DataReader* Participant::open_reader(const dds::TypeSupport& type, const std::string& topic,
                                          Durability durability, bool clocked) {
  const auto qos = qos_of<dds::DataReaderQos>(durability, clocked && options_.simulated);
  return checked(subscribers_[clocked]->create_datareader(open_topic(type, topic), qos, &inbox_));
}

}  // namespace borehole
