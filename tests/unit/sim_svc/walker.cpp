#include "tests/unit/sim_svc/walker.hpp"

#include <map>

namespace roci::sim {

using temporal::seconds;
using temporal::Time;

namespace {

kinematics::Joint joint(const std::string& name, kinematics::JointType type, double ahead,
                        const Eigen::Vector3d& axis, double effort, double friction) {
  kinematics::Joint out;
  out.name = name;
  out.type = type;
  out.origin.translation() = Eigen::Vector3d(ahead, 0, 0);
  out.axis = axis;
  out.limits = {-5, 5, 0.4, 0.2, effort};
  out.friction = friction;
  out.damping = friction;
  return out;
}

kinematics::Body body(const std::string& name, double mass, double ahead) {
  kinematics::Body out;
  out.name = name;
  out.mass.mass = mass;
  out.mass.centre = Eigen::Vector3d(ahead, 0, 0);
  out.mass.inertia = mass * 0.05 * Eigen::Matrix3d::Identity();
  return out;
}

}  // namespace

std::shared_ptr<const kinematics::Arm> rail_arm() {
  using kinematics::JointType;
  kinematics::Arm out;
  out.name = "rail_arm";
  out.joints = {joint("rail", JointType::prismatic, 0, Eigen::Vector3d::UnitY(), 200, 4),
                joint("shoulder", JointType::revolute, 0.2, Eigen::Vector3d::UnitZ(), 120, 2),
                joint("elbow", JointType::revolute, 1, Eigen::Vector3d::UnitZ(), 80, 1),
                joint("wrist", JointType::revolute, 1, Eigen::Vector3d::UnitY(), 40, 0.5)};
  out.bodies = {body("base", 0, 0), body("carriage", 40, 0), body("upper", 8, 0.5), body("fore", 6, 0.5),
                body("hand", 3, 0.1)};
  out.tool.translation() = Eigen::Vector3d(0.2, 0, 0);
  return std::make_shared<const kinematics::Arm>(std::move(out));
}

std::vector<double> joints_at(const std::string& pose) {
  static const std::map<std::string, std::vector<double>> poses{{"home", {0, 0, 0, 0}},
                                                                {"s0", {0.3, 0.2, 0.8, 0.1}},
                                                                {"s1", {0.6, -0.3, 1.0, 0.1}},
                                                                {"s2", {1.2, 0.4, 0.2, -0.2}},
                                                                {"s3", {1.5, -0.2, 0.5, 0.2}}};
  return poses.at(pose);
}

Walker::Walker() {
  arm.common.start_pose = "home";
  arm.common.start_joints = joints_at("home");
  arm.drive.arm = rail_arm();
  arm.drive.friction_noise = 0;
  arm.wear = {kinematics::JointVector::Zero(4), kinematics::JointVector::Zero(4)};
  for (const char* slot : {"s0", "s1", "s2", "s3"}) grapple.slots[slot] = {slot};
  grapple.modules["m0"] = {"s0", 80, 80, {0.5, 0.5, 0.5}};
  grapple.modules["m1"] = {"s1", 80, 80, {0.5, 0.5, 0.5}};
  grapple.duration_noise = 0;
  power.idle_w = 10;
}

world::WorldSetup Walker::build() const {
  return {{},
          {{"sun.window", {{seconds(0), seconds(1000)}, {seconds(2000), seconds(3000)}}}},
          {{"walker",
            {},
            world::PowerSetup{power, battery_j},
            {},
            {part<components::DynamicArm>("arm", "dynamic_arm", arm),
             part<components::Grapple>("grapple", "grapple", grapple)}}}};
}

WalkerFlight::WalkerFlight(const Walker& walker, std::uint64_t seed) : Flight(walker.build(), seed) {
  joints = joints_at("home");
}

double WalkerFlight::move(const std::string& from, const std::string& to, double course_s) {
  const std::string activity = "move" + std::to_string(++count_);
  const Time begun = now = now + seconds(1);
  move_arm(now, activity, from, to, joints_at(to), course_s);
  for (int i = 0; i < 2000 && stage(activity) == services::owner::Stage::accepted; ++i)
    advance(now += seconds(1));
  return temporal::to_seconds(time_of(activity) - begun);
}

void WalkerFlight::work(Time at, const std::string& activity, const std::string& name,
                        const std::string& slot, const std::string& module, double latest_s) {
  now = at;
  auto request = execute(activity, "grapple", name, {{"slot", slot}});
  if (!module.empty()) request.arguments["module"] = module;
  if (latest_s > 0) request.latest_end = seconds(latest_s);
  command(now, request);
}

std::string WalkerFlight::done(const std::string& name, const std::string& slot, const std::string& module) {
  const std::string activity = name + std::to_string(++count_);
  work(now + seconds(1), activity, name, slot, module);
  advance(now += seconds(200));
  return code(activity);
}

}  // namespace roci::sim
