#include "tests/scenario/scripted_world/camera_robot.hpp"

#include <utility>

namespace roci::scenario {

namespace owner = services::owner;
using namespace std::chrono_literals;

CameraRobot::CameraRobot(services::Node& node)
    : node_(node),
      observations_(services::advertise(node, services::topics::observation)),
      commands_(node, *this) {
  node.at(0s, [this] {
    observe("rover.nav", "idle-at", {"here"});
    observe("rover.arm", "idle-pose", {"stow"});
    observe("rover.radio", "idle");
    observe("rover.gripper", "empty");
    observe("rover.camera", "idle");
    for (const char* place : {"rover.x", "rover.y"}) measure(place, 40);
    measure("rover.battery", 900000);
  });
}

void CameraRobot::observe(const std::string& timeline, const std::string& state,
                          std::vector<std::string> arguments) {
  v1::Observation seen;
  seen.timeline(timeline);
  seen.observed().kind(v1::VALUE_STATE);
  seen.observed().state(state);
  seen.observed().arguments(std::move(arguments));
  seen.sampled_us(node_.now().count());
  observations_.write(seen);
}

void CameraRobot::measure(const std::string& timeline, double number) {
  v1::Observation seen;
  seen.timeline(timeline);
  seen.observed().kind(v1::VALUE_NUMBER);
  seen.observed().number(number);
  seen.sampled_us(node_.now().count());
  observations_.write(seen);
}

void CameraRobot::carry_out(const owner::Request& request) {
  if (request.command != "image" || running_) {
    commands_.say(request.key, {owner::Stage::rejected, "busy", "one image at a time"});
    return;
  }
  const std::string image = request.arguments.at("image");
  ++begun_[image];
  running_ = request.key;
  commands_.say(request.key, {owner::Stage::accepted});
  observe("rover.camera", "imaging");
  timer_ = node_.after(10s, [this, image] {
    if (std::exchange(broken_, broken_ == image ? "" : broken_) == image)
      return end({owner::Stage::failed, "shutter", "the shutter is stuck"});
    observe("rover.image." + image, "sent");
    end({owner::Stage::completed});
  });
}

void CameraRobot::break_off(const owner::CommandKey&, const owner::CommandStatus& why) {
  node_.cancel(timer_);
  end(why);
}

void CameraRobot::end(const owner::CommandStatus& last) {
  observe("rover.camera", "idle");
  commands_.say(*std::exchange(running_, std::nullopt), last);
}

}  // namespace roci::scenario
