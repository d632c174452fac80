#include "sim_svc/scenario/run_file.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "core/mission/mission_file.hpp"
#include "core/mission/scenario.hpp"
#include "core/terrain/map_error.hpp"
#include "core/terrain/site_file.hpp"
#include "sim_svc/scenario/body_conditions.hpp"
#include "sim_svc/scenario/scenario_file.hpp"
#include "sim_svc/scenario/soil_file.hpp"
#include "sim_svc/scenario/surface_file.hpp"

namespace roci::sim::scenario {

using mission::Entry;
using setup::RobotEntry;
using setup::Roster;
using world::Window;

namespace {

std::shared_ptr<const terrain::Site> load_ground(const Entry& site) {
  try {
    return std::make_shared<terrain::Site>(terrain::load_site(site.resolve(site.text())));
  } catch (const terrain::MapError& error) {
    throw mission::FileError(error.what());
  }
}

// Returns the predicted windows, with those of the scenario in place of the predicted ones of the same
// timeline.
std::vector<Window> true_windows(const Entry& mission, const std::vector<Window>& overriding) {
  std::vector<Window> out;
  if (const auto predicted = mission.find("windows")) out = read_windows(*predicted);
  for (const Window& window : overriding) {
    std::erase_if(out, [&](const Window& other) { return other.timeline == window.timeline; });
    out.push_back(window);
  }
  return out;
}

constexpr temporal::Duration kLongestSunlight = temporal::Duration(10'000'000'000'000);  // 116 days

// Adds the sunlight of the robots' orbits as windows, in place of what is predicted.
void add_sunlight(const Roster& roster, const Scenario& scenario, const std::optional<Entry>& overriding,
                  std::vector<Window>& windows) {
  std::vector<Window> lights;
  for (const RobotEntry& robot : roster) {
    if (!robot.power || !robot.power->orbit) continue;
    const world::Orbit& orbit = *robot.power->orbit;
    for (const Window& window : scenario.windows)
      if (window.timeline == orbit.window && overriding)
        overriding->complain("'" + orbit.window + "' follows from the orbit of '" + robot.name +
                             "'; drop it here, or name the orbit's window otherwise");
    Window light{orbit.window, world::sunlight(orbit, std::min(scenario.duration, kLongestSunlight))};
    const auto same = std::ranges::find(lights, light.timeline, &Window::timeline);
    if (same != lights.end() && same->open != light.open)
      robot.components.front().entry.complain("another robot's orbit has other sunlight on '" + orbit.window +
                                              "'; give the orbits windows of their own (orbit: {window: …})");
    if (same == lights.end()) lights.push_back(std::move(light));
  }
  for (Window& light : lights) {
    std::erase_if(windows, [&](const Window& other) { return other.timeline == light.timeline; });
    windows.push_back(std::move(light));
  }
}

// A mishap must be able to befall one of the robot's components, which know their own joints, slots and modules.
void check_mishap(const world::ComponentMishap& mishap, const Entry& entry, const world::WorldSetup& world) {
  const auto robot = std::ranges::find(world.robots, mishap.robot, &world::RobotSetup::name);
  if (robot == world.robots.end()) return;
  std::string why = "no component of '" + mishap.robot +
                    "' has such things; drop the stimulus, or add a component that has (sim_svc/README.md)";
  for (const world::ComponentSetup& component : robot->components) {
    const auto spared = component.make(world::RandomStream(0, component.type))->spared_from(mishap.what);
    if (!spared) continue;
    if (spared->empty()) return;
    why = *spared;
  }
  entry.complain(why);
}

// A success can be hollow only of a command that the component has.
void check_hollow(const world::HollowSuccess& hollow, const Entry& entry, const world::WorldSetup& world) {
  const auto robot = std::ranges::find(world.robots, hollow.robot, &world::RobotSetup::name);
  if (robot == world.robots.end()) return;
  const auto part = std::ranges::find(robot->components, hollow.component, &world::ComponentSetup::name);
  if (part == robot->components.end()) return;
  std::vector<std::string> known;
  for (const auto& form : part->make(world::RandomStream(0, part->type))->commands())
    known.push_back(form.name);
  if (std::ranges::find(known, hollow.command) == known.end())
    entry.at("command").complain("'" + hollow.component + "' has no command '" + hollow.command +
                                 "'; known: " + setup::known_names(hollow.command, known));
}

// A component works in zones that its robot has.
void check_zones(const world::ComponentSetup& component, const Entry& entry, const RobotEntry& robot) {
  std::vector<std::string> known;
  if (robot.thermal)
    for (const world::ZoneParameters& zone : robot.thermal->zones) known.push_back(zone.name);
  const auto part = component.make ? component.make(world::RandomStream(0, component.type)) : nullptr;
  if (!part) return;
  for (const std::string& zone : part->zones())
    if (std::ranges::find(known, zone) == known.end())
      entry.complain("'" + component.name + "' works in the zone '" + zone + "', which '" + robot.name +
                     "' has not; known: " + setup::known_names(zone, known) +
                     "; name another, or add it to thermal");
}

void check_block(const world::ViewBlock& block, const Entry& entry, const world::WorldSetup& world) {
  std::vector<std::string> known;
  for (const Window& window : world.windows) known.push_back(window.timeline);
  if (std::ranges::find(known, block.window) == known.end())
    entry.at("window").complain("no window '" + block.window +
                                "'; known: " + setup::known_names(block.window, known));
}

void check_on_map(const Start& start, const std::string& robot, const world::Ground& ground) {
  if (!start.pose || !ground.site) return;
  if (ground.site->grid().contains(terrain::Point{start.pose->x, start.pose->y})) return;
  start.pose_entry->complain("the " + robot +
                             " would start outside the map; give x and y in metres of the map frame");
}

// Reads the settings of a robot's components; adds the names of those that they know.
world::RobotSetup read_robot(const RobotEntry& robot, const Start& start, const Entry& mission,
                             const setup::Registry& types, const Scenario& scenario,
                             std::set<std::string, std::less<>>& known) {
  world::RobotSetup out;
  out.name = robot.name;
  out.pose = start.pose;
  out.telemetry = robot.telemetry;
  out.thermal = robot.thermal;
  out.data_bytes = robot.data_bytes;
  if (robot.power) out.power = world::PowerSetup{*robot.power, start.battery_j.value_or(0)};
  for (const setup::ComponentEntry& component : robot.components) {
    const auto begin = start.components.find(component.name);
    setup::Settings settings(mission, component.entry,
                             begin == start.components.end() ? std::nullopt : std::optional(begin->second),
                             scenario.conditions);
    component.entry.attempt([&] {
      out.components.push_back({component.name, component.type, types.find(component.type)->read(settings)});
      settings.refuse_unknown();
    });
    known.insert(settings.known().begin(), settings.known().end());
    if (!out.components.empty() && out.components.back().name == component.name)
      check_zones(out.components.back(), component.entry, robot);
  }
  return out;
}

}  // namespace

RunSetup load_run(const std::filesystem::path& mission_folder, const std::string& scenario_name,
                  const setup::Registry& types, mission::Findings* findings) {
  const Entry mission = mission::load_mission_file(mission_folder, findings);
  const Entry scenario_file = mission::load_scenario(mission_folder, scenario_name, findings);
  RunSetup run;
  run.roster = setup::read_roster(mission.at("simulation"), types);
  const Roster& roster = run.roster;
  run.scenario = read_scenario(scenario_file, roster);
  const bool on_ground =
      std::any_of(roster.begin(), roster.end(), [](const RobotEntry& r) { return r.on_ground; });
  run.world.ground = {nullptr, run.scenario.rocks};
  if (const auto surface = mission.at("simulation").find("surface"))
    surface->attempt([&] { read_surface(*surface, run.world.ground.surface); });
  const auto conditions = scenario_file.find("world");
  if (const auto surface = conditions ? conditions->find("surface") : std::nullopt)
    surface->attempt([&] { read_surface(*surface, run.world.ground.surface); });
  if (on_ground) mission.attempt([&] { run.world.ground.site = load_ground(mission.at("site")); });
  run.world.windows = true_windows(mission, run.scenario.windows);
  add_sunlight(roster, run.scenario, scenario_file.find("windows"), run.world.windows);
  std::set<std::string, std::less<>> known{"rocks", "surface"};
  for (const RobotEntry& robot : roster) {
    const Start& start = run.scenario.starts[robot.name];
    check_on_map(start, robot.name, run.world.ground);
    run.world.robots.push_back(read_robot(robot, start, mission, types, run.scenario, known));
  }
  if (conditions) apply_body_conditions(*conditions, run.world.robots, known);
  if (conditions) setup::refuse_unknown_keys(*conditions, known);
  for (const Stimulus& stimulus : run.scenario.stimuli) {
    const auto* disturbance = std::get_if<world::Disturbance>(&stimulus.what);
    const auto* mishap = disturbance ? std::get_if<world::ComponentMishap>(disturbance) : nullptr;
    const auto* hollow = disturbance ? std::get_if<world::HollowSuccess>(disturbance) : nullptr;
    if (mishap && stimulus.entry) check_mishap(*mishap, *stimulus.entry, run.world);
    const auto* block = disturbance ? std::get_if<world::ViewBlock>(disturbance) : nullptr;
    if (block && stimulus.entry) check_block(*block, *stimulus.entry, run.world);
    const auto* change = disturbance ? std::get_if<world::SoilChange>(disturbance) : nullptr;
    if (change && stimulus.entry)
      check_soil(change->area.soil, stimulus.entry->at("soil"), run.world.ground.surface.soil);
    if (hollow && stimulus.entry) check_hollow(*hollow, *stimulus.entry, run.world);
  }
  return run;
}

}  // namespace roci::sim::scenario
