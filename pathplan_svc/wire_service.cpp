#include "pathplan_svc/wire_service.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace roci::pathplan {
namespace {

using terrain::Point;

v1::FunctionSignature signature(const std::string& name, const std::string& unit) {
  v1::FunctionSignature function;
  function.name(name);
  function.parameter_types({"location", "location"});
  function.unit(unit);
  return function;
}

std::optional<double> number(const v1::PlanObject& object, const std::string& name) {
  for (const v1::Property& property : object.properties()) {
    if (property.name() != name) continue;
    const std::string& text = property.value();
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      return std::nullopt;
    return value;
  }
  return std::nullopt;
}

std::optional<Point> place_of(const v1::FunctionRequest& request, std::uint32_t object) {
  if (object >= request.objects().size()) return std::nullopt;
  const auto x = number(request.objects()[object], "x");
  const auto y = number(request.objects()[object], "y");
  if (!x || !y) return std::nullopt;
  return Point{*x, *y};
}

std::string explain(const PathOutcome& outcome) {
  switch (outcome.status) {
    case PathStatus::found:
      return "";
    case PathStatus::unreachable:
      return "no free ground joins start and goal on this map";
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

class Evaluation {
 public:
  Evaluation(PathPlanner& planner, const v1::FunctionRequest& request)
      : planner_(planner), request_(request) {}

  v1::FunctionValues batch(const v1::FunctionBatch& batch, const std::stop_token& stop) {
    v1::FunctionValues values;
    values.function(batch.function());
    const bool time = batch.function() == "traverse_time";
    const bool known = time || batch.function() == "traverse_energy";
    const std::size_t arity = std::max<std::size_t>(batch.arity(), 1);
    const std::vector<std::uint32_t>& tuples = batch.tuples();
    for (std::size_t i = 0; i < tuples.size() && !stop.stop_requested(); i += arity) {
      double value = 0;
      v1::FunctionOutcome outcome = v1::FUNCTION_UNKNOWN_FUNCTION;
      if (known) {
        outcome = batch.arity() == 2 && i + 1 < tuples.size() ? tuple(tuples[i], tuples[i + 1], time, value)
                                                              : v1::FUNCTION_WRONG_ARITY;
      }
      values.numbers().push_back(value);
      values.outcomes().push_back(outcome);
    }
    return values;
  }

  std::map<std::string, std::string> take_unusable_places() { return std::move(unusable_); }

 private:
  v1::FunctionOutcome tuple(std::uint32_t from_object, std::uint32_t to_object, bool time, double& value) {
    const auto from = place_of(request_, from_object);
    const auto to = place_of(request_, to_object);
    if (!from || !to) return v1::FUNCTION_UNKNOWN_OBJECT;
    const PathOutcome outcome = planner_.path(*from, *to);
    if (outcome.status == PathStatus::found) {
      value = time ? outcome.time : outcome.energy;
      return v1::FUNCTION_VALUE;
    }
    if (outcome.status != PathStatus::unreachable) {
      const bool at_start =
          outcome.status == PathStatus::start_outside || outcome.status == PathStatus::start_blocked;
      unusable_[request_.objects()[at_start ? from_object : to_object].name()] = explain(outcome);
    }
    return v1::FUNCTION_UNREACHABLE;
  }

  PathPlanner& planner_;
  const v1::FunctionRequest& request_;
  std::map<std::string, std::string> unusable_;
};

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
  if (status == PathStatus::found) return v1::MOTION_FOUND;
  return status == PathStatus::unreachable ? v1::MOTION_UNREACHABLE : v1::MOTION_INVALID;
}

}  // namespace

v1::FunctionOffer function_offer(const std::string& owner, std::uint64_t map_version) {
  v1::FunctionOffer offer;
  offer.module_name(kModule);
  offer.owner(owner);
  offer.model_version(map_version);
  offer.functions({signature("traverse_time", "s"), signature("traverse_energy", "J")});
  return offer;
}

FunctionAnswer evaluate(PathPlanner& planner, const v1::FunctionRequest& request,
                        const std::stop_token& stop) {
  FunctionAnswer answer;
  Evaluation evaluation(planner, request);
  for (const v1::FunctionBatch& batch : request.batches()) {
    answer.reply.results().push_back(evaluation.batch(batch, stop));
  }
  answer.reply.model_version(planner.map().version());
  answer.unusable_places = evaluation.take_unusable_places();
  return answer;
}

v1::PathReply find_path(PathPlanner& planner, const v1::PathRequest& request) {
  const Point from{request.origin().x_m(), request.origin().y_m()};
  const Point to{request.goal_pose().x_m(), request.goal_pose().y_m()};
  const PathOutcome outcome = planner.path(from, to);
  v1::PathReply reply;
  reply.outcome(motion_outcome(outcome.status));
  reply.reason(explain(outcome));
  reply.map_version(planner.map().version());
  reply.waypoints(poses(outcome.waypoints, request.origin().heading_rad()));
  reply.length_m(outcome.length);
  reply.expected_s(outcome.time);
  reply.expected_j(outcome.energy);
  return reply;
}

}  // namespace roci::pathplan
