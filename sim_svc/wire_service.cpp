#include "sim_svc/wire_service.hpp"

#include "core/bytes/crc_32.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::sim::wire {
namespace {

namespace owner = services::owner;

owner::Stage stage_of(world::TaskStage stage) {
  switch (stage) {
    case world::TaskStage::rejected:
      return owner::Stage::rejected;
    case world::TaskStage::completed:
      return owner::Stage::completed;
    case world::TaskStage::failed:
      return owner::Stage::failed;
    case world::TaskStage::cancelled:
      return owner::Stage::cancelled;
    case world::TaskStage::accepted:
    case world::TaskStage::repairing:
      break;
  }
  return owner::Stage::accepted;
}

v1::GoalClass class_of(scenario::Importance importance) {
  switch (importance) {
    case scenario::Importance::hard:
      return v1::GOAL_HARD;
    case scenario::Importance::optional:
      return v1::GOAL_OPTIONAL;
    case scenario::Importance::opportunistic:
      break;
  }
  return v1::GOAL_OPPORTUNISTIC;
}

}  // namespace

world::TaskKey task_key(const owner::CommandKey& key) {
  return {key.activity, key.attempt, key.commander, key.issued_epoch};
}

owner::CommandKey command_key(const world::TaskKey& key) {
  return {key.activity, key.attempt, key.commander, key.epoch};
}

world::Order order_of(const owner::Request& request) {
  return {request.robot,
          request.subsystem,
          {task_key(request.key), request.command, request.arguments, request.latest_end}};
}

owner::CommandStatus status_of(const world::TaskReport& report) {
  owner::CommandStatus status{stage_of(report.stage), report.code, report.reason, {}};
  if (report.results)
    status.results = {report.results->duration, report.results->energy_j, report.results->values};
  return status;
}

world::Way way_of(const v1::PathReply& reply) {
  world::Way way;
  for (const v1::Pose2& waypoint : reply.waypoints()) way.points.push_back({waypoint.x_m(), waypoint.y_m()});
  return way;
}

world::DownlinkSchedule schedule_of(const v1::DownlinkSchedule& schedule) {
  world::DownlinkSchedule out{schedule.robot(), {}};
  if (!schedule.limited()) return out;  // nobody has thought of what goes when
  for (const v1::ScheduledDownlink& downlink : schedule.downlinks()) {
    auto& products = out.products[downlink.activity()];
    for (const v1::ScheduledProduct& product : downlink.products()) products.push_back(product.id());
    out.lasts[downlink.activity()] = temporal::Duration{downlink.end_us() - downlink.start_us()};
  }
  return out;
}

world::Trajectory trajectory_of(const v1::ArmMotionReply& reply) {
  world::Trajectory out;
  for (const v1::JointState& state : reply.trajectory())
    out.targets.push_back({state.time_s(), state.positions()});
  return out;
}

v1::Observation to_wire(const world::Observed& observed) {
  v1::Observation out;
  out.timeline(observed.timeline);
  out.observed(services::wire::to_wire(observed.value));
  out.sampled_us(observed.at.count());
  return out;
}

v1::DataProduct to_wire(const world::Image& image) {
  v1::DataProduct out;
  out.id(image.id);
  out.product_kind(image.kind);
  out.source(image.source);
  out.bytes(image.bytes);
  out.fate(image.sent ? v1::PRODUCT_SENT : v1::PRODUCT_STORED);
  out.tier(image.kind == "image" ? v1::TIER_MANDATORY : v1::TIER_RESIDUAL);
  out.created_us(image.taken.count());
  out.x_m(image.taken_from.x);
  out.y_m(image.taken_from.y);
  out.heading_rad(image.taken_from.heading);
  out.preview(image.preview);
  return out;
}

static_assert(static_cast<int>(world::Fate::lost) == v1::PRODUCT_LOST &&
                  static_cast<int>(world::Fate::sent) == v1::PRODUCT_SENT &&
                  static_cast<int>(world::Tier::residual) == v1::TIER_RESIDUAL,
              "fates and tiers have the order of the wire");

v1::DataProduct to_wire(const world::Product& product) {
  v1::DataProduct out;
  out.id(product.id);
  out.product_kind(product.kind);
  out.source(product.source);
  out.bytes(product.bytes);
  out.fate(static_cast<v1::ProductFate>(product.fate));
  out.tier(static_cast<v1::DataTier>(product.tier));
  out.created_us(product.created.count());
  out.utility(product.utility);
  return out;
}

namespace {

template <class Seen>
v1::Hazard hazard_of(const Seen& seen, const std::string& finder) {
  v1::Hazard out;
  out.found_by(finder);
  out.id(seen.id);
  out.x_m(seen.x);
  out.y_m(seen.y);
  out.radius_m(seen.radius);
  return out;
}

template <class Seen>
v1::TerrainFinding finding_as(v1::ObstacleKind kind, const Seen& seen) {
  v1::TerrainFinding out;
  out.robot(seen.robot);
  out.id(seen.id);
  out.obstacle_kind(kind);
  out.x_m(seen.x);
  out.y_m(seen.y);
  out.radius_m(seen.radius);
  out.found_us(seen.at.count());
  return out;
}

v1::OrderKind kind_of(scenario::OrderKind kind) {
  switch (kind) {
    case scenario::OrderKind::hold:
      return v1::ORDER_HOLD;
    case scenario::OrderKind::release:
      return v1::ORDER_RELEASE;
    case scenario::OrderKind::approve:
    case scenario::OrderKind::command:  // an approval with its content
      return v1::ORDER_APPROVE;
    case scenario::OrderKind::set_value:
      return v1::ORDER_SET_VALUE;
    case scenario::OrderKind::autonomy:
      return v1::ORDER_AUTONOMY;
    case scenario::OrderKind::answer:
      return v1::ORDER_ANSWER;
    case scenario::OrderKind::drop:
      return v1::ORDER_DROP;
    case scenario::OrderKind::relaunch:
      return v1::ORDER_RELAUNCH;
    case scenario::OrderKind::safe:
      return v1::ORDER_SAFE;
  }
  return v1::ORDER_HOLD;
}

}  // namespace

v1::Hazard to_wire(const world::RockSeen& rock, const std::string& finder) { return hazard_of(rock, finder); }

v1::Hazard to_wire(const world::SoilMarked& soil, const std::string& finder) {
  return hazard_of(soil, finder);
}

v1::TerrainFinding finding_of(const world::RockSeen& rock) { return finding_as(v1::OBSTACLE_ROCK, rock); }

v1::TerrainFinding finding_of(const world::SoilMarked& soil) { return finding_as(v1::OBSTACLE_SOIL, soil); }

v1::PathRequest to_wire(const world::PathWanted& path) {
  v1::PathRequest out;
  out.origin().x_m(path.from.x);
  out.origin().y_m(path.from.y);
  out.origin().heading_rad(path.from.heading);
  out.goal_pose().x_m(path.x);
  out.goal_pose().y_m(path.y);
  return out;
}

v1::ArmMotionRequest to_wire(const world::MotionWanted& motion) {
  v1::ArmMotionRequest out;
  out.from_pose(motion.from);
  out.from_positions(motion.joints);
  out.to_pose(motion.to);
  out.payload_kg(motion.payload_kg);
  out.payload_size_m(motion.payload_size_m);
  return out;
}

v1::Order to_wire(const scenario::OrderStimulus& order) {
  v1::Order out;
  out.issuer(order.issuer);
  out.id(order.id);
  out.robot(order.robot);
  out.order_kind(kind_of(order.kind));
  out.target(order.target);
  out.content(services::wire::to_wire(order.value));
  out.choice(order.choice);
  out.autonomy(static_cast<v1::AutonomyLevel>(order.level - 1));
  return out;
}

v1::NetworkOrder to_wire(const scenario::NetworkStimulus& network) {
  v1::NetworkOrder out;
  out.issuer(network.issuer);
  out.id(network.id);
  out.robot(network.robot);
  out.order_kind(network.content.empty() ? v1::NETWORK_SET_PARAMETER : v1::NETWORK_REPLACE);
  out.content().assign(network.content.begin(), network.content.end());
  out.content_size(network.content.size());
  out.checksum(bytes::crc_32(network.content));
  out.parameter(network.parameter);
  out.amount(network.value);
  return out;
}

v1::Goal to_wire(const scenario::GoalStimulus& goal, bool recalled) {
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
  out.robot(goal.robot);
  out.utility(goal.utility);
  out.preferred_us(goal.preferred ? goal.preferred->count() : -1);
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
