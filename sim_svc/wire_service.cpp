#include "sim_svc/wire_service.hpp"

#include <limits>

#include "services/wire/plan_wire.hpp"

namespace roci::sim::wire {
namespace {

Action action_of(v1::CommandAction action) {
  switch (action) {
    case v1::COMMAND_CANCEL:
      return Action::cancel;
    case v1::COMMAND_QUERY:
      return Action::query;
    default:
      return Action::execute;
  }
}

v1::CommandStage stage_of(Stage stage) {
  switch (stage) {
    case Stage::accepted:
      return v1::STAGE_ACCEPTED;
    case Stage::rejected:
      return v1::STAGE_REJECTED;
    case Stage::completed:
      return v1::STAGE_COMPLETED;
    case Stage::failed:
      return v1::STAGE_FAILED;
    case Stage::cancelled:
      return v1::STAGE_CANCELLED;
    case Stage::cancel_failed:
      return v1::STAGE_CANCEL_FAILED;
    case Stage::unknown:
      break;
  }
  return v1::STAGE_UNKNOWN;
}

v1::GoalClass class_of(Importance importance) {
  switch (importance) {
    case Importance::hard:
      return v1::GOAL_HARD;
    case Importance::optional:
      return v1::GOAL_OPTIONAL;
    case Importance::opportunistic:
      break;
  }
  return v1::GOAL_OPPORTUNISTIC;
}

}  // namespace

Request from_wire(const v1::Command& command) {
  Request request;
  request.key = {command.activity(), command.attempt(), command.commander(), command.epoch()};
  request.action = action_of(command.action());
  request.component = command.subsystem();
  request.command = command.command_name();
  for (const v1::Property& argument : command.arguments()) {
    request.arguments[argument.name()] = argument.value();
  }
  request.epoch = command.sender_epoch();
  return request;
}

std::vector<terrain::Point> way_of(const v1::PathReply& reply) {
  std::vector<terrain::Point> way;
  for (const v1::Pose2& waypoint : reply.waypoints()) way.push_back({waypoint.x_m(), waypoint.y_m()});
  return way;
}

std::vector<JointTarget> trajectory_of(const v1::ArmMotionReply& reply) {
  std::vector<JointTarget> targets;
  for (const v1::JointState& state : reply.trajectory())
    targets.push_back({state.time_s(), state.positions()});
  return targets;
}

v1::CommandAck to_wire(const Ack& ack, const std::string& owner) {
  v1::CommandAck out;
  out.commander(ack.key.commander);
  out.epoch(ack.key.epoch);
  out.activity(ack.key.activity);
  out.attempt(ack.key.attempt);
  out.stage(stage_of(ack.stage));
  out.owner(owner);
  out.code(ack.code);
  out.reason(ack.reason);
  out.outcome().duration_us(-1);
  out.outcome().energy_j(std::numeric_limits<double>::quiet_NaN());
  out.newest_epoch(ack.newest_epoch);
  out.refused_epoch(ack.refused_epoch);
  return out;
}

v1::Observation to_wire(const Observed& observed) {
  v1::Observation out;
  out.timeline(observed.timeline);
  out.observed(services::wire::to_wire(observed.value));
  out.sampled_us(observed.at.count());
  return out;
}

v1::DataProduct to_wire(const Image& image) {
  v1::DataProduct out;
  out.id(image.id);
  out.product_kind("image");
  out.source(image.source);
  out.bytes(image.bytes);
  out.fate(image.sent ? v1::PRODUCT_SENT : v1::PRODUCT_STORED);
  out.tier(v1::TIER_MANDATORY);
  out.created_us(image.taken.count());
  out.x_m(image.taken_from.x);
  out.y_m(image.taken_from.y);
  out.preview(image.preview);
  return out;
}

v1::Hazard to_wire(const RockSeen& rock, const std::string& finder) {
  v1::Hazard out;
  out.found_by(finder);
  out.id(rock.id);
  out.x_m(rock.x);
  out.y_m(rock.y);
  out.radius_m(rock.radius);
  return out;
}

v1::PathRequest to_wire(const PathWanted& path) {
  v1::PathRequest out;
  out.origin().x_m(path.from.x);
  out.origin().y_m(path.from.y);
  out.origin().heading_rad(path.from.heading);
  out.goal_pose().x_m(path.x);
  out.goal_pose().y_m(path.y);
  return out;
}

v1::ArmMotionRequest to_wire(const MotionWanted& motion) {
  v1::ArmMotionRequest out;
  out.from_pose(motion.from);
  out.from_positions(motion.joints);
  out.to_pose(motion.to);
  return out;
}

v1::Goal to_wire(const GoalStimulus& goal, bool recalled) {
  v1::Goal out;
  out.issuer(goal.issuer);
  out.id(goal.id);
  out.goal_kind(goal.kind);
  for (const auto& [name, value] : goal.arguments) {
    v1::Property argument;
    argument.name(name);
    argument.value(value);
    out.arguments().push_back(argument);
  }
  out.importance(class_of(goal.importance));
  out.utility({goal.utility});
  out.preferred_us(-1);
  out.priority(goal.priority);
  out.opens_us(goal.opens.count());
  out.closes_us(goal.closes.count());
  out.recalled(recalled);
  return out;
}

v1::Event event(v1::Severity severity, const std::string& code, const std::string& text) {
  v1::Event out;
  out.severity_level(severity);
  out.code(code);
  out.text(text);
  return out;
}

}  // namespace roci::sim::wire
