#include "arm_svc/setup.hpp"

#include "arm_svc/fingerprint.hpp"

namespace roci::arm {
namespace {

using kinematics::Body;
using kinematics::Box;
using kinematics::Capsule;
using kinematics::CollisionShape;
using kinematics::Joint;
using kinematics::JointVector;
using kinematics::Sphere;

std::uint64_t count(std::size_t n) { return n; }

void add(Fingerprint& print, const Sphere& s) { print.add(s.radius); }
void add(Fingerprint& print, const Capsule& c) { print.add(c.radius).add(c.length); }
void add(Fingerprint& print, const Box& b) { print.add(b.size); }

void add(Fingerprint& print, const Joint& joint) {
  const auto& limits = joint.limits;
  print.add(joint.name).add(count(joint.type == kinematics::JointType::prismatic));
  print.add(joint.origin.matrix()).add(joint.axis).add(joint.friction).add(joint.damping);
  print.add(limits.lower).add(limits.upper).add(limits.velocity).add(limits.acceleration).add(limits.effort);
  if (limits.jerk > 0) print.add("jerk").add(limits.jerk);
}

void add(Fingerprint& print, const Body& body) {
  print.add(body.mass.mass).add(body.mass.centre).add(body.mass.inertia).add(count(body.shapes.size()));
  for (const CollisionShape& shape : body.shapes) {
    print.add(shape.link).add(shape.pose.matrix()).add(count(shape.form.index()));
    std::visit([&](const auto& form) { add(print, form); }, shape.form);
  }
}

void add(Fingerprint& print, const JointVector& q) {
  print.add(count(static_cast<std::size_t>(q.size()))).add(q);
}

void add(Fingerprint& print, const ToolTarget& target) {
  print.add(target.position)
      .add(count(target.approach.has_value()))
      .add(count(target.orientation.has_value()));
  if (target.approach) print.add(target.approach->tool_axis).add(target.approach->direction);
  if (target.orientation) print.add(target.orientation->coeffs());
}

void add(Fingerprint& print, const CollisionRules& rules) {
  print.add(count(rules.ground_z.has_value())).add(rules.ground_z.value_or(0.0)).add(rules.margin);
  print.add(count(rules.may_touch.size()));
  for (const auto& [a, b] : rules.may_touch) print.add(a).add(b);
}

}  // namespace

std::uint64_t model_version(const ArmSetup& setup) {
  Fingerprint print;
  print.add(count(setup.arm.joints.size()));
  for (const Joint& joint : setup.arm.joints) add(print, joint);
  for (const Body& body : setup.arm.bodies) add(print, body);
  print.add(setup.arm.tool.matrix()).add(count(setup.poses.size()));
  for (const NamedPose& pose : setup.poses) {
    print.add(pose.name).add(count(pose.where.index()));
    std::visit([&](const auto& where) { add(print, where); }, pose.where);
    if (pose.module_size) print.add("module").add(*pose.module_size);
  }
  add(print, setup.collision);
  const MotorModel& motor = setup.motor;
  print.add(motor.gravity).add(motor.idle_w).add(motor.efficiency).add(motor.full_effort_loss_w);
  print.add(count(setup.search_iterations)).add(count(static_cast<std::size_t>(setup.shortcut_trials)));
  // The default is left out, as jerk and modules are where there are none: versions from before they were known stay.
  if (setup.tool_axis != Eigen::Vector3d::UnitX()) print.add("axis").add(setup.tool_axis);
  return print.value();
}

}  // namespace roci::arm
