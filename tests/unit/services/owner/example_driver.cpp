#include "tests/unit/services/owner/example_driver.hpp"

#include <chrono>
#include <optional>
#include <utility>

#include "services/owner/command_server.hpp"

namespace roci::example {
namespace {

using namespace std::chrono_literals;
namespace owner = services::owner;
namespace topics = services::topics;

class Drill final : public services::Service, private owner::Driver {
 public:
  explicit Drill(services::Node& node)
      : node_(node), states_(services::advertise(node, topics::observation)), commands_(node, *this) {
    node.after(0s, [this] { report("idle"); });
  }

 private:
  void carry_out(const owner::Request& request) override {
    if (request.command != "bore") {
      commands_.say(request.key, {owner::Stage::rejected, "unknown-command", "a drill can only bore"});
    } else if (running_) {
      commands_.say(request.key, {owner::Stage::rejected, "busy", "it still bores"});
    } else {
      commands_.say(request.key, {owner::Stage::accepted});
      running_ = request.key;
      hard_rock_ = request.arguments.contains("rock");
      report("boring");
      timer_ = node_.after(40s, [this] { bored(); });
    }
  }
  void break_off(const owner::CommandKey&, const owner::CommandStatus& why) override {
    node_.cancel(timer_);
    rest(why);
  }
  void bored() {
    if (!std::exchange(hard_rock_, false)) {
      rest({owner::Stage::completed, "done", "", {.energy_j = 1200, .values = {{"depth", 0.3}}}});
    } else if (commands_.repair(*running_, "it jammed and tries again")) {
      timer_ = node_.after(40s, [this] { bored(); });  // nobody above has to plan for that
    } else {
      rest({owner::Stage::failed, "jammed", "the rock is hard, and no time is left"});
    }
  }
  void rest(const owner::CommandStatus& last) {
    report("idle");
    commands_.say(*std::exchange(running_, std::nullopt), last);  // results come with the last status
  }
  void report(const std::string& state) {
    v1::Observation seen;
    seen.timeline("miner.drill");
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
  bool hard_rock_ = false;
};

}  // namespace

std::unique_ptr<services::Service> make_drill(services::Node& node) { return std::make_unique<Drill>(node); }

}  // namespace roci::example
