#include "sim_svc/scenario/body_stimuli_file.hpp"

#include <algorithm>

#include "sim_svc/scenario/file_values.hpp"
#include "sim_svc/setup/thermal_file.hpp"

namespace roci::sim::scenario {

using mission::Entry;
using setup::RobotEntry;
using setup::Roster;

namespace {

constexpr double kSlowest = 1e-4;  // share of a rate

void need_battery(const Entry& entry, const RobotEntry& robot) {
  if (!robot.power) entry.fail("'" + robot.name + "' has no battery to lose energy from; drop the stimulus");
}

}  // namespace

world::EnergyLoss read_energy_loss(const Entry& entry, const RobotEntry& robot) {
  need_battery(entry, robot);
  return {robot.name, at_least(entry, 0)};
}

world::EnergyDrop read_energy_drop(const Entry& entry, const RobotEntry& robot) {
  need_battery(entry, robot);
  return {robot.name, at_least(entry, 0)};
}

world::SurroundingsChange read_surroundings_change(const Entry& entry, const Roster& roster) {
  entry.allow_only({"kelvin"});
  if (std::ranges::none_of(roster, [](const RobotEntry& robot) { return robot.thermal.has_value(); }))
    entry.fail(
        "no robot has thermal zones that would notice; drop the stimulus, or add thermal in mission.yaml");
  return {setup::read_surroundings(entry.at("kelvin"))};
}

world::SuddenHeat read_sudden_heat(const Entry& entry, const RobotEntry& robot) {
  entry.allow_only({"zone", "joules"});
  const Entry zone = entry.at("zone");
  std::vector<std::string> known;
  if (robot.thermal)
    for (const world::ZoneParameters& one : robot.thermal->zones) known.push_back(one.name);
  if (std::ranges::find(known, zone.text()) == known.end())
    zone.fail("'" + robot.name + "' has no thermal zone '" + zone.text() +
              "'; known: " + setup::known_names(zone.text(), known));
  return {robot.name, zone.text(), entry.at("joules").number()};
}

world::RateChange read_rate_change(const Entry& entry, const RobotEntry& robot) {
  entry.allow_only({"component", "factor"});
  const setup::ComponentEntry& component = component_of(entry.at("component"), robot);
  if (!component.has_rate)
    entry.fail("a component of type " + component.type + " has no rate; name one of type direct_radio");
  return {robot.name, component.name, at_least(entry.at("factor"), kSlowest)};
}

world::ViewBlock read_view_block(const Entry& entry, temporal::Time at) {
  entry.allow_only({"window", "for_s"});
  return {entry.at("window").text(), at + time_of(entry.at("for_s"))};
}

}  // namespace roci::sim::scenario
