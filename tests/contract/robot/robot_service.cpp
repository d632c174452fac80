#include "tests/contract/robot/robot_service.hpp"

#include <set>
#include <utility>

#include "services/publisher.hpp"
#include "services/rpc.hpp"

namespace roci::services::contract {
namespace {

using namespace std::chrono_literals;

class RobotService : public Service {
 public:
  RobotService(Node& node, Say say)
      : node_(node),
        say_(std::move(say)),
        events_(advertise(node, topics::event)),
        goals_(advertise(node, topics::goal)),
        observations_(advertise(node, topics::observation)),
        paths_(make_client(node, topics::path_request)) {
    subscribe(node, topics::event, [this](const v1::Event& event) {
      hear("event", event.header());
      if (event.text() == std::to_string(kRounds)) say_("rounds " + event.header().sender());
    });
    subscribe(node, topics::goal, [this](const v1::Goal& goal) { hear("goal", goal.header()); });
    subscribe(node, topics::observation,
              [this](const v1::Observation& observation) { hear("observation", observation.header()); });
    serve(node, topics::path_request, [this](const v1::PathRequest& request, auto responder) {
      hear("request", request.header());
      responder.reply({});
    });
    node.after(100ms, [this] { write(); });
  }
  ~RobotService() override { say_("over"); }

 private:
  void hear(const std::string& kind, const v1::SampleHeader& header) {
    if (header.sender() == node_.options().name) return;
    const std::string line = "heard " + kind + " " + header.sender();
    if (heard_.insert(line).second) say_(line);
  }

  // Live, the rounds are counted anew for as long as the process runs, so that who joins late hears a last one, too.
  void write() {
    ++round_;
    v1::Observation seen;
    seen.timeline(node_.options().name);
    observations_.write(seen);
    v1::Goal goal;
    goal.issuer(node_.options().name);
    goal.id("look");
    goals_.write(goal);
    paths_.call({}, "", 1s, [](const CallResult<v1::PathReply>&) {});
    v1::Event event;
    event.text(std::to_string(round_ % (kRounds + 1)));
    events_.write(event);
    const bool simulated = clock::is_simulated(node_.options().clock);
    if (!simulated || round_ < kRounds) {
      node_.after(100ms, [this] { write(); });
    } else if (node_.options().clock == clock::ClockMode::master) {
      node_.after(3s, [this] { node_.stop(); });
    }
  }

  Node& node_;
  Say say_;
  Publisher<v1::Event> events_;
  Publisher<v1::Goal> goals_;
  Publisher<v1::Observation> observations_;
  Client<v1::PathRequest, v1::PathReply> paths_;
  std::set<std::string> heard_;
  int round_ = 0;
};

}  // namespace

std::unique_ptr<Service> make_robot_service(Node& node, Say say) {
  return std::make_unique<RobotService>(node, std::move(say));
}

}  // namespace roci::services::contract
