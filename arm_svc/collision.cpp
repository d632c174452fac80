#include "arm_svc/collision.hpp"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cmath>

#include "core/kinematics/forward.hpp"
#include "core/kinematics/shapes.hpp"

namespace roci::arm {
namespace {

using kinematics::Arm;
using kinematics::Box;
using kinematics::Capsule;
using kinematics::CollisionShape;
using kinematics::JointVector;
using kinematics::Sphere;

constexpr double kMostSteps = 1e8;  // a line of more is not worth its testing, nor would it fit an int

constexpr double kApart = 1e-5;  // m, more than the shape tests' own tolerance

std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Sphere& s) {
  return std::make_shared<fcl::Sphered>(s.radius);
}
std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Capsule& c) {
  return std::make_shared<fcl::Capsuled>(c.radius, c.length);
}
std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Box& b) {
  return std::make_shared<fcl::Boxd>(b.size);
}

// These return how far the shape reaches from its own origin along x, y and z of the base,
// when it is turned by `pose`, in m.
Eigen::Vector3d extent(const Sphere& s, const Eigen::Isometry3d&) {
  return Eigen::Vector3d::Constant(s.radius);
}
Eigen::Vector3d extent(const Capsule& c, const Eigen::Isometry3d& pose) {
  return (c.radius + 0.5 * c.length * pose.linear().col(2).cwiseAbs().array()).matrix();
}
Eigen::Vector3d extent(const Box& b, const Eigen::Isometry3d& pose) {
  return 0.5 * (pose.linear().cwiseAbs() * b.size);
}

struct Part {
  std::size_t body;
  CollisionShape shape;  // inflated
  double radius;         // bounding sphere about the shape's origin
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
};

Part part_of(std::size_t body, const CollisionShape& shape, double margin) {
  const CollisionShape grown = kinematics::inflated(shape, margin);
  auto geometry = std::visit(
      [](const auto& form) -> std::shared_ptr<fcl::CollisionGeometryd> { return geometry_of(form); },
      grown.form);
  return {body, grown, kinematics::bounding_radius(grown), std::move(geometry)};
}

// Is a part where it stands, with the box along the base axes that contains it.
struct Placed {
  const Part* part;
  Eigen::Isometry3d pose;
  Eigen::Vector3d extent;
};

Placed placed(const Part& part, const Eigen::Isometry3d& pose) {
  return {&part, pose, std::visit([&](const auto& form) { return extent(form, pose); }, part.shape.form)};
}

bool overlap(const Placed& placed_a, const Placed& placed_b) {
  const Part &a = *placed_a.part, &b = *placed_b.part;
  const Eigen::Isometry3d &pose_a = placed_a.pose, &pose_b = placed_b.pose;
  const double reach = a.radius + b.radius;
  const Eigen::Vector3d between = pose_a.translation() - pose_b.translation();
  if (between.squaredNorm() > reach * reach) return false;
  if ((between.cwiseAbs() - placed_a.extent - placed_b.extent).maxCoeff() > kApart) return false;
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(a.geometry.get(), pose_a, b.geometry.get(), pose_b, request, result) > 0;
}

bool listed(const std::vector<std::pair<std::string, std::string>>& pairs, const std::string& a,
            const std::string& b) {
  return std::any_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
    return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
  });
}

}  // namespace

struct CollisionChecker::Scene {
  Arm arm;
  CollisionRules rules;
  std::vector<Part> parts;
  std::vector<Part> obstacles;
  std::vector<Placed> standing;                            // the obstacles
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  // indices of parts, outermost bodies first
  JointVector displacement;

  Scene(Arm a, CollisionRules r, const std::vector<CollisionShape>& still)
      : arm(std::move(a)), rules(std::move(r)) {
    displacement = kinematics::displacement_bounds(arm);
    for (std::size_t body = 0; body < arm.bodies.size(); ++body) {
      for (const CollisionShape& shape : arm.bodies[body].shapes)
        parts.push_back(part_of(body, shape, rules.margin));
    }
    for (const CollisionShape& shape : still) obstacles.push_back(part_of(0, shape, rules.margin));
    for (const Part& obstacle : obstacles) standing.push_back(placed(obstacle, obstacle.shape.pose));
    for (std::size_t i = parts.size(); i-- > 0;) {
      for (std::size_t j = 0; j < i; ++j) {
        const bool apart = parts[i].body > parts[j].body + 1;
        if (apart && !listed(rules.may_touch, parts[i].shape.link, parts[j].shape.link))
          pairs.emplace_back(i, j);
      }
    }
  }

  bool touches(const Placed& part, const Placed& obstacle) const {
    return part.part->body > 0 && overlap(part, obstacle) &&
           !listed(rules.may_touch, part.part->shape.link, obstacle.part->shape.link);
  }

  bool on_ground(const Placed& placed) const {
    const Part& part = *placed.part;
    if (!rules.ground_z || part.body == 0 || listed(rules.may_touch, part.shape.link, "ground")) return false;
    return placed.pose.translation().z() - placed.extent.z() < *rules.ground_z;
  }

  std::vector<Placed> parts_at(const JointVector& q) const {
    const auto bodies = kinematics::body_poses(arm, q);
    std::vector<Placed> where;
    where.reserve(parts.size());
    for (const Part& part : parts) where.push_back(placed(part, bodies[part.body] * part.shape.pose));
    return where;
  }
};

CollisionChecker::CollisionChecker(Arm arm, CollisionRules rules, std::vector<CollisionShape> obstacles)
    : scene_(std::make_unique<const Scene>(std::move(arm), std::move(rules), obstacles)) {}
CollisionChecker::~CollisionChecker() = default;
CollisionChecker::CollisionChecker(CollisionChecker&&) noexcept = default;
CollisionChecker& CollisionChecker::operator=(CollisionChecker&&) noexcept = default;

std::optional<Contact> CollisionChecker::contact(const JointVector& q) const {
  const std::vector<Placed> parts = scene_->parts_at(q);
  const auto link = [](const Placed& placed) { return placed.part->shape.link; };
  for (const Placed& part : parts) {
    if (scene_->on_ground(part)) return Contact{link(part), "ground"};
  }
  for (const auto& [i, j] : scene_->pairs) {
    if (overlap(parts[i], parts[j])) return Contact{link(parts[i]), link(parts[j])};
  }
  for (std::size_t i = parts.size(); i-- > 0 && !scene_->standing.empty();) {
    for (const Placed& obstacle : scene_->standing) {
      if (scene_->touches(parts[i], obstacle)) return Contact{link(parts[i]), link(obstacle)};
    }
  }
  return std::nullopt;
}

std::vector<std::size_t> CollisionChecker::obstacles_touched(const JointVector& q) const {
  const std::vector<Placed> parts = scene_->parts_at(q);
  std::vector<std::size_t> touched;
  for (std::size_t i = 0; i < scene_->standing.size(); ++i) {
    const bool hit = std::ranges::any_of(
        parts, [&](const Placed& part) { return scene_->touches(part, scene_->standing[i]); });
    if (hit) touched.push_back(i);
  }
  return touched;
}

bool CollisionChecker::line_is_free(const JointVector& from, const JointVector& to) const {
  const double travel = scene_->displacement.dot((to - from).cwiseAbs());
  const double needed = std::ceil(travel / (2.0 * scene_->rules.margin));
  if (!(needed < kMostSteps)) return false;
  const int steps = std::max(1, static_cast<int>(needed));
  // The middle comes first: on a blocked line it is the likeliest to show it.
  for (int stride = 1 << 30; stride > 0; stride /= 2) {
    if (stride > steps) continue;
    for (int i = stride; i < steps; i += 2 * stride) {
      if (contact(from + (to - from) * (static_cast<double>(i) / steps))) return false;
    }
  }
  return !contact(from) && !contact(to);
}

}  // namespace roci::arm
