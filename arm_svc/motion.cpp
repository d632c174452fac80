#include "arm_svc/motion.hpp"

#include <algorithm>
#include <set>

#include "arm_svc/energy.hpp"
#include "arm_svc/path_search.hpp"
#include "arm_svc/sampling.hpp"
#include "arm_svc/shortcut.hpp"
#include "arm_svc/slow_down.hpp"

namespace roci::arm {
namespace {

using kinematics::Arm;
using kinematics::CollisionShape;

constexpr double kLongestMotion = 10'000;  // s; a reply has ten samples for each

Motion failed(MotionStatus status, std::string detail, bool proved) {
  Motion motion;
  motion.status = status;
  motion.detail = std::move(detail);
  motion.proved = proved;
  return motion;
}

// The first of the two that has no joint values, or nothing.
const ResolvedPlace* unusable(const ResolvedPlace& from, const ResolvedPlace& to) {
  if (from.status != MotionStatus::found) return &from;
  return to.status != MotionStatus::found ? &to : nullptr;
}

std::string overload(const Arm& arm, const HoldingLoad& most, const std::string& where) {
  return "joint '" + arm.joints[most.joint].name + "' would need " + std::to_string(most.load) +
         " times its effort limit" + where;
}

// Says that the arm cannot even stand still at one of the ends, though friction holds what it can.
struct Unbearable {
  std::string detail;
  bool proved = false;  // of every motion, since the joint values were given
};

std::optional<Unbearable> unbearable(const Arm& arm, const MotorModel& motor, const ResolvedPlace& from,
                                     const ResolvedPlace& to) {
  std::optional<Unbearable> found;
  for (const ResolvedPlace* end : {&from, &to}) {
    const HoldingLoad most = holding_load(arm, end->joints, motor);
    if (most.load <= 1.0 || (found && !end->by_joints)) continue;
    found = Unbearable{overload(arm, most, " to hold still at '" + end->name + "'"), end->by_joints};
    if (found->proved) break;
  }
  return found;
}

// Says that the motion takes longer than any may.
std::string too_slow(double duration_s) {
  return "the motion that was found takes " + std::to_string(duration_s) + " s, and none may take over " +
         std::to_string(static_cast<int>(kLongestMotion)) + " s; see the speed limits of the joints";
}

Motion costed(const Arm& arm, const MotorModel& motor, Trajectory trajectory) {
  if (const double fastest = trajectory.duration_s(); fastest > kLongestMotion)
    return failed(MotionStatus::no_path, too_slow(fastest), false);
  EnergyUse use = energy_of(arm, trajectory, motor);
  if (use.peak_load > 1.0) {
    if (const auto most = slow_down(arm, motor, trajectory))
      return failed(MotionStatus::overloaded, overload(arm, *most, ", however slowly it moves"), false);
    if (const double slowed = trajectory.duration_s(); slowed > kLongestMotion)
      return failed(MotionStatus::overloaded, too_slow(slowed), false);
    use = energy_of(arm, trajectory, motor);
  }
  const double duration = trajectory.duration_s();
  return {MotionStatus::found, {}, std::move(trajectory), duration, use.energy_j};
}

}  // namespace

MotionModel::MotionModel(ArmSetup setup)
    : setup_(std::make_shared<const ArmSetup>(std::move(setup))),
      checker_(setup_->arm, setup_->collision),
      close_checker_(setup_->arm, with_close_margin(setup_->collision)),
      version_(model_version(*setup_)),
      places_(setup_) {}

Motion MotionModel::motion(const Place& from, const Place& to, const std::function<bool()>& cancelled) const {
  return plan({from, to}, cancelled);
}

Motion MotionModel::plan(const MotionQuery& query, const std::function<bool()>& cancelled) const {
  return plan(resolve(query.from, query.effort), resolve(query.to, query.effort), query.payload, query.effort,
              cancelled);
}

Motion MotionModel::plan(const ResolvedPlace& from, const ResolvedPlace& to, const Payload& payload,
                         unsigned effort, const std::function<bool()>& cancelled) const {
  if (const ResolvedPlace* end = unusable(from, to)) return failed(end->status, end->detail, end->proved);
  if (auto fault = fault_of(payload); !fault.empty()) return failed(MotionStatus::faulty, fault, false);
  if (payload.none() && !has_modules())
    return between(setup_->arm, checker_, close_checker_, from, to, effort, cancelled);

  const Arm arm = loaded(setup_->arm, payload, setup_->tool_axis);
  std::vector<CollisionShape> all, standing;
  for (const Module& module : places_.modules()) all.push_back(module.shape);
  const CollisionChecker among_all(arm, with_close_margin(setup_->collision), all);
  std::set<std::size_t> away;  // what the arm touches where it stands cannot be there
  for (const ResolvedPlace* end : {&from, &to}) {
    if (!end->by_joints) continue;
    for (const std::size_t i : among_all.obstacles_touched(end->joints)) away.insert(i);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string& pose = places_.modules()[i].pose;
    if (pose != from.name && pose != to.name && !away.contains(i)) standing.push_back(all[i]);
  }
  const CollisionChecker full(arm, setup_->collision, standing);
  const CollisionChecker close(arm, with_close_margin(setup_->collision), standing);
  for (const ResolvedPlace* end : {&from, &to}) {
    const auto contact = close.contact(end->joints);
    if (!contact) continue;
    const bool proved = end->by_joints && !contact->second.starts_with("module at ");
    return failed(MotionStatus::in_collision, touching("'" + end->name + "'", *contact), proved);
  }
  return between(arm, full, close, from, to, effort, cancelled);
}

Motion MotionModel::between(const Arm& arm, const CollisionChecker& full, const CollisionChecker& close,
                            const ResolvedPlace& from, const ResolvedPlace& to, unsigned effort,
                            const std::function<bool()>& cancelled) const {
  if (const auto reason = unbearable(arm, setup_->motor, from, to))
    return failed(MotionStatus::overloaded, reason->detail, reason->proved);
  const bool roomy = !full.contact(from.joints) && !full.contact(to.joints);
  const CollisionChecker& checker = roomy ? full : close;
  const unsigned iterations = setup_->search_iterations * std::min(effort, kMostEffort);
  const auto found = find_path(arm, checker, from.joints, to.joints, {iterations, cancelled});
  if (const auto* failure = std::get_if<SearchFailure>(&found)) {
    if (*failure == SearchFailure::cancelled) return failed(MotionStatus::cancelled, "cancelled", false);
    return failed(MotionStatus::no_path,
                  "no path within " + std::to_string(iterations) + " search iterations", false);
  }
  const JointPath path = shortened(arm, checker, std::get<JointPath>(found), setup_->shortcut_trials,
                                   query_seed(from.joints, to.joints));
  return costed(arm, setup_->motor, time_path(arm, path));
}

MotionBound MotionModel::bound(const ResolvedPlace& from, const ResolvedPlace& to,
                               const Payload& payload) const {
  if (const ResolvedPlace* end = unusable(from, to)) return {end->status, end->detail, end->proved};
  if (auto fault = fault_of(payload); !fault.empty()) return {MotionStatus::faulty, fault};
  const Arm arm = loaded(setup_->arm, payload, setup_->tool_axis);
  if (const auto reason = unbearable(arm, setup_->motor, from, to); reason && reason->proved)
    return {MotionStatus::overloaded, reason->detail, true};
  return {MotionStatus::found,
          {},
          false,
          duration_bound_s(arm, from.joints, to.joints),
          energy_bound_j(arm, from.joints, to.joints, setup_->motor)};
}

}  // namespace roci::arm
