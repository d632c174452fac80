#include <algorithm>
#include <set>

#include "planner_svc/timeline_htn/checking/parts.hpp"

namespace roci::planner::timeline_htn::checking {

namespace {

/// Is a decision of a behaviour, in one decomposition by it.
struct Asked {
  const Version& version;
  Index part;
  const Decomposition& way;
  const model::Decision& decision;

  const model::Behaviour& behaviour() const { return version.model.behaviours[way.behaviour]; }
};

std::set<std::string> admissible(const Asked& asked) {
  std::set<std::string> out;
  Binding binding = asked.way.binding;
  for (Index object = 0; object < asked.version.model.objects.size(); ++object) {
    if (asked.version.model.objects[object].type !=
        asked.behaviour().variables[*asked.decision.variable].type)
      continue;
    binding[*asked.decision.variable] = object;
    if (std::ranges::all_of(asked.behaviour().where, [&](const model::Test& test) {
          return holds(asked.version.model, test, binding);
        }))
      out.insert(asked.version.model.objects[object].name);
  }
  return out;
}

// The arguments of commands in which the variable stands: "activity.argument".
std::set<std::string> bound_arguments(const Asked& asked) {
  std::set<std::string> out;
  for (Index i = 0; i < asked.way.part_of.size(); ++i) {
    if (asked.way.part_of[i] == kNone) continue;
    const Part& part = asked.version.parts[asked.way.part_of[i]];
    const auto& command = asked.version.definition(*part.state).command;
    if (!command) continue;
    for (const model::Argument& argument : command->arguments)
      if (argument.term && asked.behaviour().subgoals[i].state.terms[argument.term->index] ==
                               model::Term{*asked.decision.variable, false})
        out.insert(part.activity->id + "." + argument.name);
  }
  return out;
}

std::string variable_fault(const Asked& asked, const temporal::DecisionPoint& point) {
  if (std::set<std::string>(point.admissible.begin(), point.admissible.end()) != admissible(asked))
    return "the values that it admits are not those that fulfil the behaviour's tests";
  std::set<std::string> bound;
  for (const temporal::ArgumentBinding& one : point.bindings) bound.insert(one.activity + "." + one.argument);
  return bound == bound_arguments(asked) ? ""
                                         : "it does not bind just the arguments in which its variable stands";
}

std::string choice_fault(const Asked& asked, const temporal::DecisionPoint& point) {
  if (point.choices.size() != asked.decision.choices.size()) return "it has not the choices of the behaviour";
  for (std::size_t c = 0; c < point.choices.size(); ++c) {
    const model::Choice& choice = asked.decision.choices[c];
    if (point.choices[c].name != choice.name || point.choices[c].rule != choice.rule)
      return "choice '" + point.choices[c].name + "' is not '" + choice.name +
             "' of the behaviour, or has another rule";
    for (const Index subgoal : choice.subgoals) {
      const Index part = asked.way.part_of[subgoal];
      if (part != kNone &&
          std::ranges::find(point.choices[c].activities, asked.version.parts[part].activity->id) ==
              point.choices[c].activities.end())
        return "choice '" + choice.name + "' lacks the activity of subgoal '" +
               asked.behaviour().subgoals[subgoal].name + "'";
    }
  }
  return {};
}

std::string fault(const Asked& asked, const temporal::DecisionPoint& point) {
  if (point.resolver_kind != asked.decision.resolver_kind || point.resolver != asked.decision.resolver)
    return "it is asked of somebody else than the behaviour says";
  const model::Point& before = asked.decision.before;
  const Index index = before.subgoal ? asked.way.part_of[*before.subgoal] : asked.part;
  if (index != kNone) {
    const Part& part = asked.version.parts[index];
    if (!asked.version.network.same_time(point.decide_before, before.end ? part.end() : part.start()))
      return "it need not be made before the point that the behaviour names";
  }
  return asked.decision.variable ? variable_fault(asked, point) : choice_fault(asked, point);
}

const model::Decision* decision_named(const model::Behaviour& behaviour, const std::string& name) {
  const auto found = std::ranges::find(behaviour.decisions, name, &model::Decision::name);
  return found == behaviour.decisions.end() ? nullptr : &*found;
}

void check_point(const Version& version, const Decompositions& decompositions,
                 const temporal::DecisionPoint& point, Faults& out) {
  const std::size_t dot = point.id.rfind('.');
  const auto part = version.part_of.find(point.id.substr(0, dot));
  if (dot == std::string::npos || part == version.part_of.end())
    return out.push_back("decision " + point.id + " is of no activity of the plan");
  std::string why_not = "no behaviour for it has this decision";
  for (const Decomposition& way : decompositions[part->second]) {
    const auto* decision = decision_named(version.model.behaviours[way.behaviour], point.id.substr(dot + 1));
    if (decision == nullptr) continue;
    why_not = fault({version, part->second, way, *decision}, point);
    if (why_not.empty()) return;
  }
  if (!decompositions[part->second].empty()) out.push_back("decision " + point.id + ": " + why_not);
}

}  // namespace

void check_decisions(const Version& version, const Decompositions& decompositions, Faults& out) {
  std::set<std::string> open;
  for (const temporal::DecisionPoint& point : version.plan.decisions) {
    open.insert(point.id);
    check_point(version, decompositions, point, out);
  }
  for (Index part = 0; part < decompositions.size(); ++part) {
    if (decompositions[part].empty()) continue;
    const Decomposition& way = decompositions[part].front();
    for (const model::Decision& decision : version.model.behaviours[way.behaviour].decisions) {
      const std::string id = version.parts[part].activity->id + "." + decision.name;
      const bool binds_nothing = decision.variable && bound_arguments({version, part, way, decision}).empty();
      if (!open.contains(id) && !binds_nothing)
        out.push_back("decision '" + decision.name + "' of " + version.text(version.parts[part]) +
                      " is not open in the plan");
    }
  }
}

}  // namespace roci::planner::timeline_htn::checking
