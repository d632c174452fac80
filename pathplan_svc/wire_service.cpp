#include "pathplan_svc/wire_service.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "services/wire/function_wire.hpp"

namespace roci::pathplan {
namespace {

using terrain::Point;
namespace wire = services::wire;

constexpr const char* kTime = "traverse_time";
constexpr const char* kEnergy = "traverse_energy";

const std::vector<v1::FunctionAccuracy> kAccuracies{v1::ACCURACY_EXACT, v1::ACCURACY_LOWER_BOUND};
const std::vector<wire::OwnedFunction> kFunctions{{kTime, {"location", "location"}, "s", kAccuracies},
                                                  {kEnergy, {"location", "location"}, "J", kAccuracies}};

std::optional<Point> place_of(const v1::PlanObject& object) {
  const auto x = wire::finite_property(object, "x");
  const auto y = wire::finite_property(object, "y");
  if (!x || !y) return std::nullopt;
  return Point{*x, *y};
}

std::string explain(const PathOutcome& outcome) {
  switch (outcome.status) {
    case PathStatus::found:
      return "";
    case PathStatus::unreachable:
      return "no free ground joins start and goal on this map";
    case PathStatus::unknown:
      return "no known ground joins start and goal, and unknown ground is not driven over; complete the map "
             "or choose "
             "another place";
    case PathStatus::start_outside:
    case PathStatus::goal_outside:
      return "the place lies outside the map; give x and y in metres of the map frame";
    case PathStatus::start_blocked:
    case PathStatus::goal_blocked:
      return std::string("the rover cannot stand there (") + to_string(outcome.blocked_by) +
             "); choose a place farther from obstacles and steep ground";
  }
  return "";
}

// The origin of a drive is where the rover stands: no other place can be chosen for it.
std::string explain_start(const PathOutcome& outcome) {
  return std::string("the rover stands where nothing may stand (") + to_string(outcome.blocked_by) +
         "), and no way leads out; clear the hazard if it is not there, or correct the map";
}

v1::Pose2 pose(Point p, double heading_rad) {
  v1::Pose2 pose;
  pose.x_m(p.x);
  pose.y_m(p.y);
  pose.heading_rad(heading_rad);
  return pose;
}

// Each way-point heads for the next; the last keeps the heading in which it is reached.
std::vector<v1::Pose2> poses(const Polyline& points, double heading_at_rest) {
  std::vector<v1::Pose2> out;
  double towards = heading_at_rest;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i + 1 < points.size()) towards = heading(points[i], points[i + 1]);
    out.push_back(pose(points[i], towards));
  }
  return out;
}

v1::MotionOutcome motion_outcome(PathStatus status) {
  switch (status) {
    case PathStatus::found:
      return v1::MOTION_FOUND;
    case PathStatus::unreachable:
      return v1::MOTION_UNREACHABLE;
    case PathStatus::unknown:
      return v1::MOTION_UNKNOWN;
    case PathStatus::start_outside:
    case PathStatus::goal_outside:
    case PathStatus::start_blocked:
    case PathStatus::goal_blocked:
      break;
  }
  return v1::MOTION_INVALID;
}

bool at_start(PathStatus status) {
  return status == PathStatus::start_outside || status == PathStatus::start_blocked;
}

}  // namespace

v1::FunctionOffer function_offer(const std::string& owner, std::uint64_t map_version) {
  return wire::function_offer(kModule, owner, map_version, kFunctions);
}

FunctionAnswer evaluate(PathPlanner& planner, const v1::FunctionRequest& request,
                        const std::stop_token& stop) {
  FunctionAnswer answer;
  const auto estimate = [&](const wire::OwnedFunction& function,
                            std::span<const v1::PlanObject* const> objects,
                            v1::FunctionAccuracy accuracy) -> wire::FunctionResult {
    const auto from = place_of(*objects[0]), to = place_of(*objects[1]);
    if (!from || !to) return {v1::FUNCTION_UNKNOWN_OBJECT};
    const PathOutcome path =
        accuracy == v1::ACCURACY_LOWER_BOUND ? planner.lower_bound(*from, *to) : planner.cost(*from, *to);
    if (path.status == PathStatus::found)
      return {v1::FUNCTION_VALUE, function.name == kTime ? path.time : path.energy};
    if (path.status == PathStatus::unreachable) return {v1::FUNCTION_UNREACHABLE};
    answer.unusable_places[objects[at_start(path.status) ? 0 : 1]->name()] = explain(path);
    return {path.status == PathStatus::unknown ? v1::FUNCTION_UNKNOWN : v1::FUNCTION_UNREACHABLE};
  };
  answer.reply = wire::answer_batches(request, planner.map().version(), kFunctions, estimate, stop);
  wire::put_words(answer.reply, answer.unusable_places);
  return answer;
}

v1::PathReply find_path(PathPlanner& planner, const v1::PathRequest& request) {
  const Point from{request.origin().x_m(), request.origin().y_m()};
  const Point to{request.goal_pose().x_m(), request.goal_pose().y_m()};
  const PathOutcome outcome = planner.path(from, to);
  v1::PathReply reply;
  reply.outcome(motion_outcome(outcome.status));
  reply.reason(outcome.status == PathStatus::start_blocked ? explain_start(outcome) : explain(outcome));
  reply.map_version(planner.map().version());
  reply.waypoints(poses(outcome.waypoints, request.origin().heading_rad()));
  reply.length_m(outcome.length);
  reply.expected_s(outcome.time);
  reply.expected_j(outcome.energy);
  return reply;
}

}  // namespace roci::pathplan
