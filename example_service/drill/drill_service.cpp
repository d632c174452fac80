#include "drill_service.hpp"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include "services/owner/command_server.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "services/topics.hpp"
#include "services/wire/function_wire.hpp"

namespace borehole {
namespace {

using namespace std::chrono_literals;
namespace services = roci::services;
namespace owner = roci::services::owner;
namespace topics = roci::services::topics;
namespace wire = roci::services::wire;
namespace v1 = roci::v1;

constexpr double kSetUpS = 60, kPerMetreS = 400;
constexpr double kDeepestM = 5, kHardBelowM = 1;  // below that the bit jams once

double bore_s(double depth_m) { return kSetUpS + kPerMetreS * depth_m; }

roci::temporal::Duration duration_of(double seconds) {
  return std::chrono::duration_cast<roci::temporal::Duration>(std::chrono::duration<double>(seconds));
}

class Drill final : public services::Service, private owner::Driver {
 public:
  Drill(services::Node& node, const services::RunSettings& settings)
      : node_(node),
        offers_(services::advertise(node, topics::function_offer)),
        observations_(services::advertise(node, topics::observation)),
        commands_(node, *this) {
    // What this process was commanded outlives it: its next one carries nothing out twice.
    if (!settings.run_folder.empty())
      commands_.keep_in(settings.run_folder / (node.options().name + ".ledger"));
    offers_.write(wire::function_offer("drill", node.options().name, 1, functions_));
    services::serve(node, topics::function_call, [this](const v1::FunctionRequest& request, auto responder) {
      if (request.module_name() == "drill") responder.reply(answer(request));
    });
    node.at(0s, [this] { report("drill", "idle"); });
  }

 private:
  // The function: how long a hole takes, of each place that the planner asks for.
  v1::FunctionReply answer(const v1::FunctionRequest& request) const {
    const auto evaluate = [](const wire::OwnedFunction&, std::span<const v1::PlanObject* const> places,
                             v1::FunctionAccuracy) {
      const auto depth_m = wire::finite_property(*places[0], "depth");
      if (!depth_m) return wire::FunctionResult{v1::FUNCTION_UNKNOWN_OBJECT};
      if (*depth_m > kDeepestM) return wire::FunctionResult{v1::FUNCTION_UNREACHABLE};
      return wire::FunctionResult{v1::FUNCTION_VALUE, bore_s(*depth_m)};
    };
    v1::FunctionReply reply = wire::answer_batches(request, 1, functions_, evaluate, {});
    reply.owner(node_.options().name);
    reply.computed_us(node_.now().count());
    return reply;
  }

  // The commands: epochs, queries and repeated keys are the server's matter, what the drill does is ours.
  void carry_out(const owner::Request& request) override {
    if (request.command != "bore") {
      commands_.say(request.key, {owner::Stage::rejected, "unknown-command", "it can only bore"});
    } else if (running_) {
      commands_.say(request.key, {owner::Stage::rejected, "busy", "it still bores"});
    } else {
      const double depth_m = std::atof(request.arguments.at("depth").c_str());
      running_ = request.key;
      place_ = request.arguments.at("place");
      hard_ = depth_m > kHardBelowM;
      commands_.say(request.key, {owner::Stage::accepted});
      report("drill", "boring");
      timer_ = node_.after(duration_of(bore_s(depth_m)), [this] { bored(); });
    }
  }
  void bored() {
    // Nobody above has to plan for a bit that jams: there is time for a second try, or the step fails.
    if (std::exchange(hard_, false)) {
      if (!commands_.repair(*running_, "the bit jammed; it tries again"))
        return rest({owner::Stage::failed, "jammed", "the rock is hard, and no time is left"});
      timer_ = node_.after(30s, [this] { bored(); });
      return;
    }
    report("drill.hole." + place_, "bored");
    rest({owner::Stage::completed, "done", "", {.energy_j = 1200}});
  }
  void break_off(const owner::CommandKey&, const owner::CommandStatus& why) override {
    node_.cancel(timer_);
    rest(why);
  }
  void rest(const owner::CommandStatus& last) {
    report("drill", "idle");
    commands_.say(*std::exchange(running_, std::nullopt), last);
  }

  void report(const std::string& timeline, const std::string& state) {
    v1::Observation seen;
    seen.timeline(node_.options().robot + "." + timeline);
    seen.observed().kind(v1::VALUE_STATE);
    seen.observed().state(state);
    seen.sampled_us(node_.now().count());
    observations_.write(seen);
  }

  const std::vector<wire::OwnedFunction> functions_{{"bore_time", {"place"}, "s"}};
  services::Node& node_;
  services::Publisher<v1::FunctionOffer> offers_;
  services::Publisher<v1::Observation> observations_;
  owner::CommandServer commands_;
  std::optional<owner::CommandKey> running_;
  std::string place_;
  bool hard_ = false;
  services::Node::TimerId timer_ = 0;
};

}  // namespace

std::unique_ptr<services::Service> make_drill(services::Node& node, const services::RunSettings& settings) {
  return std::make_unique<Drill>(node, settings);
}

}  // namespace borehole
