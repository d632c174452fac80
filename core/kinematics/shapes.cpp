#include "core/kinematics/shapes.hpp"

namespace roci::kinematics {
namespace {

double radius_of(const Sphere& sphere) { return sphere.radius; }
double radius_of(const Capsule& capsule) { return capsule.radius + 0.5 * capsule.length; }
double radius_of(const Box& box) { return 0.5 * box.size.norm(); }

void inflate(Sphere& sphere, double margin) { sphere.radius += margin; }
void inflate(Capsule& capsule, double margin) { capsule.radius += margin; }
void inflate(Box& box, double margin) { box.size.array() += 2.0 * margin; }

}  // namespace

double bounding_radius(const CollisionShape& shape) {
  return std::visit([](const auto& form) { return radius_of(form); }, shape.form);
}

CollisionShape inflated(const CollisionShape& shape, double margin) {
  CollisionShape grown = shape;
  std::visit([margin](auto& form) { inflate(form, margin); }, grown.form);
  return grown;
}

}  // namespace roci::kinematics
