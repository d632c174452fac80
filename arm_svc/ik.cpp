#include "arm_svc/ik.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "arm_svc/sampling.hpp"
#include "core/kinematics/forward.hpp"

namespace roci::arm {
namespace {

using kinematics::Arm;
using kinematics::Jacobian;
using kinematics::JointVector;
using Twist = Eigen::Matrix<double, 6, 1>;
using JointMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                  kinematics::kMaxJoints, kinematics::kMaxJoints>;

constexpr double kDampingBias = 1e-9;   // keeps the step solvable at the solution itself
constexpr double kAngleWeight = 0.1;    // m² per rad²: an error of 1 rad counts like one of 0.3 m
constexpr double kSameSolution = 1e-3;  // rad or m
constexpr double kStalledStep = 1e-9;   // rad or m
constexpr int kPatience = 10;           // iterations, in which
constexpr double kProgress = 0.9;       // the error must fall to this share, or the start leads nowhere
constexpr int kMoreStarts = 3;          // times as many, where those asked for led nowhere

// Returns the rotation vector that turns `from` onto `to` (unit vectors); opposite vectors turn about any
// normal.
Eigen::Vector3d turn_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d normal = from.cross(to);
  const double sine = normal.norm(), cosine = from.dot(to);
  if (sine < 1e-12) return (cosine > 0 ? 0.0 : std::numbers::pi) * from.unitOrthogonal();
  return std::atan2(sine, cosine) / sine * normal;
}

Eigen::Vector3d turn_left(const Eigen::Isometry3d& tool, const ToolTarget& target) {
  if (target.orientation) {
    const Eigen::Matrix3d rest = target.orientation->toRotationMatrix() * tool.linear().transpose();
    const Eigen::AngleAxisd turn(rest);
    return turn.angle() * turn.axis();
  }
  if (target.approach) {
    return turn_between(tool.linear() * target.approach->tool_axis.normalized(),
                        target.approach->direction.normalized());
  }
  return Eigen::Vector3d::Zero();
}

Twist error_twist(const Eigen::Isometry3d& tool, const ToolTarget& target) {
  Twist error;
  error << target.position - tool.translation(), turn_left(tool, target);
  return error;
}

ToolError size_of(const Twist& error) { return {error.head<3>().norm(), error.tail<3>().norm()}; }

Twist weights_for(const ToolTarget& target) {
  Twist weights = Twist::Ones();
  weights.tail<3>().setConstant(target.orientation || target.approach ? kAngleWeight : 0.0);
  return weights;
}

// Takes their part along the direction of an approach out of the angular rows: turning about it costs and
// gains nothing.
void free_the_turn(Jacobian& jacobian, const Eigen::Isometry3d& tool, const ToolTarget& target) {
  if (!target.approach) return;
  const Eigen::Vector3d axis = tool.linear() * target.approach->tool_axis.normalized();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
  jacobian.bottomRows<3>() = (across * jacobian.bottomRows<3>()).eval();
}

// Returns one damped step; joints that stand at a limit and would be pushed over it are left out.
JointVector damped_step(const Arm& arm, const JointVector& q, const Jacobian& jacobian, const Twist& error,
                        const Twist& weights) {
  const JointVector pull = jacobian.transpose() * weights.cwiseProduct(error);
  const double damping = 0.5 * error.dot(weights.cwiseProduct(error)) + kDampingBias;
  JointMatrix normal = jacobian.transpose() * weights.asDiagonal() * jacobian;
  normal.diagonal().array() += damping;
  JointVector right = pull;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const auto& limits = arm.joints[static_cast<std::size_t>(i)].limits;
    const bool frozen = (q[i] <= limits.lower && pull[i] < 0) || (q[i] >= limits.upper && pull[i] > 0);
    if (!frozen) continue;
    normal.row(i).setZero();
    normal.col(i).setZero();
    normal(i, i) = 1.0;
    right[i] = 0.0;
  }
  return normal.ldlt().solve(right);
}

std::optional<JointVector> descend(const Arm& arm, const ToolTarget& target, JointVector q,
                                   const IkOptions& options) {
  const Twist weights = weights_for(target);
  double earlier = std::numeric_limits<double>::infinity();
  for (int i = 0; i < options.iterations; ++i) {
    const auto bodies = kinematics::body_poses(arm, q);
    const Eigen::Isometry3d tool = kinematics::tool_pose(arm, bodies);
    const Twist error = error_twist(tool, target);
    const ToolError size = size_of(error);
    if (size.position < options.position_tolerance && size.angle < options.angle_tolerance) return q;
    if (i % kPatience == 0) {
      const double now = error.dot(weights.cwiseProduct(error));
      if (!(now < kProgress * earlier)) return std::nullopt;
      earlier = now;
    }
    Jacobian jacobian = kinematics::tool_jacobian(arm, bodies);
    free_the_turn(jacobian, tool, target);
    const JointVector next =
        kinematics::clamp_to_limits(arm, q + damped_step(arm, q, jacobian, error, weights));
    if (!((next - q).cwiseAbs().maxCoeff() > kStalledStep)) return std::nullopt;
    q = next;
  }
  return std::nullopt;
}

JointVector middle_of_limits(const Arm& arm) {
  JointVector q(static_cast<Eigen::Index>(arm.joints.size()));
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const auto& limits = arm.joints[static_cast<std::size_t>(i)].limits;
    q[i] = 0.5 * (limits.lower + limits.upper);
  }
  return q;
}

// Returns the part of `index`, written with digits of `base`, that its digits have when they are mirrored at the point.
double radical_inverse(int index, int base) {
  double value = 0, digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base) value += digit * (index % base);
  return value;
}

// Spreads starts evenly over the limits (J. H. Halton, Numerische Mathematik 2, 1960).
JointVector spread_coordinates(const Arm& arm, int index) {
  constexpr std::array<int, kinematics::kMaxJoints> kPrimes{2, 3, 5, 7, 11, 13, 17};
  JointVector q(static_cast<Eigen::Index>(arm.joints.size()));
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const auto& limits = arm.joints[static_cast<std::size_t>(i)].limits;
    q[i] = limits.lower +
           (limits.upper - limits.lower) * radical_inverse(index, kPrimes[static_cast<std::size_t>(i)]);
  }
  return q;
}

}  // namespace

ToolError tool_error(const Arm& arm, const JointVector& q, const ToolTarget& target) {
  return size_of(error_twist(kinematics::tool_pose(arm, q), target));
}

std::vector<JointVector> solve_ik(const Arm& arm, const ToolTarget& target, const JointVector& first_start,
                                  const IkOptions& options) {
  std::vector<JointVector> found;
  std::mt19937_64 rng(options.seed);
  const auto more = [&](int start) {
    return start < options.starts ? found.size() < options.solutions
                                  : found.empty() && start < kMoreStarts * options.starts;
  };
  for (int start = 0; more(start); ++start) {
    const JointVector q = start == 0               ? kinematics::clamp_to_limits(arm, first_start)
                          : start == 1             ? middle_of_limits(arm)
                          : start < options.starts ? sample_coordinates(arm, rng)
                                                   : spread_coordinates(arm, start);
    const auto solution = descend(arm, target, q, options);
    if (!solution) continue;
    const bool known = std::any_of(found.begin(), found.end(), [&](const JointVector& other) {
      return (other - *solution).cwiseAbs().maxCoeff() < kSameSolution;
    });
    if (!known) found.push_back(*solution);
  }
  return found;
}

}  // namespace roci::arm
