#include "sim_svc/setup_file.hpp"

#include <algorithm>

#include "core/mission/entry.hpp"
#include "core/mission/scenario.hpp"
#include "core/terrain/map_error.hpp"
#include "core/terrain/site_file.hpp"
#include "sim_svc/robot_file.hpp"
#include "sim_svc/scenario_file.hpp"

namespace roci::sim {
namespace {

using mission::Entry;

std::shared_ptr<const terrain::Site> load_ground(const Entry& site) {
  try {
    return std::make_shared<terrain::Site>(terrain::load_site(site.resolve(site.text())));
  } catch (const terrain::MapError& error) {
    throw mission::FileError(error.what());
  }
}

// A start pose has no inverse kinematics yet: it must be given by joint coordinates.
std::vector<double> start_joints(const Entry& poses_file, const Entry& pose) {
  const Entry poses = Entry::load(poses_file.resolve(poses_file.text())).at("poses");
  const auto entry = poses.find(pose.text());
  if (entry) entry->allow_only({"joints", "position", "approach", "rpy"});
  const auto joints = entry ? entry->find("joints") : std::nullopt;
  if (!joints) {
    pose.fail("no pose '" + pose.text() + "' with joints stands in " + poses.file().string() +
              "; start at a pose that is given by joints");
  }
  std::vector<double> out;
  for (const Entry& joint : joints->items()) out.push_back(joint.number());
  return out;
}

// The predicted windows, with those of the scenario in place of the predicted ones of the same timeline.
std::vector<Window> true_windows(const Entry& mission, const std::vector<Window>& overriding) {
  std::vector<Window> out;
  if (const auto predicted = mission.find("windows")) out = read_windows(*predicted);
  for (const Window& window : overriding) {
    std::erase_if(out, [&](const Window& other) { return other.timeline == window.timeline; });
    out.push_back(window);
  }
  return out;
}

}  // namespace

RunSetup load_run(const std::filesystem::path& mission_folder, const std::string& scenario_name) {
  const Entry mission = Entry::load(mission_folder / "mission.yaml");
  const Entry scenario_file = mission::load_scenario(mission_folder, scenario_name);
  RunSetup run;
  run.scenario = read_scenario(scenario_file);
  if (const auto simulation = mission.find("simulation")) run.world.robot = read_robot(*simulation);
  if (run.scenario.slip) run.world.robot.drive.slip = *run.scenario.slip;
  if (run.scenario.image_noise) run.world.robot.camera.image_noise = *run.scenario.image_noise;
  run.world.ground = {load_ground(mission.at("site")), run.scenario.rocks};
  run.world.windows = true_windows(mission, run.scenario.windows);
  run.world.start = run.scenario.start;
  const Entry start = scenario_file.at("start");
  if (!run.world.ground.site->grid().contains(terrain::Point{run.scenario.start.x, run.scenario.start.y})) {
    start.fail("the rover would start outside the map; give x and y in metres of the map frame");
  }
  run.world.arm_pose = run.scenario.arm_pose;
  run.world.arm_joints = start_joints(mission.at("arm").at("poses"), start.at("arm"));
  run.world.battery_j = run.scenario.battery_j;
  return run;
}

}  // namespace roci::sim
