// The peer on services/transport.hpp: what a process of ours does.
#include "roci_idl/goal.h"
#include "roci_idl/motion.h"
#include "services/security/key_folder.hpp"
#include "services/transport/plug_ins.hpp"
#include "services/transport/type_support.hpp"
#include "tests/contract/peer/backend.hpp"
#include "tests/contract/support/profiles.hpp"

namespace roci::contract_peer {
namespace {

namespace contract = services::contract;
using services::transport::Sample;
using services::transport::SampleKind;

services::transport::TransportOptions options_of(const Settings& settings) {
  services::transport::TransportOptions options{.domain = settings.domain,
                                                .participant = "peer",
                                                .address = settings.address,
                                                .peers = {settings.peer},
                                                .announcement = settings.announcement};
  if (!settings.keys.empty())
    options.credentials = services::security::files_of(settings.keys, settings.service, settings.vendor);
  return options;
}

services::transport::EndpointDescription requests() {
  return contract::endpoint<v1::PathRequest>("roci/path/request", "roci::v1::PathRequest",
                                             contract::request());
}

services::transport::EndpointDescription replies() {
  return contract::endpoint<v1::PathReply>("roci/path/reply", "roci::v1::PathReply", contract::request());
}

class TransportBackend : public Backend {
 public:
  TransportBackend(const Settings& settings, Handlers handlers)
      : settings_(settings),
        handlers_(std::move(handlers)),
        transport_(services::transport::open_transport(settings.vendor, options_of(settings))) {}

  void open_goal_writer() override { writer_ = transport_->create_writer(goals(), {handlers_.matched}); }
  void open_goal_reader() override {
    reader_ = transport_->create_reader(goals(),
                                        {[this](Sample&& sample) { take_goal(sample); }, handlers_.matched});
  }
  void open_path_server() override {
    writer_ = transport_->create_writer(replies(), {handlers_.matched});
    reader_ = transport_->create_reader(requests(), {[this](Sample&& sample) { take_call(sample); }, {}});
  }
  void open_path_client() override {
    writer_ = transport_->create_writer(requests(), {handlers_.matched});
    reader_ = transport_->create_reader(replies(), {[this](Sample&& sample) { take_answer(sample); }, {}});
  }
  void open_stranger() override {
    writer_ = transport_->create_writer(
        contract::endpoint<v1::Goal>("roci/path/request", "roci::v1::Goal", contract::request()),
        {handlers_.matched});
  }

  bool write(const Goal& goal) override {
    return writer_->write(contract::goal(goal.id, goal.priority, goal.issuer, settings_.run));
  }
  bool dispose(const Goal& goal) override {
    return writer_->dispose(contract::goal(goal.id, 0, goal.issuer));
  }

  bool call(const Call& call) override {
    v1::PathRequest request;
    request.request().request_id().writer_guid(call.client);
    request.request().request_id().sequence_number(call.sequence);
    request.goal_pose().x_m(call.x_m);
    request.goal_pose().y_m(call.y_m);
    return writer_->write(services::transport::serialize(request));
  }

  bool answer(const Answer& answer) override {
    v1::PathReply reply;
    reply.reply().related_request_id().writer_guid(answer.client);
    reply.reply().related_request_id().sequence_number(answer.sequence);
    reply.reply().remote_ex(static_cast<v1::RemoteException>(answer.remote_exception));
    reply.reply().remote_message(answer.message);
    reply.length_m(answer.length_m);
    reply.waypoints().resize(answer.waypoints);
    return writer_->write(services::transport::serialize(reply));
  }

 private:
  services::transport::EndpointDescription goals() const {
    auto description = contract::goal_endpoint(contract::latched(1));
    if (!settings_.partition.empty()) description.partitions = {settings_.partition};
    return description;
  }
  void take_goal(const Sample& sample) {
    v1::Goal goal;
    if (sample.kind == SampleKind::data && services::transport::deserialize(sample.payload, goal)) {
      handlers_.goal({goal.issuer(), goal.id(), goal.priority()});
    } else if (sample.kind != SampleKind::data &&
               services::transport::deserialize_key(sample.payload, goal)) {
      handlers_.goal_ended(sample.kind == SampleKind::disposed ? "disposed" : "lost",
                           {goal.issuer(), goal.id()});
    }
  }
  void take_call(const Sample& sample) {
    v1::PathRequest request;
    if (!services::transport::deserialize(sample.payload, request)) return;
    const auto& id = request.request().request_id();
    handlers_.call(
        {id.writer_guid(), id.sequence_number(), request.goal_pose().x_m(), request.goal_pose().y_m()});
  }
  void take_answer(const Sample& sample) {
    v1::PathReply reply;
    if (!services::transport::deserialize(sample.payload, reply)) return;
    const auto& id = reply.reply().related_request_id();
    handlers_.answer({id.writer_guid(), id.sequence_number(), static_cast<int>(reply.reply().remote_ex()),
                      reply.reply().remote_message(), reply.length_m(), reply.waypoints().size()});
  }

  const Settings settings_;
  Handlers handlers_;
  std::unique_ptr<services::transport::Transport> transport_;
  std::unique_ptr<services::transport::Writer> writer_;
  std::unique_ptr<services::transport::Reader> reader_;
};

}  // namespace

std::unique_ptr<Backend> make_backend(const Settings& settings, Handlers handlers) {
  return std::make_unique<TransportBackend>(settings, std::move(handlers));
}

}  // namespace roci::contract_peer
