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

std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Sphere& s) {
  return std::make_shared<fcl::Sphered>(s.radius);
}
std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Capsule& c) {
  return std::make_shared<fcl::Capsuled>(c.radius, c.length);
}
std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Box& b) {
  return std::make_shared<fcl::Boxd>(b.size);
}

// These return how far the shape reaches below its own origin when its z axis and sides are turned by `pose`,
// in m.
double depth_below(const Sphere& s, const Eigen::Isometry3d&) { return s.radius; }
double depth_below(const Capsule& c, const Eigen::Isometry3d& pose) {
  return c.radius + 0.5 * c.length * std::abs(pose.linear()(2, 2));
}
double depth_below(const Box& b, const Eigen::Isometry3d& pose) {
  return 0.5 * pose.linear().row(2).cwiseAbs().dot(b.size);
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

bool overlap(const Part& a, const Eigen::Isometry3d& pose_a, const Part& b, const Eigen::Isometry3d& pose_b) {
  const double reach = a.radius + b.radius;
  if ((pose_a.translation() - pose_b.translation()).squaredNorm() > reach * reach) return false;
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
    for (std::size_t i = parts.size(); i-- > 0;) {
      for (std::size_t j = 0; j < i; ++j) {
        const bool apart = parts[i].body > parts[j].body + 1;
        if (apart && !listed(rules.may_touch, parts[i].shape.link, parts[j].shape.link))
          pairs.emplace_back(i, j);
      }
    }
  }

  bool touches(const Part& part, const Eigen::Isometry3d& pose, const Part& obstacle) const {
    return part.body > 0 && overlap(part, pose, obstacle, obstacle.shape.pose) &&
           !listed(rules.may_touch, part.shape.link, obstacle.shape.link);
  }

  bool on_ground(const Part& part, const Eigen::Isometry3d& pose) const {
    if (!rules.ground_z || part.body == 0 || listed(rules.may_touch, part.shape.link, "ground")) return false;
    const double depth =
        std::visit([&](const auto& form) { return depth_below(form, pose); }, part.shape.form);
    return pose.translation().z() - depth < *rules.ground_z;
  }
};

CollisionChecker::CollisionChecker(Arm arm, CollisionRules rules, std::vector<CollisionShape> obstacles)
    : scene_(std::make_unique<const Scene>(std::move(arm), std::move(rules), obstacles)) {}
CollisionChecker::~CollisionChecker() = default;
CollisionChecker::CollisionChecker(CollisionChecker&&) noexcept = default;
CollisionChecker& CollisionChecker::operator=(CollisionChecker&&) noexcept = default;

std::optional<Contact> CollisionChecker::contact(const JointVector& q) const {
  const auto bodies = kinematics::body_poses(scene_->arm, q);
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(scene_->parts.size());
  for (const Part& part : scene_->parts) {
    poses.push_back(bodies[part.body] * part.shape.pose);
    if (scene_->on_ground(part, poses.back())) return Contact{part.shape.link, "ground"};
  }
  for (const auto& [i, j] : scene_->pairs) {
    const Part &a = scene_->parts[i], &b = scene_->parts[j];
    if (overlap(a, poses[i], b, poses[j])) return Contact{a.shape.link, b.shape.link};
  }
  for (std::size_t i = scene_->parts.size(); i-- > 0 && !scene_->obstacles.empty();) {
    const Part& part = scene_->parts[i];
    for (const Part& obstacle : scene_->obstacles) {
      if (scene_->touches(part, poses[i], obstacle)) return Contact{part.shape.link, obstacle.shape.link};
    }
  }
  return std::nullopt;
}

std::vector<std::size_t> CollisionChecker::obstacles_touched(const JointVector& q) const {
  const auto bodies = kinematics::body_poses(scene_->arm, q);
  std::vector<std::size_t> touched;
  for (std::size_t i = 0; i < scene_->obstacles.size(); ++i) {
    const bool hit = std::ranges::any_of(scene_->parts, [&](const Part& part) {
      return scene_->touches(part, bodies[part.body] * part.shape.pose, scene_->obstacles[i]);
    });
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
