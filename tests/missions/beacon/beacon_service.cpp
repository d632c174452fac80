#include "tests/missions/beacon/beacon_service.hpp"

#include <optional>
#include <utility>

#include "services/owner/command_server.hpp"
#include "services/publisher.hpp"
#include "services/topics.hpp"

namespace roci::beacon {
namespace {

namespace owner = services::owner;
namespace topics = services::topics;
using namespace std::chrono_literals;

class Beacon final : public services::Service, private owner::Driver {
 public:
  explicit Beacon(services::Node& node)
      : node_(node), states_(services::advertise(node, topics::observation)), commands_(node, *this) {
    node.at(0s, [this] { report("dark"); });
  }

 private:
  void carry_out(const owner::Request& request) override {
    if (request.command != "light" && request.command != "darken") {
      commands_.say(request.key, {owner::Stage::rejected, "unknown-command", "it can light and darken"});
    } else if (running_) {
      commands_.say(request.key, {owner::Stage::rejected, "busy", "it still warms up"});
    } else {
      commands_.say(request.key, {owner::Stage::accepted});
      running_ = request.key;
      const bool light = request.command == "light";
      report("warming");
      timer_ = node_.after(light ? 14s : 4s, [this, light] {
        rest(light ? "lit" : "dark", {owner::Stage::completed, "done", "", {.energy_j = light ? 30.0 : 1.0}});
      });
    }
  }
  void break_off(const owner::CommandKey&, const owner::CommandStatus& why) override {
    node_.cancel(timer_);
    rest("dark", why);
  }
  void rest(const std::string& state, const owner::CommandStatus& last) {
    report(state);
    commands_.say(*std::exchange(running_, std::nullopt), last);
  }
  void report(const std::string& state) {
    v1::Observation seen;
    seen.timeline(node_.options().robot + ".beacon");
    seen.observed().kind(v1::VALUE_STATE);
    seen.observed().state(state);
    seen.sampled_us(node_.now().count());
    states_.write(seen);
  }

  services::Node& node_;
  services::Publisher<v1::Observation> states_;
  owner::CommandServer commands_;
  std::optional<owner::CommandKey> running_;
  services::Node::TimerId timer_ = 0;
};

}  // namespace

std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings&) {
  return std::make_unique<Beacon>(node);
}

}  // namespace roci::beacon
