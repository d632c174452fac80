#include "arm_svc/motion.hpp"

#include <algorithm>

#include "arm_svc/energy.hpp"
#include "arm_svc/sampling.hpp"
#include "arm_svc/shortcut.hpp"

namespace roci::arm {
namespace {

using kinematics::JointVector;

constexpr double kSensorNoise = 0.01;       // rad or m
constexpr double kCloseMargin = 0.1;        // of the full margin
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

CollisionRules with_close_margin(CollisionRules rules) {
  rules.margin *= kCloseMargin;
  return rules;
}

Motion costed(const ArmSetup& setup, Trajectory trajectory) {
  const EnergyUse use = energy_of(setup.arm, trajectory, setup.motor);
  if (use.peak_load > 1.0) {
    return failed(MotionStatus::overloaded, "joint '" + setup.arm.joints[use.peak_joint].name +
                                                "' would need " + std::to_string(use.peak_load) +
                                                " times its effort limit");
  }
  const double duration = trajectory.duration_s();
  return {MotionStatus::found, {}, std::move(trajectory), duration, use.energy_j};
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
    : setup_(std::move(setup)),
      checker_(setup_.arm, setup_.collision),
      close_checker_(setup_.arm, with_close_margin(setup_.collision)),
      version_(model_version(setup_)) {
  const JointVector reference = reference_of(setup_);
  for (const NamedPose& pose : setup_.poses) poses_.push_back(resolve(pose, reference));
}

ResolvedPlace MotionModel::resolve(const NamedPose& pose, const JointVector& reference) const {
  ResolvedPlace resolved{pose.name, MotionStatus::found, {}, {}};
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

ResolvedPlace MotionModel::resolve(const Place& place) const {
  if (!place.joints) {
    const auto pose =
        std::find_if(poses_.begin(), poses_.end(), [&](const auto& p) { return p.name == place.name; });
    if (pose != poses_.end()) return *pose;
    return {place.name, MotionStatus::unknown_pose, "no pose '" + place.name + "' in the arm's data", {}};
  }
  if (!kinematics::within_limits(setup_.arm, *place.joints, kSensorNoise)) {
    return {place.name,
            MotionStatus::unreachable,
            "the joint values of '" + place.name + "' are beyond the limits or of the wrong number",
            {}};
  }
  const JointVector joints = kinematics::clamp_to_limits(setup_.arm, *place.joints);
  if (const auto contact = close_checker_.contact(joints)) {
    return {place.name, MotionStatus::in_collision, touching("'" + place.name + "'", *contact), {}};
  }
  return {place.name, MotionStatus::found, {}, joints};
}

Motion MotionModel::motion(const Place& from, const Place& to, const std::function<bool()>& cancelled) const {
  const ResolvedPlace start = resolve(from), goal = resolve(to);
  for (const ResolvedPlace* end : {&start, &goal}) {
    if (end->status != MotionStatus::found) return failed(end->status, end->detail);
  }
  const bool roomy = !checker_.contact(start.joints) && !checker_.contact(goal.joints);
  const CollisionChecker& checker = roomy ? checker_ : close_checker_;
  const auto found =
      find_path(setup_.arm, checker, start.joints, goal.joints, {setup_.search_iterations, cancelled});
  if (const auto* failure = std::get_if<SearchFailure>(&found)) {
    if (*failure == SearchFailure::cancelled) return failed(MotionStatus::cancelled, "cancelled");
    return failed(MotionStatus::no_path,
                  "no path within " + std::to_string(setup_.search_iterations) + " search iterations");
  }
  const JointPath path = shortened(setup_.arm, checker, std::get<JointPath>(found), setup_.shortcut_trials,
                                   query_seed(start.joints, goal.joints));
  return costed(setup_, time_path(setup_.arm, path));
}

}  // namespace roci::arm
