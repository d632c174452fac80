#include "exec_svc/reactor/single_command.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace roci::exec::reactor {

using mission::Component;
using temporal::FlexiblePlan;
using temporal::PlanActivity;
using temporal::Time;

namespace {

constexpr char kGround[] = "ground";  // in the place of an engine

SingleCommand refused(std::string fault) { return {{}, "", std::move(fault)}; }

std::string names_of(const mission::MissionModel& mission) {
  std::string out;
  for (const Component& component : mission.components) out += (out.empty() ? "" : ", ") + component.name;
  return out.empty() ? "none" : out;
}

// Reads "to=w1" as the argument `to`, or returns nothing if the text is no argument.
std::optional<temporal::Property> argument_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos) return std::nullopt;
  return temporal::Property{text.substr(0, equals), text.substr(equals + 1)};
}

void place(FlexiblePlan& plan, PlanActivity activity) {
  activity.start_point = plan.point_count++;
  activity.end_point = plan.point_count++;
  plan.activities.push_back(std::move(activity));
}

}  // namespace

bool is_of_single_commands(const FlexiblePlan& plan) { return plan.engine == kGround; }

SingleCommand plan_of_command(const orders::Order& order, const mission::MissionModel& mission,
                              std::uint32_t version, Time now, const executive::Executive& executive) {
  const auto component = std::ranges::find(mission.components, order.target, &Component::name);
  if (component == mission.components.end())
    return refused("there is no component '" + order.target +
                   "'; the executive commands: " + names_of(mission));
  const auto* what = std::get_if<temporal::State>(&order.content);
  if (what == nullptr || what->name.empty()) return refused("the order names no command");
  PlanActivity command;
  for (const std::string& text : what->arguments) {
    const auto argument = argument_of(text);
    if (!argument) return refused("argument '" + text + "' is no NAME=VALUE");
    command.arguments.push_back(*argument);
  }
  SingleCommand out;
  out.plan.id = mission.name;
  out.plan.version = version;
  out.plan.engine = kGround;
  out.plan.origin = now;
  if (is_of_single_commands(executive.plan())) {
    for (const executive::StepStatus& step : executive.steps()) {
      if (is_over(step.state)) continue;
      const PlanActivity& given = *executive.activity(step.activity);
      if (given.subsystem == component->name)
        return refused(component->name + " carries out " + given.id +
                       "; wait for its end, or stop it (roci order safe)");
      place(out.plan, given);
    }
  }
  out.activity = "p" + std::to_string(version) + ".1-" + what->name;
  command.id = out.activity;
  command.name = command.command_name = what->name;
  command.owner = component->owner;
  command.robot = component->robot;
  command.subsystem = component->name;
  command.failure = temporal::FailureScope::of_activity;
  place(out.plan, std::move(command));
  return out;
}

}  // namespace roci::exec::reactor
