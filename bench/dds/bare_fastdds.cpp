#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <stdexcept>

#include "bench/dds/port.hpp"
#include "roci_idl/motionPubSubTypes.h"

namespace roci::bench {
namespace {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

dds::DomainParticipantQos loopback() {
  dds::DomainParticipantQos qos;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {"127.0.0.1"};
  udp->maxInitialPeersRange = 40;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports = {udp};
  Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  locator.port = 0;
  IPLocator::setIPv4(locator, "127.0.0.1");
  qos.wire_protocol().builtin.metatrafficUnicastLocatorList.push_back(locator);
  qos.wire_protocol().builtin.initialPeersList.push_back(locator);
  qos.wire_protocol().default_unicast_locator_list.push_back(locator);
  return qos;
}

template <class Qos>
Qos reliable_keep_all() {
  Qos qos;
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_ALL_HISTORY_QOS;
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  return qos;
}

class FastPort : public Port, private dds::DataReaderListener {
 public:
  explicit FastPort(PortOptions options)
      : options_(std::move(options)), client_(options_.side == Side::client) {
    auto* factory = dds::DomainParticipantFactory::get_instance();
    participant_ = factory->create_participant(static_cast<std::uint32_t>(options_.domain), loopback());
    if (!participant_) throw std::runtime_error("Fast DDS refused a participant");
    auto* requests = topic(new v1::PathRequestPubSubType, "roci/bench/request");
    auto* replies = topic(new v1::PathReplyPubSubType, "roci/bench/reply");
    auto writer_qos = reliable_keep_all<dds::DataWriterQos>();
    writer_qos.reliable_writer_qos().times.heartbeatPeriod = {0, 100'000'000};
    writer_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT)
                  ->create_datawriter(client_ ? requests : replies, writer_qos);
    reader_ =
        participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT)
            ->create_datareader(client_ ? replies : requests, reliable_keep_all<dds::DataReaderQos>(), this);
    if (!writer_ || !reader_) throw std::runtime_error("Fast DDS refused an endpoint");
  }
  ~FastPort() override {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  bool send(const Ball& ball) override { return client_ ? send_request(ball) : send_reply(ball); }
  bool matched() const override {
    dds::PublicationMatchedStatus readers;
    dds::SubscriptionMatchedStatus writers;
    writer_->get_publication_matched_status(readers);
    reader_->get_subscription_matched_status(writers);
    return readers.current_count > 0 && writers.current_count > 0;
  }

 private:
  dds::Topic* topic(dds::TopicDataType* data_type, const char* name) {
    const dds::TypeSupport type(data_type);
    type.register_type(participant_);
    return participant_->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
  }
  bool send_request(const Ball& ball) {
    v1::PathRequest request;
    request.request().request_id().sequence_number(ball.sequence);
    request.header().sender("bench");
    request.goal_pose().x_m(ball.x_m);
    request.goal_pose().y_m(ball.y_m);
    return writer_->write(&request);
  }
  bool send_reply(const Ball& ball) {
    v1::PathReply reply;
    reply.reply().related_request_id().sequence_number(ball.sequence);
    reply.header().sender("bench");
    reply.length_m(ball.x_m);
    reply.expected_s(ball.y_m);
    return writer_->write(&reply);
  }
  void on_data_available(dds::DataReader* reader) override {
    client_ ? take<v1::PathReply>(reader) : take<v1::PathRequest>(reader);
  }
  template <class T>
  void take(dds::DataReader* reader) {
    T value;
    dds::SampleInfo info;
    while (reader->take_next_sample(&value, &info) == ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) options_.on_ball(decode(value));
    }
  }
  static Ball decode(const v1::PathRequest& request) {
    return {request.request().request_id().sequence_number(), request.goal_pose().x_m(),
            request.goal_pose().y_m()};
  }
  static Ball decode(const v1::PathReply& reply) {
    return {reply.reply().related_request_id().sequence_number(), reply.length_m(), reply.expected_s()};
  }

  const PortOptions options_;
  const bool client_;
  dds::DomainParticipant* participant_ = nullptr;
  dds::DataWriter* writer_ = nullptr;
  dds::DataReader* reader_ = nullptr;
};

}  // namespace

std::unique_ptr<Port> open_fastdds(PortOptions options) {
  return std::make_unique<FastPort>(std::move(options));
}

}  // namespace roci::bench
