#include <algorithm>
#include <map>
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

// The states that a choice of a decision over a variable begins with; nothing: one of them does not exist.
std::optional<std::vector<GroundState>> begun_with(const Asked& asked, Index object) {
  Binding binding = asked.way.binding;
  binding[*asked.decision.variable] = object;
  std::vector<GroundState> out;
  for (const Index subgoal : asked.decision.subgoals) {
    const model::Pattern& pattern = asked.behaviour().subgoals[subgoal].state;
    out.push_back({pattern.component, pattern.state, {}});
    for (const model::Term& term : pattern.terms)
      out.back().objects.push_back(model::object_of(term, binding));
    if (!exists(asked.version.model, out.back())) return std::nullopt;
  }
  return out;
}

// By name: the states of each object that might be decided on.
std::map<std::string, std::vector<GroundState>> objects_to_choose(const Asked& asked) {
  std::map<std::string, std::vector<GroundState>> out;
  for (const std::string& name : admissible(asked)) {
    const auto object = std::ranges::find(asked.version.model.objects, name, &model::Object::name);
    const auto states = begun_with(asked, static_cast<Index>(object - asked.version.model.objects.begin()));
    if (states) out.emplace(name, *states);
  }
  return out;
}

std::string object_fault(const Asked& asked, const temporal::DecisionPoint& point) {
  const auto objects = objects_to_choose(asked);
  std::set<std::string> named;
  for (const temporal::DecisionChoice& choice : point.choices) {
    const auto object = objects.find(choice.name);
    if (object == objects.end() || !named.insert(choice.name).second || !choice.rule.empty())
      return "choice '" + choice.name + "' is none of the behaviour, stands twice, or has a rule";
    const bool planned = &choice == &point.choices.front();
    if (planned &&
        choice.name != asked.version.model.objects[asked.way.binding[*asked.decision.variable]].name)
      return "its first choice is not the one that the plan reckons with";
    std::multiset<std::string> wanted, found;
    for (const GroundState& state : object->second) wanted.insert(asked.version.text(state));
    for (const std::string& id : choice.activities) {
      const Part& part = asked.version.parts[asked.version.part_of.at(id)];
      if (part.parent != asked.part || part.aside == planned) continue;
      if (planned && !wanted.contains(part.activity->name)) continue;
      found.insert(part.activity->name);
      if (!asked.version.network.implies(point.decide_before, part.start(), Duration{0}, temporal::no_bound))
        return "choice '" + choice.name + "' may begin before it is decided";
    }
    if (found != wanted || (!planned && found.size() != choice.activities.size()))
      return "choice '" + choice.name + "' has not just the activities of the behaviour for that object";
  }
  return named.size() == objects.size() ? "" : "it has not all objects that fulfil the behaviour's tests";
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
  if (asked.decision.over) return object_fault(asked, point);
  return asked.decision.variable ? variable_fault(asked, point) : choice_fault(asked, point);
}

const model::Decision* decision_named(const model::Behaviour& behaviour, const std::string& name) {
  const auto found = std::ranges::find(behaviour.decisions, name, &model::Decision::name);
  return found == behaviour.decisions.end() ? nullptr : &*found;
}

// What is above a decision that may leave it undone must not be taken for done when it ends.
std::string conclusion_fault(const Asked& asked) {
  if (!asked.decision.may_end_plan()) return {};
  for (Index above = asked.part; above != kNone; above = asked.version.parts[above].parent) {
    const Part& part = asked.version.parts[above];
    if (!part.state || !part.value) continue;
    const auto& values = asked.version.timelines[part.state->component];
    if (*part.value == 0 || *part.value + 1 >= values.size()) continue;
    const auto before = seen(asked.version, values[*part.value - 1].state);
    const auto after = seen(asked.version, values[*part.value + 1].state);
    if (!after || after == before) continue;
    for (const temporal::Impact& impact : part.activity->impacts)
      if (impact.moment == temporal::ImpactWhen::at_end && Seen{impact.timeline, impact.amount} == *after)
        return "whatever is decided, " + part.activity->name + " ends with " +
               asked.version.text(values[*part.value + 1].state);
  }
  return {};
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
    const Asked asked{version, part->second, way, *decision};
    why_not = fault(asked, point);
    if (why_not.empty()) why_not = conclusion_fault(asked);
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
      const Asked asked{version, part, way, decision};
      const bool nothing_to_decide = decision.over ? objects_to_choose(asked).size() < 2
                                                   : decision.variable && bound_arguments(asked).empty();
      if (!open.contains(id) && !nothing_to_decide)
        out.push_back("decision '" + decision.name + "' of " + version.text(version.parts[part]) +
                      " is not open in the plan");
    }
  }
}

}  // namespace roci::planner::timeline_htn::checking
