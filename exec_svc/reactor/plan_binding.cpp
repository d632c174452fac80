#include "exec_svc/reactor/plan_binding.hpp"

#include <algorithm>
#include <map>

#include "exec_svc/mission/template_text.hpp"

namespace roci::exec::reactor {

using beliefs::Beliefs;
using goals::GoalRecord;
using goals::GoalSet;
using mission::ActionBinding;
using mission::fill_names;
using mission::fill_positions;
using mission::GoalKind;
using mission::MissionModel;
using mission::ObjectModel;
using problem::Problem;
using problem::ProblemObject;

namespace {

using temporal::Condition;
using temporal::ConditionNode;
using temporal::ConditionOp;

using PropertyTable = std::map<std::string, std::string>;  // "place-1.x" → "12.5"

PropertyTable property_table(const Problem& problem) {
  PropertyTable out;
  for (const ProblemObject& object : problem.objects) {
    for (const temporal::Property& property : object.properties)
      out[object.name + "." + property.name] = property.value;
  }
  return out;
}

// Engines give conditions as one comparison or a conjunction of comparisons; only those that observations can
// decide stay.
Condition decidable(const Condition& condition, const Beliefs& beliefs) {
  std::vector<Condition> parts;
  for (const ConditionNode& node : condition.nodes) {
    if (node.op == ConditionOp::all_of || node.op == ConditionOp::always) continue;
    if (node.op == ConditionOp::any_of || node.op == ConditionOp::negation) return {};
    if (beliefs.lookup(node.timeline)) parts.push_back(Condition{{node}});
  }
  return parts.empty() ? Condition{} : temporal::all_of(parts);
}

std::vector<std::string> goals_served(const std::vector<std::string>& objects, const MissionModel& mission,
                                      const GoalSet& goals) {
  std::vector<std::string> out;
  for (const GoalRecord* record : goals.open()) {
    const auto values = template_values(record->request);
    const GoalKind& kind = mission.goal_kinds.at(record->request.kind);
    const bool serves = std::any_of(kind.objects.begin(), kind.objects.end(), [&](const ObjectModel& object) {
      return std::find(objects.begin(), objects.end(), fill_names(object.name, values)) != objects.end();
    });
    if (serves) out.push_back(record->request.key.text());
  }
  return out;
}

/// Decisions of one plan and the next have different ids, as activities have.
void rename_decisions(temporal::FlexiblePlan& plan, std::uint32_t version,
                      const std::map<std::string, std::string>& new_ids) {
  for (temporal::DecisionPoint& decision : plan.decisions) {
    decision.id = "p" + std::to_string(version) + "." + decision.id;
    for (temporal::DecisionChoice& choice : decision.choices)
      for (std::string& id : choice.activities)
        if (const auto renamed = new_ids.find(id); renamed != new_ids.end()) id = renamed->second;
    for (temporal::ArgumentBinding& binding : decision.bindings)
      if (const auto renamed = new_ids.find(binding.activity); renamed != new_ids.end())
        binding.activity = renamed->second;
  }
}

}  // namespace

std::string bind_plan(temporal::FlexiblePlan& plan, std::uint32_t version, const MissionModel& mission,
                      const Problem& problem, const Beliefs& beliefs, const GoalSet& goals) {
  const PropertyTable properties = property_table(problem);
  plan.version = version;
  plan.id = mission.name;
  std::size_t number = 0;
  std::map<std::string, std::string> new_ids;
  for (temporal::PlanActivity& activity : plan.activities) {
    const auto found = mission.actions.find(activity.name);
    if (found == mission.actions.end()) {
      return "the mission file binds no command to action '" + activity.name + "'; add it under 'actions'";
    }
    const ActionBinding& binding = found->second;
    std::vector<std::string> objects;
    for (const temporal::Property& argument : activity.arguments) objects.push_back(argument.value);
    std::string& new_id = new_ids[activity.id];
    new_id = "p" + std::to_string(version) + "." + std::to_string(++number) + "-" + activity.name;
    activity.id = new_id;
    activity.owner = binding.owner;
    activity.subsystem = binding.component;
    activity.command_name = binding.command;
    activity.lateness = binding.lateness;
    activity.retries = binding.retries;
    activity.wait_timeout = binding.wait_timeout;
    activity.contingency = binding.contingency;
    activity.goals_served = goals_served(objects, mission, goals);
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
  }
  rename_decisions(plan, version, new_ids);
  return "";
}

}  // namespace roci::exec::reactor
