#include "exec_svc/reactor/plan_binding.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "core/temporal/activity_timeline.hpp"
#include "exec_svc/mission/template_text.hpp"

namespace roci::exec::reactor {

using beliefs::Beliefs;
using mission::ActionBinding;
using mission::Component;
using mission::fill_positions;
using mission::MissionModel;
using problem::Problem;
using problem::ProblemObject;

namespace {

using temporal::Condition;
using temporal::ConditionNode;
using temporal::ConditionOp;
using temporal::PlanActivity;

using PropertyTable = std::map<std::string, std::string>;  // "place-1.x" → "12.5"

PropertyTable property_table(const Problem& problem) {
  PropertyTable out;
  for (const ProblemObject& object : problem.objects) {
    for (const temporal::Property& property : object.properties)
      out[object.name + "." + property.name] = property.value;
  }
  return out;
}

// Keeps those comparisons that observations can decide; engines give conditions as one comparison or a
// conjunction of them.
Condition decidable(const Condition& condition, const Beliefs& beliefs) {
  std::vector<Condition> parts;
  for (const ConditionNode& node : condition.nodes) {
    if (node.op == ConditionOp::all_of || node.op == ConditionOp::always) continue;
    if (node.op == ConditionOp::any_of || node.op == ConditionOp::negation) return {};
    if (beliefs.lookup(node.timeline)) parts.push_back(Condition{{node}});
  }
  return parts.empty() ? Condition{} : temporal::all_of(parts);
}

using Renaming = std::map<std::string, std::string>;

// Gives the activities, in their order, ids that no other plan of the run has.
Renaming rename_activities(temporal::FlexiblePlan& plan) {
  Renaming renamed;
  std::size_t number = 0;
  for (PlanActivity& activity : plan.activities) {
    std::string id =
        "p" + std::to_string(plan.version) + "." + std::to_string(++number) + "-" + activity.name;
    renamed[activity.id] = id;
    activity.id = std::move(id);
  }
  return renamed;
}

// Renames activities in conditions that ask how another activity went.
void rename_in(Condition& condition, const Renaming& renamed) {
  for (ConditionNode& node : condition.nodes) {
    const auto found = renamed.find(temporal::activity_of(node.timeline));
    if (found != renamed.end()) node.timeline = temporal::activity_timeline(found->second);
  }
}

// Renames all references. Decisions of one plan and the next have different ids, too.
void rename_references(temporal::FlexiblePlan& plan, const Renaming& renamed) {
  const auto rename = [&](std::string& id) {
    if (const auto found = renamed.find(id); found != renamed.end()) id = found->second;
  };
  for (PlanActivity& activity : plan.activities) {
    rename(activity.parent);
    for (Condition* condition : {&activity.pre, &activity.maintenance, &activity.post, &activity.skip_if})
      rename_in(*condition, renamed);
  }
  for (temporal::DecisionPoint& decision : plan.decisions) {
    decision.id = "p" + std::to_string(plan.version) + "." + decision.id;
    for (temporal::DecisionChoice& choice : decision.choices) {
      for (std::string& activity : choice.activities) rename(activity);
      rename_in(choice.rule, renamed);
    }
    for (temporal::ArgumentBinding& binding : decision.bindings) rename(binding.activity);
  }
}

std::string bind_action(PlanActivity& activity, const MissionModel& mission, const PropertyTable& properties,
                        const Beliefs& beliefs) {
  const auto found = mission.actions.find(activity.name);
  if (found == mission.actions.end())
    return "the mission file binds no command to action '" + activity.name + "'; add it under 'actions'";
  const ActionBinding& binding = found->second;
  std::vector<std::string> objects;
  for (const temporal::Property& argument : activity.arguments) objects.push_back(argument.value);
  activity.owner = binding.owner;
  activity.robot = binding.robot;
  activity.subsystem = binding.component;
  activity.command_name = binding.command;
  activity.lateness = binding.lateness;
  activity.retries = binding.retries;
  activity.wait_timeout = binding.wait_timeout;
  activity.contingency = binding.contingency;
  activity.arguments.clear();
  for (const auto& [name, text] : binding.arguments) {
    std::string value = fill_positions(text, objects);
    if (const auto property = properties.find(value); property != properties.end()) {
      value = property->second;
    } else if (text.starts_with('?') && text.find('.') != std::string::npos) {
      return "action '" + activity.name + "' needs " + value +
             " for its command, and the object has no such property";
    }
    activity.arguments.push_back({name, value});
  }
  activity.pre = decidable(activity.pre, beliefs);
  activity.maintenance = decidable(activity.maintenance, beliefs);
  activity.post = {};  // what an action achieves is seen by the goals and by the next action's conditions
  return "";
}

std::string known_subsystems(const MissionModel& mission) {
  std::string out;
  for (const Component& component : mission.components)
    out += (out.empty() ? "" : ", ") + component.name + " of " + component.owner;
  return out.empty() ? "none" : out;
}

// Works on PlanActivity or PlanCommand, whose members have the same names.
template <class Commanding>
std::string bind_command(Commanding& command, const std::string& activity, const MissionModel& mission) {
  const auto fits = [&](const Component& component) {
    return component.name == command.subsystem && component.owner == command.owner &&
           (command.robot.empty() || component.robot.empty() || component.robot == command.robot);
  };
  const auto component = std::ranges::find_if(mission.components, fits);
  if (component == mission.components.end()) {
    const std::string robot = command.robot.empty() ? "" : "robot '" + command.robot + "' has ";
    return activity + " commands '" + command.command_name + "' of subsystem '" + command.subsystem +
           "' and owner '" + command.owner + "', but " + (robot.empty() ? "the mission has " : robot) +
           "no such subsystem; it has: " + known_subsystems(mission);
  }
  if (command.robot.empty()) command.robot = component->robot;
  return "";
}

// Fills in properties such as "w1.x" of objects of the problem.
std::string bind_properties(PlanActivity& activity, const Problem& problem, const PropertyTable& properties) {
  for (temporal::Property& argument : activity.arguments) {
    const auto dot = argument.value.find('.');
    if (dot == std::string::npos) continue;
    if (const auto property = properties.find(argument.value); property != properties.end()) {
      argument.value = property->second;
    } else if (std::ranges::find(problem.objects, argument.value.substr(0, dot), &ProblemObject::name) !=
               problem.objects.end()) {
      return activity.id + " needs " + argument.value +
             " for its command, and the object has no such property; give it one under 'objects'";
    }
  }
  return "";
}

std::string bind_commands(PlanActivity& activity, const MissionModel& mission, const Problem& problem,
                          const PropertyTable& properties) {
  if (!activity.contingency.empty() && !mission.contingencies.contains(activity.contingency))
    return activity.id + " names contingency '" + activity.contingency +
           "', which the mission has not; add it under 'contingencies'";
  if (activity.owner.empty()) return "";  // internal state alone
  if (std::string fault = bind_command(activity, activity.id, mission); !fault.empty()) return fault;
  if (std::string fault = bind_properties(activity, problem, properties); !fault.empty()) return fault;
  for (temporal::PlanCommand& command : activity.then)
    if (std::string fault = bind_command(command, activity.id, mission); !fault.empty()) return fault;
  return "";
}

}  // namespace

std::string bind_plan(temporal::FlexiblePlan& plan, std::uint32_t version, const MissionModel& mission,
                      const Problem& problem, const Beliefs& beliefs) {
  const PropertyTable properties = property_table(problem);
  plan.version = version;
  plan.id = mission.name;
  const Renaming renamed = rename_activities(plan);
  rename_references(plan, renamed);
  for (PlanActivity& activity : plan.activities) {
    std::string fault = mission.has_domain() ? bind_action(activity, mission, properties, beliefs)
                                             : bind_commands(activity, mission, problem, properties);
    if (!fault.empty()) return fault;
  }
  return "";
}

}  // namespace roci::exec::reactor
