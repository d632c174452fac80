#include <thread>

#include "bench/dds/port.hpp"
#include "services/rpc.hpp"
#include "services/transport/plug_ins.hpp"

namespace roci::bench {
namespace {

using namespace std::chrono_literals;
using services::topics::path_request;

std::unique_ptr<services::transport::Transport> open_transport(const std::string& vendor, int domain) {
  return services::transport::open_transport(vendor, {.domain = domain, .participant = "bench"});
}

services::node::NodeOptions node_options(const std::string& name) {
  services::node::NodeOptions options;
  options.name = name;
  return options;
}

// The node's loop runs inside send(): the caller's thread is the service's thread.
class CallingPort : public Port {
 public:
  CallingPort(const std::string& vendor, PortOptions options)
      : on_ball_(std::move(options.on_ball)),
        node_(node_options("bench_client"), open_transport(vendor, options.domain)),
        client_(services::make_client(node_, path_request)) {}

  bool send(const Ball& ball) override {
    v1::PathRequest request;
    request.goal_pose().x_m(ball.x_m);
    request.goal_pose().y_m(ball.y_m);
    bool ended = false;
    bool answered = false;
    client_.call(request, "", 10s, [&](const services::CallResult<v1::PathReply>& result) {
      ended = true;
      answered = result.status == services::rpc::CallStatus::ok;
      if (answered) on_ball_({ball.sequence, result.reply.length_m(), 0});
    });
    while (!ended) node_.spin_once(100ms);
    return answered;
  }
  bool matched() const override { return true; }  // a call waits for its match itself

 private:
  const std::function<void(const Ball&)> on_ball_;
  services::Node node_;
  services::Client<v1::PathRequest, v1::PathReply> client_;
};

class ServingPort : public Port {
 public:
  ServingPort(const std::string& vendor, const PortOptions& options)
      : node_(node_options("bench_server"), open_transport(vendor, options.domain)) {
    services::serve(node_, path_request, [](const v1::PathRequest& request, auto responder) {
      v1::PathReply reply;
      reply.length_m(request.goal_pose().x_m());
      responder.reply(reply);
    });
    loop_ = std::jthread([this] { node_.run(); });
  }
  ~ServingPort() override { node_.stop(); }

  bool send(const Ball&) override { return false; }
  bool matched() const override { return true; }

 private:
  services::Node node_;
  std::jthread loop_;
};

}  // namespace

std::unique_ptr<Port> open_calls(const std::string& vendor, PortOptions options) {
  if (options.side == Side::server) return std::make_unique<ServingPort>(vendor, options);
  return std::make_unique<CallingPort>(vendor, std::move(options));
}

}  // namespace roci::bench
