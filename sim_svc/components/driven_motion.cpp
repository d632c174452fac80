#include "sim_svc/components/driven_motion.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

namespace roci::sim::components {

using kinematics::JointVector;

namespace {

constexpr int kSteps = 5;                // of the integration in each kArmStep
constexpr double kMomentSeconds = 0.05;  // is kArmStep
constexpr double kStepSeconds = kMomentSeconds / kSteps;
constexpr int kFrictionSweeps = 6;
constexpr double kPaceLag = 0.5;      // s, in which the controller changes its pace
constexpr double kLoadLag = 1;        // s, over which a motor's load counts
constexpr double kLeastPace = 0.1;    // of an overloaded arm
constexpr double kSlowRate = 1e-3;    // rad/s or m/s, below which friction is not fed forward in full
constexpr double kProgress = 0.01;    // s along the course that count as getting on
constexpr double kLongest = 20;       // times the course's duration
constexpr double kLongestRest = 300;  // s beside that

std::vector<double> rotors_of(const DrivenArmParameters& parameters) {
  std::vector<double> out;
  for (const kinematics::Joint& joint : parameters.arm->joints)
    out.push_back(parameters.rotor_share * joint.limits.effort / joint.limits.acceleration);
  return out;
}

std::string rounded(double value) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(3) << value;
  return out.str();
}

}  // namespace

// What the controller works out once a moment and holds.
struct DrivenMotion::Control {
  JointVector forward;  // effort that the believed arm would need
  JointVector inertia;  // that it would feel at each joint
  CoursePoint wanted;   // at the moment's start
  double pace_goal = 1;
};

DrivenMotion::DrivenMotion(const DrivenArmParameters& parameters, const std::vector<double>& from,
                           JointsWear wear, const std::vector<world::JointTarget>& targets,
                           const kinematics::MassProperties& believed_load,
                           const kinematics::MassProperties& true_load, double friction)
    : parameters_(parameters),
      course_(targets),
      rotors_(rotors_of(parameters)),
      believed_(*parameters.arm, parameters.gravity, believed_load, rotors_),
      true_(*parameters.arm, parameters.gravity, true_load, rotors_),
      friction_(friction) {
  const auto count = static_cast<Eigen::Index>(from.size());
  const JointVector zero = JointVector::Zero(count);
  moments_.push_back(
      {Eigen::Map<const Eigen::VectorXd>(from.data(), count), zero, zero, zero, zero, std::move(wear)});
  run();
}

void DrivenMotion::go_on_from(std::size_t moment, JointsWear wear) {
  moments_.resize(std::min(moment, moments_.size() - 1) + 1);
  moments_.back().wear = std::move(wear);
  run();
}

const JointsWear& DrivenMotion::wear_at(std::size_t moment) const {
  return moments_[std::min(moment, moments_.size() - 1)].wear;
}

void DrivenMotion::plan(const DrivenMoment& now, Control& out) const {
  const Eigen::Index count = true_.joints();
  out.wanted = course_.at(now.course_s);
  double behind = 0, overload = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    behind = std::max(behind, std::abs(out.wanted.position[i] - now.position[i]) / parameters_.follow_rad);
    overload = std::max(overload, now.load[i]);
  }
  out.pace_goal = std::clamp(2 * (1 - behind), 0.0, 1.0);
  const double over = (overload - parameters_.continuous_load) / (1 - parameters_.continuous_load);
  if (over > 0) out.pace_goal = std::min(out.pace_goal, std::max(kLeastPace, 1 - over));
  const JointVector rate = out.wanted.rate * now.pace;
  const JointVector change =
      out.wanted.change * (now.pace * now.pace) + out.wanted.rate * ((out.pace_goal - now.pace) / kPaceLag);
  const MotionEquation believed = believed_.equation(out.wanted.position, rate);
  out.forward = believed.inertia * change + believed.bias;
  out.inertia = believed.inertia.diagonal();
  for (Eigen::Index i = 0; i < count; ++i) {
    const kinematics::Joint& joint = parameters_.arm->joints[static_cast<std::size_t>(i)];
    out.forward[i] +=
        joint.friction * rate[i] / std::max(std::abs(rate[i]), kSlowRate) + joint.damping * rate[i];
  }
}

void DrivenMotion::step(DrivenMoment& now, const Control& control, double& peak_power_w) const {
  const Eigen::Index count = true_.joints();
  const std::vector<kinematics::Joint>& joints = parameters_.arm->joints;
  const double lambda = parameters_.bandwidth;
  now.pace += (control.pace_goal - now.pace) * (kStepSeconds / kPaceLag);
  now.course_s = std::min(course_.duration_s(), now.course_s + now.pace * kStepSeconds);
  const CoursePoint wanted = course_.at(now.course_s);
  JointVector effort(count), drag(count), bound(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const kinematics::Joint& joint = joints[static_cast<std::size_t>(i)];
    const double limit = joint.limits.effort * parameters_.motor_strength;
    const double error = wanted.position[i] - now.position[i];
    const double error_rate = wanted.rate[i] * now.pace - now.rate[i];
    const double asked = control.forward[i] + now.held[i] +
                         control.inertia[i] * (3 * lambda * lambda * error + 3 * lambda * error_rate);
    effort[i] = std::clamp(asked, -limit, limit);
    const bool saturated = asked * error > 0 && std::abs(asked) > limit;
    const bool there = wanted.rate[i] == 0 && std::abs(error) < 0.5 * parameters_.settled_rad;
    if (!saturated && !there) {
      const double more = control.inertia[i] * 0.5 * lambda * lambda * lambda * error * kStepSeconds;
      now.held[i] = std::clamp(now.held[i] + more, -limit, limit);
    }
    drag[i] = joint.damping * friction_;
    bound[i] = (joint.friction * friction_ + now.wear.friction[i]) * kStepSeconds;
  }
  const MotionEquation motion = true_.equation(now.position, now.rate);
  JointMatrix implicit = motion.inertia;
  implicit.diagonal() += kStepSeconds * drag;
  const JointMatrix response = implicit.llt().solve(JointMatrix::Identity(count, count));
  const JointVector push = effort - motion.bias - drag.cwiseProduct(now.rate);
  now.pressed = now.pressed.cwiseMax(-bound).cwiseMin(bound);
  JointVector rate = now.rate + response * (kStepSeconds * push + now.pressed);
  for (int sweep = 0; sweep < kFrictionSweeps; ++sweep) {
    for (Eigen::Index i = 0; i < count; ++i) {
      const double pressed = std::clamp(now.pressed[i] - rate[i] / response(i, i), -bound[i], bound[i]);
      rate += response.col(i) * (pressed - now.pressed[i]);
      now.pressed[i] = pressed;
    }
  }
  now.position += kStepSeconds * rate;
  double power = parameters_.electronics_w;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double limit = joints[static_cast<std::size_t>(i)].limits.effort;
    const double load = std::abs(effort[i]) / limit;
    const double work = effort[i] * 0.5 * (now.rate[i] + rate[i]);
    const double gear = std::abs(work) * (1 / parameters_.gear_efficiency - 1);
    power += std::max(0.0, work + gear + parameters_.copper_loss_w * load * load);
    now.load[i] += (load / parameters_.motor_strength - now.load[i]) * (kStepSeconds / kLoadLag);
    now.wear.friction[i] += now.wear.growth[i] * std::abs(rate[i]) * kStepSeconds;
  }
  now.rate = rate;
  now.energy_j += power * kStepSeconds;
  peak_power_w = std::max(peak_power_w, power);
}

void DrivenMotion::run() {
  stalled_.clear();
  const auto moments_in = [](double time_s) { return static_cast<std::size_t>(time_s / kMomentSeconds); };
  const std::size_t longest = moments_in(kLongest * course_.duration_s() + kLongestRest);
  std::size_t got_on = moments_.size();
  std::size_t settled = 0;  // moments in a row
  double course_then = moments_.back().course_s;
  double nearest = std::numeric_limits<double>::infinity();
  Control control;
  while (stalled_.empty()) {
    DrivenMoment next = moments_.back();
    plan(next, control);
    for (int i = 0; i < kSteps; ++i) step(next, control, peak_power_w_);
    const bool arrived = next.course_s >= course_.duration_s();
    const double away = (course_.end() - next.position).cwiseAbs().maxCoeff();
    const double speed = next.rate.cwiseAbs().maxCoeff();
    const bool nearer = arrived && away < nearest - 0.1 * parameters_.settled_rad;
    if (next.course_s > course_then + kProgress || nearer) {
      got_on = moments_.size();
      course_then = next.course_s;
      if (arrived) nearest = away;
    }
    const bool rests = arrived && away < parameters_.settled_rad && speed < parameters_.settled_rad_s;
    settled = rests ? settled + 1 : 0;
    moments_.push_back(std::move(next));
    if (rests && settled > moments_in(parameters_.settle_s)) return;
    if (moments_.size() > got_on + moments_in(parameters_.stall_s) || moments_.size() > longest)
      stalled_ = short_of_target(moments_.back());
  }
}

std::string DrivenMotion::short_of_target(const DrivenMoment& last) const {
  const CoursePoint wanted = course_.at(last.course_s);
  const JointVector missing = (wanted.position - last.position).cwiseAbs();
  Eigen::Index worst = 0;
  missing.maxCoeff(&worst);
  const kinematics::Joint& joint = parameters_.arm->joints[static_cast<std::size_t>(worst)];
  const bool turns = joint.type == kinematics::JointType::revolute;
  return "the arm does not get on: joint '" + joint.name + "' stands " +
         rounded(std::abs(course_.end()[worst] - last.position[worst])) + (turns ? " rad" : " m") +
         " short of its target, and friction and load hold it against all that its motor has (" +
         rounded(joint.limits.effort * parameters_.motor_strength) + (turns ? " N·m)" : " N)");
}

ArmTrace DrivenMotion::trace(temporal::Time start) const {
  ArmTrace out{start, {}, std::max(peak_power_w_, parameters_.electronics_w), stalled_};
  out.samples.reserve(moments_.size());
  for (const DrivenMoment& moment : moments_)
    out.samples.push_back({{moment.position.begin(), moment.position.end()}, moment.energy_j});
  return out;
}

}  // namespace roci::sim::components
