#include "core/kinematics/urdf.hpp"

#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <exception>
#include <numbers>
#include <optional>
#include <utility>

#include "core/kinematics/mass.hpp"
#include "core/kinematics/urdf_check.hpp"

namespace roci::kinematics {
namespace {

Eigen::Vector3d vector_of(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Eigen::Isometry3d pose_of(const urdf::Pose& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  const urdf::Rotation& r = pose.rotation;
  result.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
  result.translation() = vector_of(pose.position);
  return result;
}

std::variant<Sphere, Capsule, Box> form_of(const urdf::Geometry& geometry) {
  if (geometry.type == urdf::Geometry::SPHERE)
    return Sphere{static_cast<const urdf::Sphere&>(geometry).radius};
  if (geometry.type == urdf::Geometry::BOX)
    return Box{vector_of(static_cast<const urdf::Box&>(geometry).dim)};
  const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
  const double width = 2.0 * cylinder.radius;
  if (cylinder.length >= width) return Capsule{cylinder.radius, cylinder.length};
  return Box{{width, width, cylinder.length}};
}

MassProperties mass_of(const urdf::Inertial& inertial) {
  MassProperties part;
  part.mass = inertial.mass;
  part.inertia << inertial.ixx, inertial.ixy, inertial.ixz,  //
      inertial.ixy, inertial.iyy, inertial.iyz,              //
      inertial.ixz, inertial.iyz, inertial.izz;
  return moved(part, pose_of(inertial.origin));
}

bool moves(const urdf::Joint& joint) { return joint.type != urdf::Joint::FIXED; }

// Returns the links of the chain, root link first, tip last.
std::vector<urdf::LinkConstSharedPtr> chain_to(const urdf::ModelInterface& model, const std::string& tip) {
  std::vector<urdf::LinkConstSharedPtr> chain;
  for (urdf::LinkConstSharedPtr link = model.getLink(tip); link != nullptr; link = link->getParent()) {
    chain.push_back(link);
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

class ArmBuilder {
 public:
  ArmBuilder(const urdf::ModelInterface& model, const UrdfNotes& notes, std::string file,
             const UrdfOptions& options)
      : model_(model), notes_(notes), file_(std::move(file)), options_(options) {}

  std::variant<Arm, UrdfError> build() {
    const auto chain = chain_to(model_, options_.tip);
    arm_.name = model_.getName();
    arm_.bodies.push_back({chain.front()->name, {}, {}});
    // This is the pose of the current link in the current body.
    Eigen::Isometry3d in_body = Eigen::Isometry3d::Identity();
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if (i > 0) in_body = step(*chain[i], in_body);
      const auto next = i + 1 < chain.size() ? chain[i + 1] : nullptr;
      if (const auto error = fold(*chain[i], in_body, next.get())) return *error;
    }
    arm_.tool = in_body;
    const auto count = static_cast<int>(arm_.joints.size());
    if (count < kMinJoints || count > kMaxJoints) {
      return UrdfError{file_, 0, "robot '" + arm_.name + "'",
                       "the chain to '" + options_.tip + "' has " + std::to_string(count) +
                           " movable joints; an arm has 4 to 7"};
    }
    if (const auto error = massless_end()) return *error;
    return std::move(arm_);
  }

 private:
  // A joint that moves no mass would be told to cost nothing.
  std::optional<UrdfError> massless_end() const {
    if (arm_.bodies.back().mass.mass > 0) return std::nullopt;
    const std::string& name = arm_.joints.back().name;
    return UrdfError{file_, line_of(name), "joint '" + name + "'",
                     "moves no mass; give link '" + arm_.bodies.back().name +
                         "' or one that is fixed to it an <inertial> with a <mass>"};
  }

  int line_of(const std::string& joint) const {
    const auto line = notes_.joint_line.find(joint);
    return line == notes_.joint_line.end() ? 0 : line->second;
  }

  // Goes over the joint above `link`. Returns the link's pose in the body that it belongs to.
  Eigen::Isometry3d step(const urdf::Link& link, const Eigen::Isometry3d& parent_in_body) {
    const urdf::Joint& joint = *link.parent_joint;
    const Eigen::Isometry3d origin = parent_in_body * pose_of(joint.parent_to_joint_origin_transform);
    if (!moves(joint)) return origin;
    arm_.joints.push_back(joint_of(joint, origin));
    arm_.bodies.push_back({link.name, {}, {}});
    return Eigen::Isometry3d::Identity();
  }

  Joint joint_of(const urdf::Joint& source, const Eigen::Isometry3d& origin) const {
    Joint joint;
    joint.name = source.name;
    joint.type = source.type == urdf::Joint::PRISMATIC ? JointType::prismatic : JointType::revolute;
    joint.origin = origin;
    joint.axis = vector_of(source.axis).normalized();
    const bool endless = source.type == urdf::Joint::CONTINUOUS;
    joint.limits.lower = endless ? -2.0 * std::numbers::pi : source.limits->lower;
    joint.limits.upper = endless ? 2.0 * std::numbers::pi : source.limits->upper;
    joint.limits.velocity = source.limits->velocity;
    joint.limits.effort = source.limits->effort;
    const auto given = notes_.acceleration.find(source.name);
    joint.limits.acceleration = given != notes_.acceleration.end()
                                    ? given->second
                                    : source.limits->velocity / options_.time_to_speed_s;
    if (const auto jerk = notes_.jerk.find(source.name); jerk != notes_.jerk.end()) {
      joint.limits.jerk = jerk->second;
    } else if (options_.time_to_acceleration_s > 0) {
      joint.limits.jerk = joint.limits.acceleration / options_.time_to_acceleration_s;
    }
    if (source.dynamics) {
      joint.friction = source.dynamics->friction;
      joint.damping = source.dynamics->damping;
    }
    return joint;
  }

  // Adds the link, and what hangs on it by fixed joints, to the last body; `next` is the chain's way on.
  std::optional<UrdfError> fold(const urdf::Link& link, const Eigen::Isometry3d& in_body,
                                const urdf::Link* next) {
    Body& body = arm_.bodies.back();
    if (link.inertial) body.mass = joined(body.mass, moved(mass_of(*link.inertial), in_body));
    for (const auto& collision : link.collision_array) {
      body.shapes.push_back({link.name, in_body * pose_of(collision->origin), form_of(*collision->geometry)});
    }
    for (const auto& below : link.child_links) {
      if (below.get() == next) continue;
      const urdf::Joint& joint = *below->parent_joint;
      if (moves(joint)) {
        return UrdfError{
            file_, line_of(joint.name), "joint '" + joint.name + "'",
            "branches off the chain to '" + options_.tip + "'; make it fixed or choose another tip"};
      }
      const Eigen::Isometry3d pose = in_body * pose_of(joint.parent_to_joint_origin_transform);
      if (auto error = fold(*below, pose, nullptr)) return error;
    }
    return std::nullopt;
  }

  const urdf::ModelInterface& model_;
  const UrdfNotes& notes_;
  std::string file_;
  const UrdfOptions& options_;
  Arm arm_;
};

}  // namespace

std::string to_string(const UrdfError& error) {
  const std::string place = error.line > 0 ? error.file + ":" + std::to_string(error.line) : error.file;
  return place + ": " + error.element + ": " + error.message;
}

std::variant<Arm, UrdfError> parse_urdf(const std::string& text, const std::string& file,
                                        const UrdfOptions& options) {
  const auto checked = check_urdf(text, file);
  if (const auto* error = std::get_if<UrdfError>(&checked)) return *error;
  const auto& notes = std::get<UrdfNotes>(checked);
  if (!notes.link_line.contains(options.tip)) {
    return UrdfError{file, 0, "document", "tip link '" + options.tip + "' is not in the document"};
  }
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    return UrdfError{file, 0, "document", std::string("urdfdom refuses it: ") + error.what()};
  }
  if (model == nullptr || model->getLink(options.tip) == nullptr) {
    return UrdfError{file, 0, "document", "urdfdom refuses it; compare with the URDF specification"};
  }
  return ArmBuilder(*model, notes, file, options).build();
}

}  // namespace roci::kinematics
