#include "arm_svc/setup_file.hpp"

#include <set>

#include "arm_svc/yaml_reader.hpp"
#include "core/kinematics/urdf.hpp"

namespace roci::arm {
namespace {

using kinematics::JointVector;

ToolTarget target_of(const YAML::Node& node, const std::string& what, const Eigen::Vector3d& tool_axis) {
  ToolTarget target;
  target.position = yaml::vector3(node["position"], "the position of " + what);
  if (node["approach"] && node["rpy"]) {
    throw yaml::Failure{node.Mark(), what + " gives both approach and rpy; choose one"};
  }
  if (node["approach"]) {
    target.approach = Approach{tool_axis, yaml::direction(node["approach"], "the approach of " + what)};
  }
  if (node["rpy"]) {
    const Eigen::Vector3d rpy = yaml::vector3(node["rpy"], "the rpy of " + what);
    target.orientation = Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
                         Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
                         Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX());
  }
  return target;
}

JointVector joints_of(const YAML::Node& node, const std::string& what, std::size_t joints) {
  const std::vector<double> values = yaml::numbers(node, "the joints of " + what);
  if (values.size() != joints) {
    throw yaml::Failure{node.Mark(), what + " gives " + std::to_string(values.size()) +
                                         " joint values; the arm has " + std::to_string(joints) + " joints"};
  }
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(joints));
}

std::vector<NamedPose> poses_of(const YAML::Node& node, std::size_t joints,
                                const Eigen::Vector3d& tool_axis) {
  if (!node.IsMap()) throw yaml::Failure{node.Mark(), "poses must be a map from names to places"};
  std::vector<NamedPose> poses;
  std::set<std::string> names;
  for (const auto& entry : node) {
    const std::string name = yaml::text(entry.first, "a pose's name"), what = "pose '" + name + "'";
    const YAML::Node& place = entry.second;
    if (!names.insert(name).second) throw yaml::Failure{entry.first.Mark(), what + " stands twice"};
    yaml::require_map(place, what, {"joints", "position", "approach", "rpy"});
    if (place["joints"] && place.size() == 1) {
      poses.push_back({name, joints_of(place["joints"], what, joints)});
    } else if (place["position"] && !place["joints"]) {
      poses.push_back({name, target_of(place, what, tool_axis)});
    } else {
      throw yaml::Failure{place.Mark(), what + " needs either joints or a position"};
    }
  }
  return poses;
}

CollisionRules collision_of(const YAML::Node& root) {
  CollisionRules rules;
  if (root["ground"]) rules.ground_z = yaml::number(root["ground"], "ground", -100, 100);
  if (root["margin"]) rules.margin = yaml::number(root["margin"], "margin", 0.001, 0.1);
  if (const YAML::Node pairs = root["may_touch"]) {
    if (!pairs.IsSequence()) throw yaml::Failure{pairs.Mark(), "may_touch must be a list of pairs of links"};
    for (const auto& pair : pairs) {
      if (!pair.IsSequence() || pair.size() != 2) {
        throw yaml::Failure{pair.Mark(), "each entry of may_touch must be a pair of links"};
      }
      rules.may_touch.emplace_back(yaml::text(pair[0], "a link"), yaml::text(pair[1], "a link"));
    }
  }
  return rules;
}

MotorModel motor_of(const YAML::Node& node) {
  MotorModel motor;
  if (!node) return motor;
  yaml::require_map(node, "motor", {"gravity", "idle", "efficiency", "full_effort_loss"});
  if (node["gravity"]) motor.gravity = yaml::vector3(node["gravity"], "gravity");
  if (node["idle"]) motor.idle_w = yaml::number(node["idle"], "idle", 0, 1e6);
  if (node["efficiency"]) motor.efficiency = yaml::number(node["efficiency"], "efficiency", 0.01, 1);
  if (const YAML::Node loss = node["full_effort_loss"]) {
    motor.full_effort_loss_w = yaml::number(loss, "full_effort_loss", 0, 1e6);
  }
  return motor;
}

void read_search(const YAML::Node& node, ArmSetup& setup) {
  if (!node) return;
  yaml::require_map(node, "search", {"iterations", "shortcuts"});
  if (const YAML::Node n = node["iterations"]) {
    setup.search_iterations = static_cast<unsigned>(yaml::number(n, "iterations", 1, 1e6));
  }
  if (const YAML::Node n = node["shortcuts"]) {
    setup.shortcut_trials = static_cast<int>(yaml::number(n, "shortcuts", 0, 1e4));
  }
}

std::variant<ArmSetup, SetupError> read(const ArmFiles& files) {
  const YAML::Node root = YAML::Load(files.poses_text);
  yaml::require_map(
      root, "the file",
      {"tip", "tool_axis", "time_to_speed", "ground", "margin", "may_touch", "motor", "search", "poses"});
  for (const char* key : {"tip", "poses"}) {
    if (!root[key]) throw yaml::Failure{root.Mark(), std::string("the file needs the key '") + key + "'"};
  }
  kinematics::UrdfOptions options{yaml::text(root["tip"], "tip")};
  if (const YAML::Node time = root["time_to_speed"]) {
    options.time_to_speed_s = yaml::number(time, "time_to_speed", 0.001, 1000);
  }
  auto arm = kinematics::parse_urdf(files.urdf_text, files.urdf_name, options);
  if (const auto* error = std::get_if<kinematics::UrdfError>(&arm)) return SetupError{to_string(*error)};

  ArmSetup setup;
  setup.arm = std::get<kinematics::Arm>(std::move(arm));
  const YAML::Node axis = root["tool_axis"];
  const Eigen::Vector3d tool_axis = axis ? yaml::direction(axis, "tool_axis") : Eigen::Vector3d::UnitX();
  setup.poses = poses_of(root["poses"], setup.arm.joints.size(), tool_axis);
  setup.collision = collision_of(root);
  setup.motor = motor_of(root["motor"]);
  read_search(root["search"], setup);
  return setup;
}

SetupError error_at(const std::string& file, const YAML::Mark& mark, const std::string& message) {
  if (mark.is_null()) return {file + ": " + message};
  return {file + ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1) + ": " +
          message};
}

}  // namespace

std::variant<ArmSetup, SetupError> parse_setup(const ArmFiles& files) {
  try {
    return read(files);
  } catch (const yaml::Failure& failure) {
    return error_at(files.poses_name, failure.mark, failure.message);
  } catch (const YAML::Exception& error) {
    return error_at(files.poses_name, error.mark, error.msg);
  }
}

}  // namespace roci::arm
