#include "sim_svc/scenario/body_conditions.hpp"

#include <functional>
#include <vector>

#include "sim_svc/scenario/file_values.hpp"
#include "sim_svc/setup/power_file.hpp"
#include "sim_svc/setup/thermal_file.hpp"

namespace roci::sim::scenario {

using mission::Entry;
using world::RobotSetup;

namespace {

struct BodyCondition {
  const char* name;
  const char* thing;  // that a robot must have
  // Returns whether the robot has it.
  std::function<bool(RobotSetup&, const Entry&)> apply;
};

BodyCondition of_power(const char* name, std::function<void(world::PowerParameters&, const Entry&)> set) {
  return {name, "power", [set = std::move(set)](RobotSetup& robot, const Entry& entry) {
            if (robot.power) set(robot.power->parameters, entry);
            return robot.power.has_value();
          }};
}

BodyCondition of_heat(const char* name, std::function<void(world::ThermalParameters&, const Entry&)> set) {
  return {name, "thermal", [set = std::move(set)](RobotSetup& robot, const Entry& entry) {
            if (robot.thermal) set(*robot.thermal, entry);
            return robot.thermal.has_value();
          }};
}

const std::vector<BodyCondition>& body_conditions() {
  static const std::vector<BodyCondition> all{
      of_power("use_factor", [](auto& power, const Entry& entry) { power.use_factor = at_least(entry, 0); }),
      of_power("gauge", [](auto& power, const Entry& entry) { power.gauge = setup::read_gauge(entry); }),
      of_heat("surroundings_k",
              [](auto& heat, const Entry& entry) { heat.surroundings_k = setup::read_surroundings(entry); }),
      of_heat("waste_factor", [](auto& heat, const Entry& entry) { heat.waste_factor = at_least(entry, 0); }),
      of_heat(
          "loss_factor",
          [](auto& heat, const Entry& entry) { heat.loss_factor = at_least(entry, setup::kLeastFactor); }),
      {"data_capacity_bytes", "data", [](RobotSetup& robot, const Entry& entry) {
         if (robot.data_bytes) robot.data_bytes = at_least(entry, 1);
         return robot.data_bytes.has_value();
       }}};
  return all;
}

}  // namespace

void apply_body_conditions(const Entry& world, std::vector<RobotSetup>& robots,
                           std::set<std::string, std::less<>>& known) {
  for (const BodyCondition& condition : body_conditions()) {
    known.emplace(condition.name);
    const auto entry = world.find(condition.name);
    if (!entry) continue;
    entry->attempt([&] {
      bool used = false;
      for (RobotSetup& robot : robots) used = condition.apply(robot, *entry) || used;
      if (!used)
        entry->fail("no robot has '" + std::string(condition.thing) + "', to which '" + condition.name +
                    "' belongs; drop it, or give a robot that in mission.yaml");
    });
  }
}

}  // namespace roci::sim::scenario
