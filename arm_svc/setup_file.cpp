#include "arm_svc/setup_file.hpp"

#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include "core/kinematics/urdf.hpp"
#include "core/mission/entry.hpp"

namespace roci::arm {
namespace {

using kinematics::JointVector;
using mission::Entry;

constexpr double kLongestEdge = 100;  // m

double bounded(const Entry& entry, double low, double high) {
  const double value = entry.number();
  if (value >= low && value <= high) return value;
  std::ostringstream message;
  message << "must be between " << low << " and " << high;
  entry.fail(message.str());
}

double bounded_or(const Entry& map, const char* key, double low, double high, double fallback) {
  const auto entry = map.find(key);
  return entry ? bounded(*entry, low, high) : fallback;
}

std::vector<double> numbers(const Entry& entry, std::size_t count, const std::string& what) {
  std::vector<double> values;
  for (const Entry& item : entry.items()) values.push_back(item.number());
  if (values.size() != count) {
    entry.fail("gives " + std::to_string(values.size()) + " numbers; " + what + " has " +
               std::to_string(count));
  }
  return values;
}

Eigen::Vector3d vector3(const Entry& entry) {
  const std::vector<double> values = numbers(entry, 3, "a vector");
  return {values[0], values[1], values[2]};
}

Eigen::Vector3d direction(const Entry& entry) {
  const Eigen::Vector3d vector = vector3(entry);
  if (!(vector.norm() > 1e-9)) entry.fail("a direction must not be zero; give one such as [0, 0, -1]");
  return vector.stableNormalized();
}

JointVector joints(const Entry& entry, std::size_t count) {
  const std::vector<double> values = numbers(entry, count, "the arm");
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(count));
}

Eigen::Quaterniond rotation(const Eigen::Vector3d& rpy) {
  return Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX());
}

ToolTarget target(const Entry& place, const Eigen::Vector3d& tool_axis) {
  ToolTarget target;
  target.position = vector3(place.at("position"));
  const auto approach = place.find("approach"), rpy = place.find("rpy");
  if (approach && rpy) rpy->fail("the pose gives both approach and rpy; choose one");
  if (approach) target.approach = Approach{tool_axis, direction(*approach)};
  if (rpy) target.orientation = rotation(vector3(*rpy));
  return target;
}

std::optional<Eigen::Vector3d> module_size(const Entry& pose) {
  const auto entry = pose.find("module");
  if (!entry) return std::nullopt;
  if (!pose.find("approach") && !pose.find("rpy"))
    entry->fail(
        "a module needs a pose with a position and an approach or rpy, from where the tool grasps it");
  const Eigen::Vector3d size = vector3(*entry);
  if (!(size.array() > 0).all() || !(size.array() < kLongestEdge).all())
    entry->fail("the edges of a module must be above 0 and below 100 m");
  return size;
}

std::vector<NamedPose> poses(const Entry& entry, std::size_t joint_count, const Eigen::Vector3d& tool_axis) {
  std::vector<NamedPose> poses;
  std::set<std::string> names;
  for (const auto& [name, place] : entry.fields()) {
    if (!names.insert(name).second) place.fail("pose '" + name + "' stands twice; give it another name");
    place.allow_only({"joints", "position", "approach", "rpy", "module"});
    const auto values = place.find("joints");
    if (values.has_value() == place.find("position").has_value()) {
      place.fail("pose '" + name + "' needs either joints or a position");
    }
    if (values) {
      poses.push_back({name, joints(*values, joint_count)});
    } else {
      poses.push_back({name, target(place, tool_axis)});
    }
    poses.back().module_size = module_size(place);
    const std::string where = place.place();
    poses.back().source = where.substr(where.rfind('/') + 1);
  }
  return poses;
}

CollisionRules collision(const Entry& root) {
  CollisionRules rules;
  if (const auto ground = root.find("ground")) rules.ground_z = bounded(*ground, -100, 100);
  rules.margin = bounded_or(root, "margin", 0.001, 0.1, rules.margin);
  if (const auto pairs = root.find("may_touch")) {
    for (const Entry& pair : pairs->items()) {
      const std::vector<std::string> links = pair.texts();
      if (links.size() != 2) pair.fail("expected a pair of links such as [forearm, scoop]");
      rules.may_touch.emplace_back(links[0], links[1]);
    }
  }
  return rules;
}

MotorModel motor(const Entry& root) {
  MotorModel motor;
  const auto entry = root.find("motor");
  if (!entry) return motor;
  entry->allow_only({"gravity", "idle", "efficiency", "full_effort_loss"});
  if (const auto gravity = entry->find("gravity")) motor.gravity = vector3(*gravity);
  motor.idle_w = bounded_or(*entry, "idle", 0, 1e6, motor.idle_w);
  motor.efficiency = bounded_or(*entry, "efficiency", 0.01, 1, motor.efficiency);
  motor.full_effort_loss_w = bounded_or(*entry, "full_effort_loss", 0, 1e6, motor.full_effort_loss_w);
  return motor;
}

kinematics::Arm arm(const std::filesystem::path& urdf, const Entry& root) {
  std::ifstream file(urdf, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw mission::FileError(urdf.string() + ": cannot be read; check that the file exists");
  kinematics::UrdfOptions options{root.at("tip").text()};
  options.time_to_speed_s = bounded_or(root, "time_to_speed", 0.001, 1000, options.time_to_speed_s);
  if (const auto time = root.find("time_to_acceleration"))
    options.time_to_acceleration_s = bounded(*time, 0.001, 1000);
  auto result = kinematics::parse_urdf(text.str(), urdf.string(), options);
  if (const auto* error = std::get_if<kinematics::UrdfError>(&result))
    throw mission::FileError(to_string(*error));
  return std::get<kinematics::Arm>(std::move(result));
}

}  // namespace

ArmSetup load_setup(const std::filesystem::path& urdf, const std::filesystem::path& poses_file) {
  const Entry root = Entry::load(poses_file);
  root.allow_only({"tip", "tool_axis", "time_to_speed", "time_to_acceleration", "ground", "margin",
                   "may_touch", "motor", "search", "poses"});
  ArmSetup setup;
  setup.arm = arm(urdf, root);
  if (const auto axis = root.find("tool_axis")) setup.tool_axis = direction(*axis);
  setup.poses = poses(root.at("poses"), setup.arm.joints.size(), setup.tool_axis);
  setup.collision = collision(root);
  setup.motor = motor(root);
  if (const auto search = root.find("search")) {
    search->allow_only({"iterations", "shortcuts"});
    setup.search_iterations =
        static_cast<unsigned>(bounded_or(*search, "iterations", 1, 1e6, setup.search_iterations));
    setup.shortcut_trials = static_cast<int>(bounded_or(*search, "shortcuts", 0, 1e4, setup.shortcut_trials));
  }
  return setup;
}

}  // namespace roci::arm
