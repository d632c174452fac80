#include "arm_svc/wire_service.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace roci::arm {
namespace {

using kinematics::JointVector;

constexpr double kSamplePeriod = 0.1;  // s

v1::FunctionSignature signature(const std::string& name, const std::string& unit) {
  v1::FunctionSignature function;
  function.name(name);
  function.parameter_types({"pose", "pose"});
  function.unit(unit);
  return function;
}

const std::string* find(const v1::PlanObject& object, const std::string& property) {
  for (const v1::Property& entry : object.properties()) {
    if (entry.name() == property) return &entry.value();
  }
  return nullptr;
}

std::optional<double> finite_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

JointVector joints_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// Empty: not a place of this arm.
std::optional<Place> place_of(const v1::FunctionRequest& request, std::uint32_t index, std::size_t joints) {
  if (index >= request.objects().size()) return std::nullopt;
  const v1::PlanObject& object = request.objects()[index];
  if (find(object, "q0") == nullptr) return Place{object.name()};
  std::vector<double> values;
  for (std::size_t i = 0; i < joints; ++i) {
    const std::string* text = find(object, "q" + std::to_string(i));
    const auto value = text == nullptr ? std::nullopt : finite_number(*text);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  if (find(object, "q" + std::to_string(joints)) != nullptr) return std::nullopt;
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

class Evaluation {
 public:
  Evaluation(EstimateCache& cache, const MotionModel& model, const v1::FunctionRequest& request,
             const std::stop_token& stop)
      : cache_(cache), model_(model), request_(request), stop_(stop) {}

  v1::FunctionValues batch(const v1::FunctionBatch& batch) {
    const bool time = batch.function() == "arm_move_time";
    const bool known = time || batch.function() == "arm_move_energy";
    const std::vector<std::uint32_t>& tuples = batch.tuples();
    const std::size_t arity = std::max<std::size_t>(batch.arity(), 1);
    v1::FunctionValues values;
    values.function(batch.function());
    for (std::size_t i = 0; i < tuples.size(); i += arity) {
      Estimate estimate;
      v1::FunctionOutcome outcome = v1::FUNCTION_UNKNOWN_FUNCTION;
      if (known) {
        const bool pair = batch.arity() == 2 && i + 1 < tuples.size();
        outcome = pair ? tuple(tuples[i], tuples[i + 1], estimate) : v1::FUNCTION_WRONG_ARITY;
      }
      const double value = time ? estimate.duration_s : estimate.energy_j;
      values.numbers().push_back(outcome == v1::FUNCTION_VALUE ? value : 0.0);
      values.outcomes().push_back(outcome);
    }
    return values;
  }

  std::set<std::string> take_refusals() { return std::move(refusals_); }

 private:
  v1::FunctionOutcome tuple(std::uint32_t from_object, std::uint32_t to_object, Estimate& estimate) {
    const std::size_t joints = model_.setup().arm.joints.size();
    const auto from = place_of(request_, from_object, joints), to = place_of(request_, to_object, joints);
    if (!from || !to) {
      refusals_.insert("a place gives joint values that are not " + std::to_string(joints) +
                       " finite numbers q0, q1, …");
      return v1::FUNCTION_UNKNOWN_OBJECT;
    }
    const PlacePair pair{*from, *to};
    estimate = cache_.estimate(model_, {&pair, 1}, [this] { return stop_.stop_requested(); }).front();
    if (estimate.status != MotionStatus::found) {
      refusals_.insert(from->name + " to " + to->name + ": " + estimate.detail);
    }
    return function_outcome(estimate.status);
  }

  EstimateCache& cache_;
  const MotionModel& model_;
  const v1::FunctionRequest& request_;
  const std::stop_token& stop_;
  std::set<std::string> refusals_;
};

v1::JointState joint_state(double time_s, const JointVector& position) {
  v1::JointState state;
  state.time_s(time_s);
  state.positions({position.data(), position.data() + position.size()});
  return state;
}

}  // namespace

v1::FunctionOffer function_offer(const std::string& owner, std::uint64_t model_version) {
  v1::FunctionOffer offer;
  offer.module_name(kModule);
  offer.owner(owner);
  offer.model_version(model_version);
  offer.functions({signature("arm_move_time", "s"), signature("arm_move_energy", "J")});
  return offer;
}

FunctionAnswer evaluate(EstimateCache& cache, const MotionModel& model, const v1::FunctionRequest& request,
                        const std::stop_token& stop) {
  FunctionAnswer answer;
  Evaluation evaluation(cache, model, request, stop);
  for (const v1::FunctionBatch& batch : request.batches()) {
    answer.reply.results().push_back(evaluation.batch(batch));
  }
  answer.reply.model_version(model.version());
  answer.refusals = evaluation.take_refusals();
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
