#include "arm_svc/places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "arm_svc/payload.hpp"
#include "arm_svc/trajectory.hpp"
#include "core/kinematics/forward.hpp"

namespace roci::arm {
namespace {

using kinematics::JointVector;

constexpr double kSensorNoise = 0.01;        // rad or m
constexpr double kCloseMargin = 0.1;         // of the full margin
constexpr std::size_t kPoseSolutions = 16;   // tried per tool position before one is chosen
constexpr std::size_t kSquareSolutions = 4;  // for each of the four ways to stand square to a module
constexpr double kSquare = 1e-6;             // off a coordinate axis by no more than this

std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

std::string title_of(const NamedPose& pose) {
  return (pose.source.empty() ? "" : pose.source + ": ") + "pose '" + pose.name + "'";
}

JointVector reference_of(const ArmSetup& setup) {
  for (const NamedPose& pose : setup.poses) {
    if (const auto* joints = std::get_if<JointVector>(&pose.where)) return *joints;
  }
  JointVector middle(static_cast<Eigen::Index>(setup.arm.joints.size()));
  for (Eigen::Index i = 0; i < middle.size(); ++i) {
    const auto& limits = setup.arm.joints[static_cast<std::size_t>(i)].limits;
    middle[i] = 0.5 * (limits.lower + limits.upper);
  }
  return middle;
}

// A target leaves joints free (the turn about an approach): those take the reference's value.
JointVector with_free_joints_at_rest(const ArmSetup& setup, const ToolTarget& target, JointVector q,
                                     const JointVector& reference) {
  const IkOptions tolerances;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    JointVector trial = q;
    trial[i] = reference[i];
    const ToolError error = tool_error(setup.arm, trial, target);
    const bool still_there =
        error.position < tolerances.position_tolerance && error.angle < tolerances.angle_tolerance;
    if (still_there && kinematics::within_limits(setup.arm, trial)) q = trial;
  }
  return q;
}

// Returns the turns of the tool that point its axis along the direction and its other axes along those of the
// base; none unless both are along an axis.
std::vector<Eigen::Quaterniond> square_turns(const Approach& approach) {
  std::vector<Eigen::Quaterniond> turns;
  std::array<Eigen::Index, 3> order{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
      for (Eigen::Index i = 0; i < 3; ++i)
        turn(order[static_cast<std::size_t>(i)], i) = ((signs >> i) & 1) != 0 ? -1.0 : 1.0;
      const bool points = (turn * approach.tool_axis - approach.direction).norm() < kSquare;
      if (points && turn.determinant() > 0) turns.emplace_back(turn);
    }
  } while (std::ranges::next_permutation(order).found);
  const auto along_an_axis = [](const Eigen::Vector3d& v) { return v.cwiseAbs().maxCoeff() > 1.0 - kSquare; };
  return along_an_axis(approach.direction) ? turns : std::vector<Eigen::Quaterniond>{};
}

// Returns the direction in which the tool points at the pose, in the base frame.
Eigen::Vector3d pointing(const ToolTarget& target, const Eigen::Vector3d& tool_axis) {
  if (target.orientation) return *target.orientation * tool_axis;
  return target.approach ? target.approach->direction : Eigen::Vector3d(-Eigen::Vector3d::UnitZ());
}

std::vector<Module> modules_of(const ArmSetup& setup) {
  std::vector<Module> modules;
  for (const NamedPose& pose : setup.poses) {
    const auto* target = std::get_if<ToolTarget>(&pose.where);
    if (!pose.module_size || target == nullptr) continue;
    Eigen::Isometry3d stand = Eigen::Isometry3d::Identity();
    stand.translation() =
        target->position + held_centre(*pose.module_size, pointing(*target, setup.tool_axis));
    modules.push_back({pose.name, {"module at " + pose.name, stand, kinematics::Box{*pose.module_size}}});
  }
  return modules;
}

std::vector<kinematics::CollisionShape> shapes_of(const std::vector<Module>& modules) {
  std::vector<kinematics::CollisionShape> shapes;
  for (const Module& module : modules) shapes.push_back(module.shape);
  return shapes;
}

}  // namespace

CollisionRules with_close_margin(CollisionRules rules) {
  rules.margin *= kCloseMargin;
  return rules;
}

std::string touching(const std::string& what, const Contact& contact) {
  return what + ": " + contact.first + " touches " + contact.second;
}

Places::Places(std::shared_ptr<const ArmSetup> setup)
    : setup_(std::move(setup)),
      modules_(modules_of(*setup_)),
      checker_(setup_->arm, setup_->collision, shapes_of(modules_)),
      close_checker_(setup_->arm, with_close_margin(setup_->collision)),
      reach_(kinematics::reach_bound(setup_->arm)),
      reference_(reference_of(*setup_)) {
  for (const NamedPose& pose : setup_->poses) {
    index_.emplace(pose.name, poses_.size());
    poses_.push_back(resolve(pose, 1));
  }
}

std::optional<Contact> Places::contact(const NamedPose& pose, const JointVector& q) const {
  auto contact = checker_.contact(q);
  if (!contact || contact->second != "module at " + pose.name) return contact;
  for (const std::size_t i : checker_.obstacles_touched(q)) {
    if (modules_[i].pose != pose.name) return Contact{contact->first, modules_[i].shape.link};
  }
  return std::nullopt;
}

// The arm with the module in its tool touches neither itself nor what is fixed; other modules stand apart.
bool Places::free_when_carrying(const Eigen::Vector3d& module_size, const JointVector& q) const {
  const Eigen::Matrix3d turn = kinematics::tool_pose(setup_->arm, q).linear();
  const Payload load{0, turn.cwiseAbs().transpose() * module_size};
  const CollisionChecker carrying(loaded(setup_->arm, load, setup_->tool_axis),
                                  with_close_margin(setup_->collision));
  return !carrying.contact(q);
}

std::vector<JointVector> Places::candidates(const NamedPose& pose, const ToolTarget& target,
                                            int starts) const {
  IkOptions options;
  options.starts = starts;
  options.solutions = kPoseSolutions;
  std::vector<JointVector> candidates;
  if (pose.module_size && target.approach) {
    options.solutions = kSquareSolutions;
    for (const Eigen::Quaterniond& turn : square_turns(*target.approach)) {
      const ToolTarget square{target.position, std::nullopt, turn};
      for (const JointVector& q : solve_ik(setup_->arm, square, reference_, options)) candidates.push_back(q);
    }
    if (!candidates.empty()) return candidates;
    options.solutions = kPoseSolutions;
  }
  candidates = solve_ik(setup_->arm, target, reference_, options);
  for (JointVector& q : candidates) q = with_free_joints_at_rest(*setup_, target, q, reference_);
  return candidates;
}

ResolvedPlace Places::resolve_joints(const NamedPose& pose, const JointVector& joints) const {
  ResolvedPlace resolved{pose.name, MotionStatus::found, {}, {}, true, true};
  if (!kinematics::within_limits(setup_->arm, joints)) {
    resolved.status = MotionStatus::unreachable;
    resolved.detail = title_of(pose) + " is out of the arm's reach or limits";
    for (Eigen::Index i = 0; i < joints.size() && joints.size() == reference_.size(); ++i) {
      const kinematics::Joint& joint = setup_->arm.joints[static_cast<std::size_t>(i)];
      if (joints[i] >= joint.limits.lower && joints[i] <= joint.limits.upper) continue;
      resolved.detail += ": joint '" + joint.name + "' turns or slides from " + text_of(joint.limits.lower) +
                         " to " + text_of(joint.limits.upper) + ", not to " + text_of(joints[i]);
      break;
    }
  } else if (const auto contact = this->contact(pose, joints)) {
    resolved.status = MotionStatus::in_collision;
    resolved.detail = touching(title_of(pose), *contact);
    // Modules are only assumed to stand there.
    resolved.proved = !contact->second.starts_with("module at ");
  } else {
    resolved.joints = joints;
    resolved.proved = false;
  }
  return resolved;
}

ResolvedPlace Places::resolve_target(const NamedPose& pose, const ToolTarget& target, int starts) const {
  ResolvedPlace resolved{pose.name, MotionStatus::found, {}, {}};
  if (const double excess = reach_.excess(target.position); excess > 0) {
    resolved.status = MotionStatus::unreachable;
    resolved.proved = true;
    resolved.detail = title_of(pose) + " is out of the arm's reach, by " + text_of(excess) +
                      " m at least; its links are " + text_of(reach_.radius) +
                      " m together: move the pose nearer";
    return resolved;
  }
  std::vector<JointVector> found = candidates(pose, target, starts);
  if (found.empty()) {
    resolved.status = MotionStatus::unsolved;
    resolved.detail = title_of(pose) + ": no joint values were found that put the tool there, from " +
                      std::to_string(starts) +
                      " starts; it may lie outside the work space, or need another approach";
    return resolved;
  }
  const auto quicker = [&](const JointVector& a, const JointVector& b) {
    return line_duration_s(setup_->arm, reference_, a) < line_duration_s(setup_->arm, reference_, b);
  };
  std::stable_sort(found.begin(), found.end(), quicker);
  if (pose.module_size) {
    std::stable_partition(found.begin(), found.end(),
                          [&](const JointVector& q) { return free_when_carrying(*pose.module_size, q); });
  }
  for (const JointVector& q : found) {
    const auto contact = this->contact(pose, q);
    if (!contact) {
      resolved.joints = q;
      resolved.detail.clear();
      return resolved;
    }
    if (resolved.detail.empty()) resolved.detail = touching(title_of(pose), *contact);
  }
  resolved.status = MotionStatus::in_collision;
  return resolved;
}

ResolvedPlace Places::resolve(const NamedPose& pose, unsigned effort) const {
  if (const auto* joints = std::get_if<JointVector>(&pose.where)) return resolve_joints(pose, *joints);
  const int starts = IkOptions{}.starts;
  ResolvedPlace resolved;
  for (unsigned tried = 1; tried <= effort; tried *= 2) {
    resolved = resolve_target(pose, std::get<ToolTarget>(pose.where), starts * static_cast<int>(tried));
    if (resolved.status == MotionStatus::found || resolved.proved) break;
  }
  return resolved;
}

// Whatever the arm touches where it stands, no module can be there.
ResolvedPlace Places::resolve_stand(const Place& place) const {
  ResolvedPlace resolved{place.name, MotionStatus::found, {}, {}, true, true};
  if (!kinematics::within_limits(setup_->arm, *place.joints, kSensorNoise)) {
    resolved.status = MotionStatus::unreachable;
    resolved.detail = "the joint values of '" + place.name + "' are beyond the limits or of the wrong number";
    return resolved;
  }
  const JointVector joints = kinematics::clamp_to_limits(setup_->arm, *place.joints);
  if (const auto contact = close_checker_.contact(joints)) {
    resolved.status = MotionStatus::in_collision;
    resolved.detail = touching("'" + place.name + "'", *contact);
    return resolved;
  }
  resolved.joints = joints;
  resolved.proved = false;
  return resolved;
}

ResolvedPlace Places::resolve(const Place& place, unsigned effort) const {
  if (place.joints) return resolve_stand(place);
  if (const auto known = index_.find(place.name); known != index_.end()) {
    const ResolvedPlace& pose = poses_[known->second];
    const bool settled = pose.status == MotionStatus::found || pose.proved || effort <= 1;
    return settled ? pose : resolve(setup_->poses[known->second], effort);
  }
  if (place.position) return resolve(NamedPose{place.name, ToolTarget{*place.position, {}, {}}}, effort);
  return {place.name, MotionStatus::unknown_pose, "no pose '" + place.name + "' in the arm's data", {}};
}

}  // namespace roci::arm
