#include <dds/dds.h>

#include <atomic>
#include <cstring>
#include <stdexcept>

#include "bench/dds/port.hpp"
#include "motion.h"

namespace roci::bench {
namespace {

constexpr char kLoopback[] =
    "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface address=\"127.0.0.1\" "
    "multicast=\"false\"/>"
    "</Interfaces><AllowMulticast>false</AllowMulticast><MaxMessageSize>65500B</MaxMessageSize></"
    "General><Discovery>"
    "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>39</MaxAutoParticipantIndex>"
    "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>";

dds_entity_t checked(dds_entity_t entity) {
  if (entity < 0) throw std::runtime_error(dds_strretcode(entity));
  return entity;
}

template <class T>
T zero() {
  T value;
  std::memset(&value, 0, sizeof value);
  return value;
}

class CyclonePort : public Port {
 public:
  explicit CyclonePort(PortOptions options) : options_(std::move(options)) {
    domain_ = dds_create_domain(static_cast<dds_domainid_t>(options_.domain), kLoopback);
    participant_ =
        checked(dds_create_participant(static_cast<dds_domainid_t>(options_.domain), nullptr, nullptr));
    const auto requests = topic(roci_v1_PathRequest_desc, "roci/bench/request");
    const auto replies = topic(roci_v1_PathReply_desc, "roci/bench/reply");
    const bool client = options_.side == Side::client;
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
    dds_listener_t* listener = dds_create_listener(this);
    dds_lset_data_available(listener, client ? &CyclonePort::on_reply : &CyclonePort::on_request);
    writer_ = checked(dds_create_writer(participant_, client ? requests : replies, qos, nullptr));
    reader_ = checked(dds_create_reader(participant_, client ? replies : requests, qos, listener));
    dds_delete_listener(listener);
    dds_delete_qos(qos);
  }
  ~CyclonePort() override {
    dds_delete(participant_);
    if (domain_ > 0) dds_delete(domain_);
  }

  bool send(const Ball& ball) override {
    return options_.side == Side::client ? send_request(ball) : send_reply(ball);
  }
  bool matched() const override {
    dds_publication_matched_status_t readers;
    dds_subscription_matched_status_t writers;
    dds_get_publication_matched_status(writer_, &readers);
    dds_get_subscription_matched_status(reader_, &writers);
    return readers.current_count > 0 && writers.current_count > 0;
  }

 private:
  dds_entity_t topic(const dds_topic_descriptor_t& type, const char* name) {
    return checked(dds_create_topic(participant_, &type, name, nullptr, nullptr));
  }
  bool send_request(const Ball& ball) {
    auto request = zero<roci_v1_PathRequest>();
    request.request.request_id.sequence_number = ball.sequence;
    request.request.instance_name = empty_;
    request.header.sender = sender_;
    request.goal_pose.x_m = ball.x_m;
    request.goal_pose.y_m = ball.y_m;
    return dds_write(writer_, &request) == DDS_RETCODE_OK;
  }
  bool send_reply(const Ball& ball) {
    auto reply = zero<roci_v1_PathReply>();
    reply.reply.related_request_id.sequence_number = ball.sequence;
    reply.reply.remote_message = empty_;
    reply.header.sender = sender_;
    reply.reason = empty_;
    reply.length_m = ball.x_m;
    reply.expected_s = ball.y_m;
    return dds_write(writer_, &reply) == DDS_RETCODE_OK;
  }

  template <class T, class Decode>
  static void take(dds_entity_t reader, void* self, Decode decode) {
    void* samples[1] = {nullptr};
    dds_sample_info_t info;
    while (dds_take(reader, samples, &info, 1, 1) == 1) {
      if (info.valid_data)
        static_cast<CyclonePort*>(self)->options_.on_ball(decode(*static_cast<T*>(samples[0])));
      dds_return_loan(reader, samples, 1);
    }
  }
  static void on_request(dds_entity_t reader, void* self) {
    take<roci_v1_PathRequest>(reader, self, [](const roci_v1_PathRequest& request) {
      return Ball{request.request.request_id.sequence_number, request.goal_pose.x_m, request.goal_pose.y_m};
    });
  }
  static void on_reply(dds_entity_t reader, void* self) {
    take<roci_v1_PathReply>(reader, self, [](const roci_v1_PathReply& reply) {
      return Ball{reply.reply.related_request_id.sequence_number, reply.length_m, reply.expected_s};
    });
  }

  PortOptions options_;
  char empty_[1] = "";
  char sender_[6] = "bench";
  dds_entity_t domain_ = 0;
  dds_entity_t participant_ = 0;
  dds_entity_t writer_ = 0;
  dds_entity_t reader_ = 0;
};

}  // namespace

std::unique_ptr<Port> open_cyclonedds(PortOptions options) {
  return std::make_unique<CyclonePort>(std::move(options));
}

}  // namespace roci::bench
