#include "tests/unit/services/example_service.hpp"

#include "services/publisher.hpp"
#include "services/rpc.hpp"

namespace roci::example {
namespace {

using namespace std::chrono_literals;
namespace topics = services::topics;

class OdometerService : public services::Service {
 public:
  explicit OdometerService(services::Node& node)
      : node_(node),
        observations_(services::advertise(node, topics::observation)),
        paths_(services::make_client(node, topics::path_request)) {
    services::subscribe(node, topics::hazard, [this](const v1::Hazard& hazard) { on_hazard(hazard); });
    services::serve(node, topics::arm_motion, [](const v1::ArmMotionRequest&, auto responder) {
      responder.fail(v1::REMOTE_EX_UNSUPPORTED, "this example has no arm");
    });
    node.after(1s, [this] { tick(); });
  }

 private:
  void tick() {
    v1::Observation seen;
    seen.timeline("odometer.distance");
    seen.observed().kind(v1::VALUE_NUMBER);
    seen.observed().number(distance_m_);
    seen.sampled_us(node_.now().count());
    observations_.write(seen);
    node_.after(1s, [this] { tick(); });
  }

  void on_hazard(const v1::Hazard& hazard) {
    v1::PathRequest request;
    request.goal_pose().x_m(hazard.x_m());
    request.goal_pose().y_m(hazard.y_m());
    paths_.call(request, "pathplan_svc", 5s, [this](const services::CallResult<v1::PathReply>& result) {
      if (result.status == services::rpc::CallStatus::ok) distance_m_ += result.reply.length_m();
    });
  }

  services::Node& node_;
  services::Publisher<v1::Observation> observations_;
  services::Client<v1::PathRequest, v1::PathReply> paths_;
  double distance_m_ = 0;
};

}  // namespace

std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings&) {
  return std::make_unique<OdometerService>(node);
}

}  // namespace roci::example
