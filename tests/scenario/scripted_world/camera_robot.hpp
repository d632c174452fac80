// A robot that stands still and takes images, 10 s each, on the owner's kit; it counts what it has begun.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "services/node.hpp"
#include "services/owner/command_server.hpp"
#include "services/publisher.hpp"

namespace roci::scenario {

class CameraRobot final : private services::owner::Driver {
 public:
  explicit CameraRobot(services::Node& node);

  void observe(const std::string& timeline, const std::string& state,
               std::vector<std::string> arguments = {});
  // The next attempt at an image of this name fails.
  void break_shutter_for(const std::string& image) { broken_ = image; }
  // How often each image was begun.
  const std::map<std::string, int>& begun() const { return begun_; }

 private:
  void carry_out(const services::owner::Request& request) override;
  void break_off(const services::owner::CommandKey& key, const services::owner::CommandStatus& why) override;
  void end(const services::owner::CommandStatus& last);
  void measure(const std::string& timeline, double number);

  services::Node& node_;
  services::Publisher<v1::Observation> observations_;
  services::owner::CommandServer commands_;
  std::optional<services::owner::CommandKey> running_;
  services::Node::TimerId timer_ = 0;
  std::string broken_;
  std::map<std::string, int> begun_;
};

}  // namespace roci::scenario
