#include "sim_svc/nav.hpp"

#include <charconv>
#include <cmath>
#include <utility>

namespace roci::sim {
namespace {

std::optional<double> number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

// The first reason why the rover must not move, by its own interlocks.
Ending interlock(const RobotView& view, const RobotNames& names) {
  if (view.arm != State{"idle-pose", {names.stow_pose}}) {
    return Failure{"arm-not-stowed", "the arm is not at pose '" + names.stow_pose + "'; move it there first"};
  }
  if (view.camera.name != "idle") return Failure{"camera-busy", "the camera is taking an image; wait for it"};
  if (view.gripper.name == "working") return Failure{"gripper-busy", "the gripper is working; wait for it"};
  return std::nullopt;
}

}  // namespace

Nav::Nav(const Pose& start, const RobotNames& names, std::uint64_t seed)
    : pose_(start), place_(names.stop_place), stop_place_(names.stop_place), noise_(seed, "drive") {}

State Nav::state() const {
  return target_ ? State{"going-to", {target_->place}} : State{"idle-at", {place_}};
}

Ending Nav::begin(const Task& task, Time, Surroundings& around) {
  const auto x = number(task.arguments.at("x"));
  const auto y = number(task.arguments.at("y"));
  if (!x || !y) return Failure{"bad-arguments", "drive: x and y must be numbers, in metres"};
  if (Ending refused = interlock(around.view, around.robot.names)) return refused;
  target_ = Target{task.key, task.arguments.at("to"), *x, *y};
  detours_ = 0;
  around.out.push_back(wish());
  return std::nullopt;
}

Ending Nav::follow(std::vector<terrain::Point> way, Time now, Surroundings& around) {
  if (way.empty()) return Failure{"no-path", "the path has no way-points"};
  way_ = std::move(way);
  trace_ = simulate_drive(around.ground, around.robot.drive, now, pose_, way_, 0, noise_);
  return std::nullopt;
}

void Nav::look_again(Time now, Surroundings& around) {
  if (!trace_) return;
  const DriveSample sample = trace_->at(now);
  pose_ = sample.pose;
  trace_ = simulate_drive(around.ground, around.robot.drive, now, pose_, way_, sample.next_waypoint, noise_);
}

std::optional<Time> Nav::next_change() const {
  if (trace_) return trace_->end;
  return looks_until_;
}

Ending Nav::finish(Surroundings& around) {
  if (looks_until_) {
    looks_until_.reset();
    around.out.push_back(wish());
    return std::nullopt;
  }
  const DriveTrace trace = *std::exchange(trace_, std::nullopt);
  pose_ = trace.samples.back().pose;
  const std::string rock = trace.outcome == DriveEnd::blocked ? see_rock(trace, around) : "";
  if (!rock.empty() && detours_ < around.robot.drive.detours) {
    ++detours_;
    looks_until_ = trace.end + seconds(around.robot.drive.look_s);
    around.out.push_back(Ack{target_->key, Stage::accepted, "repairing",
                             rock + " lies on the way and on no map; it looks for a way around", trace.end});
    return std::nullopt;
  }
  stand(trace.outcome == DriveEnd::arrived ? target_->place : stop_place_);
  switch (trace.outcome) {
    case DriveEnd::arrived:
      return std::nullopt;
    case DriveEnd::stuck:
      return Failure{"stuck", "the wheels turn without progress"};
    case DriveEnd::collision:
      return Failure{"collision", "the path led into a rock of the map"};
    case DriveEnd::blocked:
      break;
  }
  return Failure{"blocked", "a rock that the map does not show lies on the way (" + rock + ")"};
}

// The id under which the rock that ended the trace is known from now on.
std::string Nav::see_rock(const DriveTrace& trace, Surroundings& around) {
  const auto [seen, is_new] =
      seen_rocks_.try_emplace(*trace.seen_rock, "rock-" + std::to_string(seen_rocks_.size() + 1));
  if (is_new) {
    const Rock& rock = around.ground.hidden_rocks[*trace.seen_rock];
    around.out.push_back(RockSeen{seen->second, rock.x, rock.y, rock.radius, trace.end});
  }
  return seen->second;
}

void Nav::halt(Time now) {
  const bool moved = trace_.has_value() || detours_ > 0;
  settle(now);
  stand(moved ? stop_place_ : place_);
}

void Nav::settle(Time now) {
  if (trace_) pose_ = trace_->at(now).pose;
}

double Nav::energy_j(Time from, Time to) const {
  return trace_ ? trace_->at(to).energy_j - trace_->at(from).energy_j : 0;
}

void Nav::stand(std::string place) {
  place_ = std::move(place);
  target_.reset();
  trace_.reset();
  looks_until_.reset();
  detours_ = 0;
}

}  // namespace roci::sim
