#include "arm_svc/wire_service.hpp"

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace roci::arm {
namespace {

using kinematics::JointVector;
namespace wire = services::wire;
using Objects = std::span<const v1::PlanObject* const>;

constexpr double kSamplePeriod = 0.1;  // s

JointVector joints_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// Says why an object is no place of this arm, or no payload.
struct Misread {
  std::string object;
  std::string why;
};

std::variant<Place, Misread> place_of(const v1::PlanObject& object, std::size_t joints) {
  Place place{object.name()};
  if (wire::property(object, "q0") != nullptr) {
    const Misread misread{object.name(), "gives joint values that are not " + std::to_string(joints) +
                                             " finite numbers q0, q1, …"};
    std::vector<double> values;
    for (std::size_t i = 0; i < joints; ++i) {
      const auto value = wire::finite_property(object, "q" + std::to_string(i));
      if (!value) return misread;
      values.push_back(*value);
    }
    if (wire::property(object, "q" + std::to_string(joints)) != nullptr) return misread;
    place.joints = joints_of(values);
    return place;
  }
  const auto x = wire::finite_property(object, "x"), y = wire::finite_property(object, "y"),
             z = wire::finite_property(object, "z");
  if (x && y && z) place.position = Eigen::Vector3d(*x, *y, *z);
  return place;
}

std::variant<Place, Misread> place_of(const PlaceTerm& term, Objects objects, std::size_t joints) {
  if (const auto* pose = std::get_if<std::string>(&term)) return Place{*pose};
  return place_of(*objects[std::get<std::size_t>(term)], joints);
}

std::variant<double, Misread> number_of(const NumberTerm& term, Objects objects) {
  if (const auto* number = std::get_if<double>(&term)) return *number;
  const auto& [argument, key] = std::get<ArgumentProperty>(term);
  const auto value = wire::finite_property(*objects[argument], key);
  if (!value)
    return Misread{objects[argument]->name(), "has no property " + key + " that is a finite number"};
  if (*value < 0) return Misread{objects[argument]->name(), "has a property " + key + " below 0"};
  return *value;
}

std::variant<Payload, Misread> payload_of(const std::optional<PayloadTerm>& term, Objects objects) {
  Payload payload;
  if (!term) return payload;
  const auto mass = number_of(term->mass_kg, objects);
  if (const auto* misread = std::get_if<Misread>(&mass)) return *misread;
  payload.mass_kg = std::get<double>(mass);
  for (Eigen::Index i = 0; term->size_m && i < 3; ++i) {
    const auto edge = number_of((*term->size_m)[static_cast<std::size_t>(i)], objects);
    if (const auto* misread = std::get_if<Misread>(&edge)) return *misread;
    payload.size_m[i] = std::get<double>(edge);
  }
  return payload;
}

std::variant<PlacePair, Misread> motion_of(const ArmFunction& function, Objects objects, std::size_t joints) {
  auto from = place_of(function.from, objects, joints);
  if (const auto* misread = std::get_if<Misread>(&from)) return *misread;
  auto to = place_of(function.to, objects, joints);
  if (const auto* misread = std::get_if<Misread>(&to)) return *misread;
  auto payload = payload_of(function.payload, objects);
  if (const auto* misread = std::get_if<Misread>(&payload)) return *misread;
  return PlacePair{std::get<Place>(std::move(from)), std::get<Place>(std::move(to)),
                   std::get<Payload>(payload)};
}

v1::FunctionOutcome function_outcome(MotionStatus status, bool proved) {
  if (proved) return v1::FUNCTION_UNREACHABLE;
  switch (status) {
    case MotionStatus::found:
      return v1::FUNCTION_VALUE;
    case MotionStatus::unknown_pose:
    case MotionStatus::faulty:
      return v1::FUNCTION_UNKNOWN_OBJECT;
    case MotionStatus::cancelled:
      return v1::FUNCTION_FAILED;
    case MotionStatus::unreachable:
    case MotionStatus::unsolved:
    case MotionStatus::in_collision:
    case MotionStatus::no_path:
    case MotionStatus::overloaded:
      return v1::FUNCTION_UNKNOWN;
  }
  return v1::FUNCTION_FAILED;
}

v1::MotionOutcome motion_outcome(MotionStatus status, bool proved) {
  if (status == MotionStatus::found) return v1::MOTION_FOUND;
  if (status == MotionStatus::unknown_pose || status == MotionStatus::cancelled ||
      status == MotionStatus::faulty)
    return v1::MOTION_INVALID;
  return proved ? v1::MOTION_UNREACHABLE : v1::MOTION_UNKNOWN;
}

v1::JointState joint_state(double time_s, const JointVector& position) {
  v1::JointState state;
  state.time_s(time_s);
  state.positions({position.data(), position.data() + position.size()});
  return state;
}

// Answers the tuples of one request.
class Answering {
 public:
  Answering(EstimateCache& cache, const MotionModel& model, const ArmModule& module,
            const std::stop_token& stop)
      : cache_(cache), model_(model), module_(module), stop_(stop) {}

  wire::FunctionResult operator()(const wire::OwnedFunction& owned, Objects objects,
                                  v1::FunctionAccuracy accuracy) {
    const ArmFunction& function = *std::ranges::find(module_.functions, owned.name, &ArmFunction::name);
    const auto asked = motion_of(function, objects, model_.setup().arm.joints.size());
    if (const auto* misread = std::get_if<Misread>(&asked)) {
      refusals.insert("'" + misread->object + "' " + misread->why);
      words[misread->object] = "it " + misread->why;
      return {v1::FUNCTION_UNKNOWN_OBJECT};
    }
    const auto& pair = std::get<PlacePair>(asked);
    const Estimate found =
        accuracy == v1::ACCURACY_LOWER_BOUND
            ? cache_.bound(model_, pair)
            : cache_.estimate(model_, {&pair, 1}, [this] { return stop_.stop_requested(); }).front();
    if (found.status == MotionStatus::found)
      return {v1::FUNCTION_VALUE, function.gives == Quantity::duration ? found.duration_s : found.energy_j};
    refusals.insert(pair.from.name + " to " + pair.to.name + ": " + found.detail);
    for (const Place* end : {&pair.from, &pair.to}) {
      if (cache_.resolve(model_, *end).status != MotionStatus::found) words[end->name] = found.detail;
    }
    return {function_outcome(found.status, found.proved)};
  }

  std::set<std::string> refusals;
  std::map<std::string, std::string> words;  // by object

 private:
  EstimateCache& cache_;
  const MotionModel& model_;
  const ArmModule& module_;
  const std::stop_token& stop_;
};

}  // namespace

std::vector<wire::OwnedFunction> owned_functions(const ArmModule& module) {
  std::vector<wire::OwnedFunction> functions;
  for (const ArmFunction& function : module.functions) {
    functions.push_back({function.name,
                         function.parameters,
                         function.gives == Quantity::duration ? "s" : "J",
                         {v1::ACCURACY_EXACT, v1::ACCURACY_LOWER_BOUND}});
  }
  return functions;
}

v1::FunctionOffer function_offer(const ArmModule& module, const std::string& owner,
                                 std::uint64_t model_version) {
  return wire::function_offer(module.name, owner, model_version, owned_functions(module));
}

FunctionAnswer evaluate(EstimateCache& cache, const MotionModel& model, const ArmModule& module,
                        const v1::FunctionRequest& request, const std::stop_token& stop) {
  cache.begin_request();
  Answering answering(cache, model, module, stop);
  FunctionAnswer answer;
  answer.reply = wire::answer_batches(
      request, model.version(), owned_functions(module),
      [&](const wire::OwnedFunction& function, Objects objects, v1::FunctionAccuracy accuracy) {
        return answering(function, objects, accuracy);
      },
      stop);
  wire::put_words(answer.reply, answering.words);
  answer.refusals = std::move(answering.refusals);
  return answer;
}

v1::ArmMotionReply find_motion(const MotionModel& model, const v1::ArmMotionRequest& request,
                               const std::stop_token& stop) {
  Place from{request.from_pose()};
  // More values than any arm has joints would not fit a joint vector; no arm takes them anyway.
  const std::size_t given = request.from_positions().size();
  const bool sized = given <= kinematics::kMaxJoints;
  if (given > 0) from.joints = sized ? joints_of(request.from_positions()) : JointVector();
  Payload payload{request.payload_kg(), Eigen::Vector3d::Zero()};
  const std::vector<double>& size = request.payload_size_m();
  if (size.size() == 3) payload.size_m = Eigen::Vector3d(size[0], size[1], size[2]);
  if (!size.empty() && size.size() != 3) payload.size_m.setConstant(-1);  // refused as no size
  const Motion motion = model.plan({from, {request.to_pose()}, payload, kMostEffort},
                                   [&stop] { return stop.stop_requested(); });
  v1::ArmMotionReply reply;
  reply.outcome(motion_outcome(motion.status, motion.proved));
  reply.reason(motion.detail);
  reply.model_version(model.version());
  reply.expected_s(motion.duration_s);
  reply.expected_j(motion.energy_j);
  for (const TrajectorySample& sample : sampled(motion.trajectory, kSamplePeriod)) {
    reply.trajectory().push_back(joint_state(sample.time_s, sample.position));
  }
  if (motion.status == MotionStatus::found && reply.trajectory().empty()) {
    reply.trajectory().push_back(joint_state(0.0, model.resolve(from, kMostEffort).joints));
  }
  return reply;
}

}  // namespace roci::arm
