// A subsystem for the tests of dedicated executives.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/owner/command_server.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::dedicated {

// A subsystem whose commands take 20 s and end as the script says: the newest word of it is used again and again.
class Wheels final : private services::owner::Driver {
 public:
  Wheels(services::Node& node, std::deque<std::string> script)
      : node_(node), script_(std::move(script)), commands_(node, *this) {}
  std::vector<std::string> begun, ways, cancelled;

 private:
  void carry_out(const services::owner::Request& request) override {
    begun.push_back(request.robot + "." + request.subsystem + " " + request.command + " " +
                    request.key.activity);
    if (request.arguments.contains("way")) ways.push_back(request.arguments.at("way"));
    commands_.say(request.key, {services::owner::Stage::accepted});
    running_ = request.key;
    const std::string how = script_.front();
    if (script_.size() > 1) script_.pop_front();
    if (how == "for-ever") return;
    if (how == "dies") node_.after(std::chrono::seconds(5), [] { throw services::Crash{}; });
    services::owner::Results results{{}, 5.0, {}};
    if (request.command == "merge") results.values["told_s"] = temporal::to_seconds(node_.now());
    timer_ = node_.after(std::chrono::seconds(20), [this, how, results] {
      const bool done = how == "done";
      commands_.say(*running_, {done ? services::owner::Stage::completed : services::owner::Stage::failed,
                                how, "", results});
    });
  }
  void break_off(const services::owner::CommandKey& key, const services::owner::CommandStatus& why) override {
    cancelled.push_back(key.activity);
    node_.cancel(timer_);
    commands_.say(key, why);
  }

  services::Node& node_;
  std::deque<std::string> script_;
  services::owner::CommandServer commands_;
  std::optional<services::owner::CommandKey> running_;
  services::Node::TimerId timer_ = 0;
};

}  // namespace roci::dedicated
