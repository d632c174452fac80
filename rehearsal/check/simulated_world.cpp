#include "rehearsal/check/simulated_world.hpp"

#include <algorithm>
#include <memory>

namespace roci::rehearsal::check {

using sim::setup::ComponentEntry, sim::setup::RobotEntry;
using sim::world::Component, sim::world::ComponentSetup, sim::world::RobotSetup;

namespace {

std::unique_ptr<Component> made(const RobotSetup& robot, const std::string& name) {
  const auto setup = std::ranges::find(robot.components, name, &ComponentSetup::name);
  if (setup == robot.components.end()) return nullptr;
  return setup->make(sim::world::RandomStream(1, name));
}

void add_component(const std::string& robot, const std::string& name, const Component* component,
                   SimulatedWorld& out) {
  SimulatedComponent& entry = out.components.emplace_back(SimulatedComponent{robot, name});
  out.timelines.push_back(entry.timeline());
  if (component == nullptr) return;
  entry.known = true;
  entry.commands = component->commands();
  entry.commands.push_back({sim::world::kStopCommand, {}});
  entry.states = component->state_forms();
  entry.windows = component->awaited_windows();
  for (const auto& number : component->numbers())
    out.timelines.push_back(entry.timeline() + "." + number.name);
  for (const auto& thing : component->thing_forms())
    out.families.push_back({robot + "." + thing.family + ".", thing.states});
  // A state of its own is modelled as a component is, though it takes no commands. `entry` is not valid behind this.
  for (const auto& named : component->named_forms()) {
    out.timelines.push_back(robot + "." + named.name);
    SimulatedComponent state{robot, named.name, true};
    state.states = named.states;
    state.commands.push_back({sim::world::kStopCommand, {}});
    out.components.push_back(std::move(state));
  }
}

}  // namespace

const SimulatedComponent* SimulatedWorld::find(std::string_view robot, std::string_view component) const {
  const auto found = std::ranges::find_if(components, [&](const SimulatedComponent& one) {
    return one.name == component && (robot.empty() ? robots.size() == 1 : one.robot == robot);
  });
  return found == components.end() ? nullptr : &*found;
}

const SimulatedComponent* SimulatedWorld::on_timeline(std::string_view timeline) const {
  const auto found = std::ranges::find(components, timeline, &SimulatedComponent::timeline);
  return found == components.end() ? nullptr : &*found;
}

const SimulatedFamily* SimulatedWorld::family_of(std::string_view timeline) const {
  const auto found = std::ranges::find_if(
      families, [&](const SimulatedFamily& family) { return timeline.starts_with(family.prefix); });
  return found == families.end() ? nullptr : &*found;
}

std::vector<std::string> SimulatedWorld::component_names(std::string_view robot) const {
  std::vector<std::string> out;
  for (const SimulatedComponent& one : components)
    if (robot.empty() || one.robot == robot) out.push_back(one.name);
  return out;
}

SimulatedWorld simulated_world(const sim::scenario::RunSetup& run, const std::string& service) {
  SimulatedWorld out;
  out.service = service;
  for (std::size_t i = 0; i < run.roster.size(); ++i) {
    const RobotEntry& robot = run.roster[i];
    out.robots.push_back(robot.name);
    const RobotSetup* setup = i < run.world.robots.size() ? &run.world.robots[i] : nullptr;
    for (const ComponentEntry& component : robot.components)
      add_component(robot.name, component.name,
                    setup == nullptr ? nullptr : made(*setup, component.name).get(), out);
    if (robot.power) out.timelines.push_back(robot.name + ".battery");
    if (robot.thermal)
      for (const auto& zone : robot.thermal->zones)
        out.timelines.push_back(robot.name + ".heat." + zone.name);
    if (!robot.on_ground && (setup == nullptr || !setup->pose)) continue;
    for (const char* number : {".x", ".y", ".heading"}) out.timelines.push_back(robot.name + number);
  }
  return out;
}

std::vector<std::string> names_of(const std::vector<sim::world::StateForm>& states) {
  std::vector<std::string> out;
  for (const auto& state : states) out.push_back(state.name);
  return out;
}

std::vector<std::string> names_of(const std::vector<sim::world::CommandForm>& commands) {
  std::vector<std::string> out;
  for (const auto& command : commands) out.push_back(command.name);
  return out;
}

}  // namespace roci::rehearsal::check
