#include "arm_svc/arm_service.hpp"

#include <set>
#include <string>
#include <utility>

#include "arm_svc/setup_file.hpp"
#include "arm_svc/wire_service.hpp"
#include "core/mission/mission_file.hpp"
#include "services/node/make_event.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "services/worker.hpp"

namespace roci::arm {
namespace {

namespace topics = services::topics;

// So many refusals are told of, each once; names in them come from whoever asks.
constexpr std::size_t kReportedRefusals = 1'000;

class ArmService : public services::Service {
 public:
  ArmService(services::Node& node, ArmSetup setup, ArmModule module)
      : node_(node),
        module_(std::move(module)),
        model_(std::move(setup)),
        offers_(services::advertise(node, topics::function_offer)),
        events_(services::advertise(node, topics::event)),
        worker_(node) {
    offers_.write(function_offer(module_, node.options().name, model_.version()));
    for (const ResolvedPlace& pose : model_.poses()) {
      if (pose.status != MotionStatus::found) report("pose.unusable", pose.detail);
    }
    services::serve(node, topics::function_call, [this](const v1::FunctionRequest& request, auto responder) {
      if (request.module_name() == module_.name) on_function_call(request, responder);
    });
    services::serve(node, topics::arm_motion, [this](const v1::ArmMotionRequest& request, auto responder) {
      worker_.compute(
          [this, request](const std::stop_token& stop) { return find_motion(model_, request, stop); },
          [this, responder](v1::ArmMotionReply reply) {
            if (reply.outcome() != v1::MOTION_FOUND) report("motion.refused", reply.reason());
            responder.reply(std::move(reply));
          });
    });
  }

 private:
  void on_function_call(const v1::FunctionRequest& request,
                        services::Responder<v1::FunctionReply> responder) {
    worker_.compute(
        [this, request](const std::stop_token& stop) {
          return evaluate(cache_, model_, module_, request, stop);
        },
        [this, responder](FunctionAnswer answer) {
          for (const std::string& refusal : answer.refusals) {
            // Each refusal is told once, although every replanning asks again.
            if (reported_.size() < kReportedRefusals && reported_.insert(refusal).second)
              report("motion.refused", refusal);
          }
          answer.reply.owner(node_.options().name);
          answer.reply.computed_us(node_.now().count());
          responder.reply(std::move(answer.reply));
        });
  }

  void report(const std::string& code, const std::string& text) {
    events_.write(services::node::make_event(v1::SEVERITY_WARNING, code, text));
  }

  services::Node& node_;
  const ArmModule module_;
  const MotionModel model_;
  EstimateCache cache_;  // the worker's alone
  std::set<std::string> reported_;
  services::Publisher<v1::FunctionOffer> offers_;
  services::Publisher<v1::Event> events_;
  services::Worker worker_;
};

}  // namespace

std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings& settings) {
  const mission::Entry mission = mission::load_mission_file(settings.mission_file());
  const mission::Entry arm = mission.at("arm");
  arm.allow_only({"model", "poses", "module", "functions"});
  const mission::Entry model = arm.at("model"), poses = arm.at("poses");
  ArmSetup setup = load_setup(model.resolve(model.text()), poses.resolve(poses.text()));
  ArmModule module = read_module(arm, setup);
  return std::make_unique<ArmService>(node, std::move(setup), std::move(module));
}

}  // namespace roci::arm
