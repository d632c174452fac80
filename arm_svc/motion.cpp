#include "arm_svc/motion.hpp"

#include <algorithm>

#include "arm_svc/energy.hpp"
#include "arm_svc/sampling.hpp"
#include "arm_svc/shortcut.hpp"

namespace roci::arm {
namespace {

using kinematics::JointVector;

constexpr double kSensorNoise = 0.01;       // rad or m
constexpr std::size_t kPoseSolutions = 16;  // tried per tool position before one is chosen

Motion failed(MotionStatus status, std::string detail) {
  Motion motion;
  motion.status = status;
  motion.detail = std::move(detail);
  return motion;
}

std::string touching(const std::string& what, const Contact& contact) {
  return what + ": " + contact.first + " touches " + contact.second;
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

std::vector<JointVector> tool_candidates(const ArmSetup& setup, const ToolTarget& target,
                                         const JointVector& reference) {
  IkOptions options;
  options.solutions = kPoseSolutions;
  std::vector<JointVector> candidates = solve_ik(setup.arm, target, reference, options);
  for (JointVector& q : candidates) q = with_free_joints_at_rest(setup, target, q, reference);
  return candidates;
}

}  // namespace

std::string_view name_of(MotionStatus status) {
  switch (status) {
    case MotionStatus::found:
      return "found";
    case MotionStatus::unknown_pose:
      return "unknown_pose";
    case MotionStatus::unreachable:
      return "unreachable";
    case MotionStatus::in_collision:
      return "in_collision";
    case MotionStatus::no_path:
      return "no_path";
    case MotionStatus::overloaded:
      return "overloaded";
    case MotionStatus::cancelled:
      return "cancelled";
  }
  return "invalid";
}

MotionModel::MotionModel(ArmSetup setup)
    : setup_(std::move(setup)), checker_(setup_.arm, setup_.collision), version_(model_version(setup_)) {
  const JointVector reference = reference_of(setup_);
  for (const NamedPose& pose : setup_.poses) poses_.push_back(resolve(pose, reference));
}

ResolvedPose MotionModel::resolve(const NamedPose& pose, const JointVector& reference) const {
  ResolvedPose resolved{pose.name, MotionStatus::found, {}, {}};
  std::vector<JointVector> candidates;
  if (const auto* joints = std::get_if<JointVector>(&pose.where)) {
    if (kinematics::within_limits(setup_.arm, *joints)) candidates.push_back(*joints);
  } else {
    candidates = tool_candidates(setup_, std::get<ToolTarget>(pose.where), reference);
  }
  if (candidates.empty()) {
    resolved.status = MotionStatus::unreachable;
    resolved.detail = "pose '" + pose.name + "' is out of the arm's reach or limits";
    return resolved;
  }
  const auto quicker = [&](const JointVector& a, const JointVector& b) {
    return line_duration_s(setup_.arm, reference, a) < line_duration_s(setup_.arm, reference, b);
  };
  std::stable_sort(candidates.begin(), candidates.end(), quicker);
  for (const JointVector& q : candidates) {
    const auto contact = checker_.contact(q);
    if (!contact) {
      resolved.joints = q;
      return resolved;
    }
    if (resolved.detail.empty()) resolved.detail = touching("pose '" + pose.name + "'", *contact);
  }
  resolved.status = MotionStatus::in_collision;
  return resolved;
}

const ResolvedPose* MotionModel::find(std::string_view name) const {
  const auto pose = std::find_if(poses_.begin(), poses_.end(), [&](const auto& p) { return p.name == name; });
  return pose == poses_.end() ? nullptr : &*pose;
}

Motion MotionModel::motion(std::string_view from, std::string_view to, const Cancelled& cancelled) const {
  for (const std::string_view name : {from, to}) {
    const ResolvedPose* pose = find(name);
    if (pose == nullptr) {
      return failed(MotionStatus::unknown_pose, "no pose '" + std::string(name) + "' in the arm's data");
    }
    if (pose->status != MotionStatus::found) return failed(pose->status, pose->detail);
  }
  return between(find(from)->joints, find(to)->joints, cancelled);
}

Motion MotionModel::motion(const JointVector& from, std::string_view to, const Cancelled& cancelled) const {
  const ResolvedPose* goal = find(to);
  if (goal == nullptr) {
    return failed(MotionStatus::unknown_pose, "no pose '" + std::string(to) + "' in the arm's data");
  }
  if (goal->status != MotionStatus::found) return failed(goal->status, goal->detail);
  if (!kinematics::within_limits(setup_.arm, from, kSensorNoise)) {
    return failed(MotionStatus::unreachable, "the start is beyond the joint limits or has the wrong size");
  }
  const JointVector start = kinematics::clamp_to_limits(setup_.arm, from);
  if (const auto contact = checker_.contact(start)) {
    return failed(MotionStatus::in_collision, touching("the start", *contact));
  }
  return between(start, goal->joints, cancelled);
}

Motion MotionModel::between(const JointVector& from, const JointVector& to,
                            const Cancelled& cancelled) const {
  const auto found = find_path(setup_.arm, checker_, from, to, {setup_.search_iterations, cancelled});
  if (const auto* failure = std::get_if<SearchFailure>(&found)) {
    if (*failure == SearchFailure::cancelled) return failed(MotionStatus::cancelled, "cancelled");
    return failed(MotionStatus::no_path,
                  "no path within " + std::to_string(setup_.search_iterations) + " search iterations");
  }
  const JointPath path = shortened(setup_.arm, checker_, std::get<JointPath>(found), setup_.shortcut_trials,
                                   query_seed(from, to));
  Motion motion;
  motion.trajectory = time_path(setup_.arm, path);
  motion.duration_s = motion.trajectory.duration_s();
  const EnergyUse use = energy_of(setup_.arm, motion.trajectory, setup_.motor);
  motion.energy_j = use.energy_j;
  if (use.peak_load > 1.0) {
    return failed(MotionStatus::overloaded, "joint '" + setup_.arm.joints[use.peak_joint].name +
                                                "' would need " + std::to_string(use.peak_load) +
                                                " times its effort limit");
  }
  return motion;
}

}  // namespace roci::arm
