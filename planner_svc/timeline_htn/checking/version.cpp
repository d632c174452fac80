#include "planner_svc/timeline_htn/checking/version.hpp"

#include <algorithm>

namespace roci::planner::timeline_htn::checking {

namespace {

template <typename Items>
std::optional<Index> named(const Items& items, const std::string& name) {
  const auto found = std::ranges::find_if(items, [&](const auto& one) { return one.name == name; });
  if (found == items.end()) return std::nullopt;
  return static_cast<Index>(found - items.begin());
}

std::optional<GroundState> ground(const model::Model& model, Index component, const std::string& name,
                                  const std::vector<std::string>& arguments) {
  const auto state = named(model.components[component].states, name);
  if (!state) return std::nullopt;
  const auto& parameters = model.components[component].states[*state].parameters;
  if (parameters.size() != arguments.size()) return std::nullopt;
  GroundState out{component, *state, {}};
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const auto object = named(model.objects, arguments[i]);
    if (!object || model.objects[*object].type != parameters[i].type) return std::nullopt;
    out.objects.push_back(*object);
  }
  return out;
}

// "component.state(a, b)"
std::optional<GroundState> parse(const model::Model& model, const std::string& text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string::npos) return std::nullopt;
  const auto component = named(model.components, text.substr(0, dot));
  if (!component) return std::nullopt;
  const std::size_t open = std::min(text.find('('), text.size());
  std::vector<std::string> arguments;
  for (std::size_t at = open + 1; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(",)", at), text.size());
    arguments.push_back(text.substr(at, end - at));
    at = std::min(text.find_first_not_of(", )", end), text.size());
  }
  auto out = ground(model, *component, text.substr(dot + 1, open - dot - 1), arguments);
  return out && to_text(model, *out) == text ? out : std::nullopt;
}

void read_tokens(Version& version, Faults& out) {
  version.timelines.resize(version.model.components.size());
  for (const temporal::Token& token : version.plan.tokens) {
    const auto component = named(version.model.components, token.timeline);
    const auto* held = std::get_if<temporal::State>(&token.held);
    const auto state = component && held != nullptr
                           ? ground(version.model, *component, held->name, held->arguments)
                           : std::nullopt;
    if (!component)
      out.push_back("the plan has a timeline " + token.timeline + ", and the model has no such component");
    else if (!state)
      out.push_back("timeline " + token.timeline + " holds " + temporal::to_text(token.held) +
                    ", which is no state of the component");
    else
      version.timelines[*component].push_back({*state, token.start_point, token.end_point});
  }
}

void read_activities(Version& version, Faults& out) {
  const model::Model& model = version.model;
  for (const temporal::PlanActivity& activity : version.plan.activities) {
    Part part{.activity = &activity, .state = parse(model, activity.name)};
    version.part_of[activity.id] = static_cast<Index>(version.parts.size());
    const auto behaviour = named(model.behaviours, activity.name);
    if (!part.state && behaviour) part.behaviour = *behaviour;
    if (!part.state && !behaviour)
      out.push_back("activity " + activity.id + ", '" + activity.name +
                    "', is neither a state nor a behaviour of the model");
    const char* level =
        to_text(part.state ? model.components[part.state->component].layer : model::Layer::abstract);
    if (activity.level != level)
      out.push_back("activity " + activity.id + ", '" + activity.name + "', stands on level '" +
                    activity.level + "', not on '" + level + "'");
    version.parts.push_back(std::move(part));
  }
  for (Index i = 0; i < version.parts.size(); ++i) {
    const std::string& parent = version.parts[i].activity->parent;
    if (parent.empty()) continue;
    version.parts[i].parent = version.part_of.at(parent);
    version.parts[version.parts[i].parent].parts.push_back(i);
  }
  for (const temporal::DecisionPoint& decision : version.plan.decisions)
    for (std::size_t choice = 1; choice < decision.choices.size(); ++choice)
      for (const std::string& id : decision.choices[choice].activities)
        if (std::ranges::find(decision.choices.front().activities, id) ==
            decision.choices.front().activities.end())
          version.parts[version.part_of.at(id)].aside =
              true;  // else the plan goes on with it, whatever is chosen
  for (Part& part : version.parts)
    for (Index above = part.parent; above != kNone && part.state; above = version.parts[above].parent)
      part.within = part.within || (version.parts[above].state &&
                                    version.parts[above].state->component == part.state->component);
}

}  // namespace

std::string Version::text(const Part& part) const {
  return part.activity->name + " (activity " + part.activity->id + ")";
}

Version take_apart(const model::Model& model, const temporal::FlexiblePlan& plan, Faults& out) {
  Version version{model, plan, {plan.point_count, all_constraints(plan)}};
  read_tokens(version, out);
  read_activities(version, out);
  return version;
}

bool unify(const model::Pattern& pattern, const GroundState& state, Binding& binding) {
  if (pattern.component != state.component || pattern.state != state.state) return false;
  for (std::size_t i = 0; i < pattern.terms.size(); ++i) {
    const model::Term& term = pattern.terms[i];
    if (!term.object && binding[term.index] == kNone) binding[term.index] = state.objects[i];
    if (model::object_of(term, binding) != state.objects[i]) return false;
  }
  return true;
}

bool exists(const model::Model& model, const GroundState& state) {
  const model::State& definition = model.components[state.component].states[state.state];
  return bounds(model, definition, state.objects) &&
         std::ranges::all_of(definition.where,
                             [&](const model::Test& test) { return holds(model, test, state.objects); });
}

}  // namespace roci::planner::timeline_htn::checking
