#include "arm_svc/wire_service.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "services/wire/function_wire.hpp"

namespace roci::arm {
namespace {

using kinematics::JointVector;
namespace wire = services::wire;

constexpr double kSamplePeriod = 0.1;  // s

constexpr const char* kTime = "arm_move_time";
constexpr const char* kEnergy = "arm_move_energy";

const std::vector<wire::OwnedFunction> kFunctions{{kTime, {"pose", "pose"}, "s"},
                                                  {kEnergy, {"pose", "pose"}, "J"}};

JointVector joints_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// Returns nothing for what is not a place of this arm.
std::optional<Place> place_of(const v1::PlanObject& object, std::size_t joints) {
  if (wire::property(object, "q0") == nullptr) return Place{object.name()};
  std::vector<double> values;
  for (std::size_t i = 0; i < joints; ++i) {
    const auto value = wire::finite_property(object, "q" + std::to_string(i));
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  if (wire::property(object, "q" + std::to_string(joints)) != nullptr) return std::nullopt;
  return Place{object.name(), joints_of(values)};
}

v1::FunctionOutcome function_outcome(MotionStatus status) {
  switch (status) {
    case MotionStatus::found:
      return v1::FUNCTION_VALUE;
    case MotionStatus::unknown_pose:
      return v1::FUNCTION_UNKNOWN_OBJECT;
    case MotionStatus::cancelled:
      return v1::FUNCTION_FAILED;
    case MotionStatus::unreachable:
    case MotionStatus::in_collision:
    case MotionStatus::no_path:
    case MotionStatus::overloaded:
      return v1::FUNCTION_UNREACHABLE;
  }
  return v1::FUNCTION_FAILED;
}

v1::MotionOutcome motion_outcome(MotionStatus status) {
  if (status == MotionStatus::found) return v1::MOTION_FOUND;
  const bool not_understood = status == MotionStatus::unknown_pose || status == MotionStatus::cancelled;
  return not_understood ? v1::MOTION_INVALID : v1::MOTION_UNREACHABLE;
}

v1::JointState joint_state(double time_s, const JointVector& position) {
  v1::JointState state;
  state.time_s(time_s);
  state.positions({position.data(), position.data() + position.size()});
  return state;
}

}  // namespace

v1::FunctionOffer function_offer(const std::string& owner, std::uint64_t model_version) {
  return wire::function_offer(kModule, owner, model_version, kFunctions);
}

FunctionAnswer evaluate(EstimateCache& cache, const MotionModel& model, const v1::FunctionRequest& request,
                        const std::stop_token& stop) {
  FunctionAnswer answer;
  const std::size_t joints = model.setup().arm.joints.size();
  const auto estimate = [&](const wire::OwnedFunction& function,
                            std::span<const v1::PlanObject* const> objects,
                            v1::FunctionAccuracy) -> wire::FunctionResult {
    const auto from = place_of(*objects[0], joints), to = place_of(*objects[1], joints);
    if (!from || !to) {
      answer.refusals.insert("a place gives joint values that are not " + std::to_string(joints) +
                             " finite numbers q0, q1, …");
      return {v1::FUNCTION_UNKNOWN_OBJECT};
    }
    const PlacePair pair{*from, *to};
    const Estimate found =
        cache.estimate(model, {&pair, 1}, [&stop] { return stop.stop_requested(); }).front();
    if (found.status != MotionStatus::found) {
      answer.refusals.insert(from->name + " to " + to->name + ": " + found.detail);
      return {function_outcome(found.status)};
    }
    return {v1::FUNCTION_VALUE, function.name == kTime ? found.duration_s : found.energy_j};
  };
  answer.reply = wire::answer_batches(request, model.version(), kFunctions, estimate, stop);
  return answer;
}

v1::ArmMotionReply find_motion(const MotionModel& model, const v1::ArmMotionRequest& request,
                               const std::stop_token& stop) {
  Place from{request.from_pose()};
  // More values than any arm has joints would not fit a joint vector; no arm takes them anyway.
  const std::size_t given = request.from_positions().size();
  const bool sized = given <= kinematics::kMaxJoints;
  if (given > 0) from.joints = sized ? joints_of(request.from_positions()) : JointVector();
  const Motion motion = model.motion(from, {request.to_pose()}, [&stop] { return stop.stop_requested(); });
  v1::ArmMotionReply reply;
  reply.outcome(motion_outcome(motion.status));
  reply.reason(motion.detail);
  reply.model_version(model.version());
  reply.expected_s(motion.duration_s);
  reply.expected_j(motion.energy_j);
  for (const TrajectorySample& sample : sampled(motion.trajectory, kSamplePeriod)) {
    reply.trajectory().push_back(joint_state(sample.time_s, sample.position));
  }
  if (motion.status == MotionStatus::found && reply.trajectory().empty()) {
    reply.trajectory().push_back(joint_state(0.0, model.resolve(from).joints));
  }
  return reply;
}

}  // namespace roci::arm
