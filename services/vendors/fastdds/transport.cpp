// The Fast DDS transport: one DomainParticipant whose types are all BytesType.
#include "services/transport/transport.hpp"

#include <fastrtps/xmlparser/XMLProfileManager.h>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <map>
#include <mutex>

#include "services/certificate/guid_prefix.hpp"
#include "services/vendors/fastdds/bytes_type.hpp"
#include "services/vendors/fastdds/guid.hpp"
#include "services/vendors/fastdds/own_port.hpp"
#include "services/vendors/fastdds/participants.hpp"
#include "services/vendors/fastdds/qos.hpp"
#include "services/vendors/fastdds/reader.hpp"
#include "services/vendors/fastdds/writer.hpp"
#include "services/vendors/peers.hpp"

namespace roci::services::vendors::fastdds {

namespace dds = eprosima::fastdds::dds;

namespace {

// Inside one process Fast DDS would call readers on the writing thread; participants here always use the
// network.
void switch_intraprocess_delivery_off() {
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
}

dds::PartitionQosPolicy partition_qos(const std::vector<std::string>& partitions) {
  dds::PartitionQosPolicy policy;
  for (const std::string& partition : partitions) policy.push_back(partition.c_str());
  return policy;
}

// Debian's version asserts, or stands still for ever, where a farewell meets the end of its sender's lease
// (docs/dds.md, quirk 20). Who leaves is given up when its lease is over.
guard::Policy policy_of(const transport::TransportOptions& options) {
  guard::Policy policy = guard::policy_of(options);
  policy.without_farewells = true;
  policy.bounds_ahead = true;
  return policy;
}

// Where key hashes arrive encrypted, or by another transport of the profile, nothing can stand in their place.
bool bounds_keys(const transport::TransportOptions& options) {
  return !options.credentials && options.vendor_xml.empty();
}

class FastTransport : public transport::Transport, public transport::RefusesDatagrams {
 public:
  explicit FastTransport(const transport::TransportOptions& options)
      : announcement_(options.announcement.value_or("")),
        secure_(options.credentials.has_value()),
        guard_(std::make_shared<guard::Guard>(policy_of(options))),
        slots_(bounds_keys(options) ? std::make_shared<KeySlots>() : nullptr),
        participants_(guard_) {
    if (options.vendor_xml.empty()) require_usable_addresses(options);
    switch_intraprocess_delivery_off();
    auto* factory = dds::DomainParticipantFactory::get_instance();
    // Between the choice of the port and its use somebody else may take it: the participant would be mute.
    constexpr int kAttempts = 5;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const std::uint16_t port = options.vendor_xml.empty() ? free_port(options.address) : 0;
      participant_ = factory->create_participant(
          static_cast<std::uint32_t>(options.domain), participant_qos(options, guard_, slots_, port),
          &participants_, dds::StatusMask::none());
      if (!participant_ || port == 0 || is_ours(port)) break;
      factory->delete_participant(participant_);
      participant_ = nullptr;
    }
    if (!participant_) {
      throw transport::TransportError(
          "Fast DDS cannot join domain " + std::to_string(options.domain) +
          "; the domain id must be from 0 to 232, its UDP ports must be free" +
          (secure_ ? ", and it must take the certificate and the signed documents of " +
                         options.credentials->service
                   : ""));
    }
    if (secure_) require_certified(*options.credentials);
    participants_.table.add(to_guid(participant_->guid()), {options.participant, announcement_});
  }

  ~FastTransport() override {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  std::string_view vendor() const override { return "fastdds"; }

  std::unique_ptr<transport::Writer> create_writer(const transport::EndpointDescription& endpoint,
                                                   transport::WriterEvents events) override {
    return std::make_unique<FastWriter>(publisher_in(endpoint.partitions), topic_of(endpoint), endpoint,
                                        std::move(events));
  }

  std::unique_ptr<transport::Reader> create_reader(const transport::EndpointDescription& endpoint,
                                                   transport::ReaderEvents events) override {
    return std::make_unique<FastReader>(subscriber_in(endpoint.partitions), topic_of(endpoint), endpoint,
                                        std::move(events), slots_);
  }

  std::string announcement() const override { return announcement_; }
  std::optional<transport::Participant> participant_of(const transport::Guid& guid) override {
    return participants_.table.find(guid);
  }
  std::vector<transport::RefusedDatagrams> refused_datagrams() const override { return guard_->refused(); }
  bool speaks_as(const transport::Guid& writer, std::string_view sender) const override {
    return !secure_ || certificate::speaks_as(writer, sender);
  }

 private:
  // DDS gives partitions to publishers and subscribers: there is one of each for the endpoints that share theirs.
  dds::Publisher& publisher_in(const std::vector<std::string>& partitions) {
    const std::lock_guard lock(mutex_);
    dds::Publisher*& publisher = publishers_[partitions];
    if (publisher) return *publisher;
    dds::PublisherQos qos;
    qos.partition() = partition_qos(partitions);
    publisher = participant_->create_publisher(qos);
    if (!publisher) throw transport::TransportError("Fast DDS refused a publisher");
    return *publisher;
  }

  dds::Subscriber& subscriber_in(const std::vector<std::string>& partitions) {
    const std::lock_guard lock(mutex_);
    dds::Subscriber*& subscriber = subscribers_[partitions];
    if (subscriber) return *subscriber;
    dds::SubscriberQos qos;
    qos.partition() = partition_qos(partitions);
    subscriber = participant_->create_subscriber(qos);
    if (!subscriber) throw transport::TransportError("Fast DDS refused a subscriber");
    return *subscriber;
  }

  // Topics live as long as the participant; both ends of a topic share it.
  dds::Topic& topic_of(const transport::EndpointDescription& endpoint) {
    const std::lock_guard lock(mutex_);
    auto& topic = topics_[endpoint.topic];
    if (topic && topic->get_type_name() != endpoint.type.name) {
      throw transport::TransportError("topic " + endpoint.topic + " has the type " + topic->get_type_name() +
                                      " in this participant, so it cannot have " + endpoint.type.name +
                                      " too");
    }
    if (topic) return *topic;
    if (!participant_->find_type(endpoint.type.name)) {
      dds::TypeSupport(new BytesType(endpoint.type, slots_)).register_type(participant_);
    }
    topic = participant_->create_topic(endpoint.topic, endpoint.type.name, dds::TOPIC_QOS_DEFAULT);
    if (!topic) throw transport::TransportError("Fast DDS refused the topic " + endpoint.topic);
    return *topic;
  }

  // A library without DDS Security passes over the credentials without a word.
  void require_certified(const transport::Credentials& credentials) {
    try {
      certificate::require_certified(to_guid(participant_->guid()), credentials.service, vendor());
    } catch (...) {
      dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
      throw;
    }
  }

  const std::string announcement_;
  const bool secure_;
  const std::shared_ptr<guard::Guard> guard_;
  const std::shared_ptr<KeySlots> slots_;
  Participants participants_;
  dds::DomainParticipant* participant_ = nullptr;
  std::mutex mutex_;
  std::map<std::vector<std::string>, dds::Publisher*> publishers_;
  std::map<std::vector<std::string>, dds::Subscriber*> subscribers_;
  std::map<std::string, dds::Topic*> topics_;
};

}  // namespace
}  // namespace roci::services::vendors::fastdds

extern "C" std::unique_ptr<roci::services::transport::Transport> roci_create_transport(
    const roci::services::transport::TransportOptions& options) {
  return std::make_unique<roci::services::vendors::fastdds::FastTransport>(options);
}
