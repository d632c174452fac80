// The Cyclone DDS transport: one participant whose types are all Sertype.
#include "services/transport/transport.hpp"

#include <map>
#include <mutex>

#include "services/certificate/guid_prefix.hpp"
#include "services/vendors/cyclonedds/credentials.hpp"
#include "services/vendors/cyclonedds/domain.hpp"
#include "services/vendors/cyclonedds/participants.hpp"
#include "services/vendors/cyclonedds/qos.hpp"
#include "services/vendors/cyclonedds/reader.hpp"
#include "services/vendors/cyclonedds/writer.hpp"

namespace roci::services::vendors::cyclonedds {
namespace {

QosPtr participant_qos(const transport::TransportOptions& options) {
  QosPtr qos(dds_create_qos());
  dds_qset_entity_name(qos.get(), options.participant.c_str());
  const std::string announcement = options.announcement.value_or("");
  dds_qset_userdata(qos.get(), announcement.data(), announcement.size());
  if (options.credentials) add_credentials(*options.credentials, qos.get());
  return qos;
}

QosPtr partition_qos(const std::vector<std::string>& partitions) {
  QosPtr qos(dds_create_qos());
  std::vector<const char*> names;
  for (const std::string& partition : partitions) names.push_back(partition.c_str());
  if (!names.empty()) dds_qset_partition(qos.get(), static_cast<std::uint32_t>(names.size()), names.data());
  return qos;
}

class CycloneTransport : public transport::Transport, public transport::RefusesDatagrams {
 public:
  explicit CycloneTransport(const transport::TransportOptions& options)
      : domain_(join_domain(options)),
        participant_(checked(dds_create_participant(static_cast<dds_domainid_t>(options.domain),
                                                    participant_qos(options).get(), nullptr),
                             "a participant in domain " + std::to_string(options.domain))),
        announcement_(options.announcement.value_or("")),
        secure_(options.credentials.has_value()) {
    try {
      if (secure_) require_certified(*options.credentials);
      participants_ = std::make_unique<Participants>(participant_);
    } catch (...) {
      dds_delete(participant_);
      throw;
    }
  }

  ~CycloneTransport() override {
    participants_.reset();
    dds_delete(participant_);
  }

  std::string_view vendor() const override { return "cyclonedds"; }

  std::unique_ptr<transport::Writer> create_writer(const transport::EndpointDescription& endpoint,
                                                   transport::WriterEvents events) override {
    return std::make_unique<CycloneWriter>(publisher_in(endpoint.partitions), topic_of(endpoint), endpoint,
                                           std::move(events));
  }

  std::unique_ptr<transport::Reader> create_reader(const transport::EndpointDescription& endpoint,
                                                   transport::ReaderEvents events) override {
    return std::make_unique<CycloneReader>(subscriber_in(endpoint.partitions), topic_of(endpoint), endpoint,
                                           std::move(events));
  }

  std::string announcement() const override { return announcement_; }
  std::optional<transport::Participant> participant_of(const transport::Guid& guid) override {
    return participants_->find(guid);
  }
  std::vector<transport::RefusedDatagrams> refused_datagrams() const override {
    auto refused = domain_->guard().refused();
    if (const std::uint64_t count = samples_of_too_many_keys())
      refused.push_back({"too_many_keys", count, ""});
    return refused;
  }
  bool speaks_as(const transport::Guid& writer, std::string_view sender) const override {
    return !secure_ || certificate::speaks_as(writer, sender);
  }

 private:
  // A library without DDS Security passes over the credentials without a word.
  void require_certified(const transport::Credentials& credentials) const {
    dds_guid_t guid;
    checked(dds_get_guid(participant_, &guid), "the identity of its participant");
    certificate::require_certified(to_guid(guid), credentials.service, vendor());
  }

  // DDS gives partitions to publishers and subscribers: there is one of each for the endpoints that share theirs.
  dds_entity_t publisher_in(const std::vector<std::string>& partitions) {
    const std::lock_guard lock(mutex_);
    dds_entity_t& publisher = publishers_[partitions];
    if (publisher == 0) {
      publisher = checked(dds_create_publisher(participant_, partition_qos(partitions).get(), nullptr),
                          "a publisher");
    }
    return publisher;
  }

  dds_entity_t subscriber_in(const std::vector<std::string>& partitions) {
    const std::lock_guard lock(mutex_);
    dds_entity_t& subscriber = subscribers_[partitions];
    if (subscriber == 0) {
      subscriber = checked(dds_create_subscriber(participant_, partition_qos(partitions).get(), nullptr),
                           "a subscriber");
    }
    return subscriber;
  }

  // Topics live as long as the participant; both ends of a topic share it.
  TopicHandle topic_of(const transport::EndpointDescription& endpoint) {
    const std::lock_guard lock(mutex_);
    auto& topic = topics_[endpoint.topic];
    if (topic.type && topic.type->type.name != endpoint.type.name) {
      throw transport::TransportError("topic " + endpoint.topic + " has the type " + topic.type->type.name +
                                      " in this participant, so it cannot have " + endpoint.type.name +
                                      " too");
    }
    if (topic.type) return topic;
    ddsi_sertype* type = make_sertype(endpoint.type);
    const dds_entity_t handle =
        dds_create_topic_sertype(participant_, endpoint.topic.c_str(), &type, nullptr, nullptr, nullptr);
    if (handle < 0) ddsi_sertype_unref(type);
    topic = {checked(handle, "the topic " + endpoint.topic), static_cast<const Sertype*>(type)};
    return topic;
  }

  const std::shared_ptr<Domain> domain_;
  const dds_entity_t participant_;
  const std::string announcement_;
  const bool secure_;
  std::unique_ptr<Participants> participants_;
  std::mutex mutex_;
  std::map<std::vector<std::string>, dds_entity_t> publishers_;
  std::map<std::vector<std::string>, dds_entity_t> subscribers_;
  std::map<std::string, TopicHandle> topics_;
};

}  // namespace
}  // namespace roci::services::vendors::cyclonedds

extern "C" std::unique_ptr<roci::services::transport::Transport> roci_create_transport(
    const roci::services::transport::TransportOptions& options) {
  return std::make_unique<roci::services::vendors::cyclonedds::CycloneTransport>(options);
}
