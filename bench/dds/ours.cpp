#include <cstdlib>
#include <stdexcept>

#include "bench/dds/port.hpp"
#include "roci_idl/function.h"
#include "roci_idl/motion.h"
#include "services/security/key_folder.hpp"
#include "services/transport/plug_ins.hpp"
#include "services/transport/scope.hpp"
#include "services/transport/type_support.hpp"

namespace roci::bench {
namespace {

using services::transport::QosSettings;
using services::transport::Sample;

constexpr std::size_t kTuples = 1000;

void encode(const Ball& ball, v1::PathRequest& request) {
  request.request().request_id().sequence_number(ball.sequence);
  request.header().sender("bench");
  request.goal_pose().x_m(ball.x_m);
  request.goal_pose().y_m(ball.y_m);
}
Ball decode(const v1::PathRequest& request) {
  return {request.request().request_id().sequence_number(), request.goal_pose().x_m(),
          request.goal_pose().y_m()};
}

void encode(const Ball& ball, v1::PathReply& reply) {
  reply.reply().related_request_id().sequence_number(ball.sequence);
  reply.header().sender("bench");
  reply.length_m(ball.x_m);
  reply.expected_s(ball.y_m);
}
Ball decode(const v1::PathReply& reply) {
  return {reply.reply().related_request_id().sequence_number(), reply.length_m(), reply.expected_s()};
}

void encode(const Ball& ball, v1::FunctionRequest& request) {
  request.request().request_id().sequence_number(ball.sequence);
  request.module_name("path");
  request.batches().resize(1);
  request.batches()[0].function("traverse_time");
  request.batches()[0].arity(2);
  for (std::uint32_t i = 0; i < kTuples; ++i) {
    request.batches()[0].tuples().push_back(i / 32);
    request.batches()[0].tuples().push_back(i % 32);
  }
}
Ball decode(const v1::FunctionRequest& request) {
  return {request.request().request_id().sequence_number(), 0, 0};
}

void encode(const Ball& ball, v1::FunctionReply& reply) {
  reply.reply().related_request_id().sequence_number(ball.sequence);
  reply.results().resize(1);
  reply.results()[0].numbers().assign(kTuples, 1.5);
  reply.results()[0].outcomes().assign(kTuples, v1::FUNCTION_VALUE);
}
Ball decode(const v1::FunctionReply& reply) {
  return {reply.reply().related_request_id().sequence_number(), 0, 0};
}

// In a secure run the client is the simulator, and the path planner serves it.
std::unique_ptr<services::transport::Transport> transport_of(const std::string& vendor,
                                                             const PortOptions& options) {
  services::transport::TransportOptions own{.domain = options.domain, .participant = "bench"};
  if (options.secure) {
    const char* keys = std::getenv(kKeysVariable);
    if (keys == nullptr) throw std::invalid_argument("kinds secure and secure_tuples need --secure=KEYS");
    own.credentials =
        services::security::files_of(keys, options.side == Side::client ? "sim_svc" : "pathplan_svc", vendor);
  }
  return services::transport::open_transport(vendor, own);
}

template <class Request, class Reply>
class OurPort : public Port {
 public:
  OurPort(const std::string& vendor, PortOptions options, const services::transport::TypeDescription& request,
          const services::transport::TypeDescription& reply)
      : client_(options.side == Side::client),
        on_ball_(std::move(options.on_ball)),
        transport_(transport_of(vendor, options)) {
    const QosSettings qos{.history_depth = 0, .max_samples = 4096};
    const auto partitions =
        services::transport::partitions_of(services::transport::Scope::robot, client_ ? "" : "rover");
    const services::transport::EndpointDescription requests{"roci/path/request", request, qos, partitions};
    const services::transport::EndpointDescription replies{"roci/path/reply", reply, qos, partitions};
    writer_ = transport_->create_writer(client_ ? requests : replies, {});
    reader_ = transport_->create_reader(client_ ? replies : requests,
                                        {[this](Sample&& sample) { take(sample); }, {}});
  }
  bool send(const Ball& ball) override { return client_ ? write<Request>(ball) : write<Reply>(ball); }
  bool matched() const override { return writer_->matched_readers() > 0 && reader_->matched_writers() > 0; }

 private:
  template <class T>
  bool write(const Ball& ball) {
    T value;
    encode(ball, value);
    return writer_->write(services::transport::serialize(value));
  }
  template <class T>
  void read(const Sample& sample) {
    T value;
    if (services::transport::deserialize(sample.payload, value)) on_ball_(decode(value));
  }
  void take(const Sample& sample) { client_ ? read<Reply>(sample) : read<Request>(sample); }

  const bool client_;
  const std::function<void(const Ball&)> on_ball_;
  std::unique_ptr<services::transport::Transport> transport_;
  std::unique_ptr<services::transport::Writer> writer_;
  std::unique_ptr<services::transport::Reader> reader_;
};

}  // namespace

std::unique_ptr<Port> open_ours(const std::string& vendor, PortOptions options) {
  return std::make_unique<OurPort<v1::PathRequest, v1::PathReply>>(
      vendor, std::move(options),
      services::transport::describe_type<v1::PathRequest>("roci::v1::PathRequest"),
      services::transport::describe_type<v1::PathReply>("roci::v1::PathReply"));
}

std::unique_ptr<Port> open_ours_with_tuples(const std::string& vendor, PortOptions options) {
  return std::make_unique<OurPort<v1::FunctionRequest, v1::FunctionReply>>(
      vendor, std::move(options),
      services::transport::describe_type<v1::FunctionRequest>("roci::v1::FunctionRequest"),
      services::transport::describe_type<v1::FunctionReply>("roci::v1::FunctionReply"));
}

}  // namespace roci::bench
