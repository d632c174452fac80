// The peer on the API of Fast DDS with the PubSubTypes of fastddsgen: no line of services/ is in this
// program.
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <map>
#include <stdexcept>

#include "roci_idl/goalPubSubTypes.h"
#include "roci_idl/motionPubSubTypes.h"
#include "tests/contract/peer/backend.hpp"

namespace roci::contract_peer {
namespace {

namespace dds = eprosima::fastdds::dds;

template <class Entity>
Entity* checked(Entity* entity) {
  if (!entity) throw std::runtime_error("Fast DDS refused an entity");
  return entity;
}

class WriterListener : public dds::DataWriterListener {
 public:
  explicit WriterListener(Handlers& handlers) : handlers_(handlers) {}
  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) override {
    handlers_.matched(status.current_count);
  }

 private:
  Handlers& handlers_;
};

template <class T>
class ReaderListener : public dds::DataReaderListener {
 public:
  using Use = std::function<void(T&, const dds::SampleInfo&)>;
  explicit ReaderListener(Use use) : use_(std::move(use)) {}
  void on_data_available(dds::DataReader* reader) override {
    T value;
    dds::SampleInfo info;
    while (reader->take_next_sample(&value, &info) == ReturnCode_t::RETCODE_OK) use_(value, info);
  }

 private:
  Use use_;
};

// Transport settings come from FASTRTPS_DEFAULT_PROFILES_FILE.
class FastBackend : public Backend {
 public:
  FastBackend(const Settings& settings, Handlers handlers)
      : run_(settings.run), handlers_(std::move(handlers)), writer_listener_(handlers_) {
    auto* factory = dds::DomainParticipantFactory::get_instance();
    factory->load_profiles();
    dds::DomainParticipantQos participant_qos;
    factory->get_participant_qos_from_profile("lo", participant_qos);
    participant_qos.user_data().data_vec({settings.announcement.begin(), settings.announcement.end()});
    participant_ =
        checked(factory->create_participant(static_cast<std::uint32_t>(settings.domain), participant_qos));
    auto publisher_qos = dds::PUBLISHER_QOS_DEFAULT;
    auto subscriber_qos = dds::SUBSCRIBER_QOS_DEFAULT;
    if (!settings.partition.empty()) {
      publisher_qos.partition().push_back(settings.partition.c_str());
      subscriber_qos.partition().push_back(settings.partition.c_str());
    }
    publisher_ = checked(participant_->create_publisher(publisher_qos));
    subscriber_ = checked(participant_->create_subscriber(subscriber_qos));
  }
  ~FastBackend() override {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  void open_goal_writer() override { open_writer<v1::GoalPubSubType>("roci/goal", true); }
  void open_goal_reader() override {
    open_reader<v1::GoalPubSubType, v1::Goal>(
        "roci/goal", true, [this](v1::Goal& goal, const dds::SampleInfo& info) {
          // A Fast DDS reader gets no key with the end of an instance; it has to remember it.
          if (info.valid_data) {
            instances_[info.instance_handle] = {goal.issuer(), goal.id()};
            return handlers_.goal({goal.issuer(), goal.id(), goal.priority()});
          }
          handlers_.goal_ended(
              info.instance_state == dds::NOT_ALIVE_DISPOSED_INSTANCE_STATE ? "disposed" : "lost",
              instances_[info.instance_handle]);
        });
  }
  void open_path_server() override {
    open_writer<v1::PathReplyPubSubType>("roci/path/reply", false);
    open_reader<v1::PathRequestPubSubType, v1::PathRequest>(
        "roci/path/request", false, [this](v1::PathRequest& request, const dds::SampleInfo& info) {
          const auto& id = request.request().request_id();
          if (!info.valid_data) return;
          handlers_.call(
              {id.writer_guid(), id.sequence_number(), request.goal_pose().x_m(), request.goal_pose().y_m()});
        });
  }
  void open_path_client() override {
    open_writer<v1::PathRequestPubSubType>("roci/path/request", false);
    open_reader<v1::PathReplyPubSubType, v1::PathReply>(
        "roci/path/reply", false, [this](v1::PathReply& reply, const dds::SampleInfo& info) {
          const auto& id = reply.reply().related_request_id();
          if (!info.valid_data) return;
          handlers_.answer({id.writer_guid(), id.sequence_number(),
                            static_cast<int>(reply.reply().remote_ex()), reply.reply().remote_message(),
                            reply.length_m(), reply.waypoints().size()});
        });
  }
  void open_stranger() override { open_writer<v1::GoalPubSubType>("roci/path/request", false); }

  bool write(const Goal& goal) override {
    auto value = wire_goal(goal);
    return writer_->write(&value);
  }
  bool dispose(const Goal& goal) override {
    auto value = wire_goal(goal);
    return writer_->dispose(&value, dds::HANDLE_NIL) == ReturnCode_t::RETCODE_OK;
  }
  bool call(const Call& call) override {
    v1::PathRequest request;
    request.request().request_id().writer_guid(call.client);
    request.request().request_id().sequence_number(call.sequence);
    request.goal_pose().x_m(call.x_m);
    request.goal_pose().y_m(call.y_m);
    return writer_->write(&request);
  }
  bool answer(const Answer& answer) override {
    v1::PathReply reply;
    reply.reply().related_request_id().writer_guid(answer.client);
    reply.reply().related_request_id().sequence_number(answer.sequence);
    reply.reply().remote_ex(static_cast<v1::RemoteException>(answer.remote_exception));
    reply.reply().remote_message(answer.message);
    reply.length_m(answer.length_m);
    reply.waypoints().resize(answer.waypoints);
    return writer_->write(&reply);
  }

 private:
  v1::Goal wire_goal(const Goal& goal) const {
    v1::Goal value;
    value.header().run(run_);
    value.header().sender(goal.issuer);
    value.issuer(goal.issuer);
    value.id(goal.id);
    value.priority(goal.priority);
    return value;
  }

  template <class Type>
  dds::Topic* open_topic(const char* name) {
    const dds::TypeSupport type(new Type);
    type.register_type(participant_);
    return checked(participant_->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT));
  }

  template <class Qos>
  static Qos qos(bool latched) {
    Qos qos;
    qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = latched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
    qos.history().kind = latched ? dds::KEEP_LAST_HISTORY_QOS : dds::KEEP_ALL_HISTORY_QOS;
    qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.resource_limits().max_instances = 0;
    qos.resource_limits().max_samples = 0;
    qos.resource_limits().max_samples_per_instance = 0;
    qos.data_sharing().off();
    return qos;
  }

  template <class Type>
  void open_writer(const char* name, bool latched) {
    auto settings = qos<dds::DataWriterQos>(latched);
    settings.reliable_writer_qos().times.heartbeatPeriod = {0, 100'000'000};
    writer_ = checked(publisher_->create_datawriter(open_topic<Type>(name), settings, &writer_listener_));
  }

  template <class Type, class T>
  void open_reader(const char* name, bool latched, typename ReaderListener<T>::Use use) {
    reader_listener_ = std::make_unique<ReaderListener<T>>(std::move(use));
    checked(subscriber_->create_datareader(open_topic<Type>(name), qos<dds::DataReaderQos>(latched),
                                           reader_listener_.get()));
  }

  const std::string run_;
  Handlers handlers_;
  WriterListener writer_listener_;
  std::unique_ptr<dds::DataReaderListener> reader_listener_;
  std::map<dds::InstanceHandle_t, Goal> instances_;
  dds::DomainParticipant* participant_ = nullptr;
  dds::Publisher* publisher_ = nullptr;
  dds::Subscriber* subscriber_ = nullptr;
  dds::DataWriter* writer_ = nullptr;
};

}  // namespace

std::unique_ptr<Backend> make_backend(const Settings& settings, Handlers handlers) {
  return std::make_unique<FastBackend>(settings, std::move(handlers));
}

}  // namespace roci::contract_peer
