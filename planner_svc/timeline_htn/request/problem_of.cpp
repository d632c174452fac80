#include "planner_svc/timeline_htn/request/problem_of.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "planner_svc/timeline_htn/model/bounds.hpp"
#include "planner_svc/timeline_htn/reading/load.hpp"

namespace roci::planner::timeline_htn::request {

using engine::Request;
using model::Index, model::Model, model::Pattern;
using temporal::ConditionOp, temporal::Duration;

namespace {

constexpr Index kOpen = ~Index{0};
const Duration kDay = temporal::seconds(86400);

std::optional<Index> object_named(const Model& model, const std::string& name, Index type) {
  for (Index i = 0; i < model.objects.size(); ++i)
    if (model.objects[i].name == name && model.objects[i].type == type) return i;
  return std::nullopt;
}

// Gives the parameters of a state their objects from a value by which it is observed; false: it is another state.
bool matches(const Model& model, const model::State& state, const temporal::Value& value,
             std::vector<Index>& objects) {
  const model::Observed& observed = *state.observed;
  if (const bool* truth = std::get_if<bool>(&value)) return observed.word == (*truth ? "true" : "false");
  if (const double* number = std::get_if<double>(&value))
    return std::strtod(observed.word.c_str(), nullptr) == *number && !observed.word.empty() &&
           observed.word.find_first_not_of("0123456789.eE+-") == std::string::npos;
  const auto* seen = std::get_if<temporal::State>(&value);
  if (seen == nullptr || seen->name != observed.word || seen->arguments.size() != observed.terms.size())
    return false;
  for (std::size_t i = 0; i < observed.terms.size(); ++i) {
    const Index parameter = observed.terms[i].index;
    const auto object = object_named(model, seen->arguments[i], state.parameters[parameter].type);
    if (!object || (objects[parameter] != kOpen && objects[parameter] != *object)) return false;
    objects[parameter] = *object;
  }
  return true;
}

// A parameter that is not seen has a value if only one fits.
bool complete(const Model& model, const model::State& state, std::vector<Index>& objects) {
  for (Index parameter = 0; parameter < objects.size(); ++parameter) {
    if (objects[parameter] != kOpen) continue;
    Index found = kOpen;
    for (Index i = 0; i < model.objects.size(); ++i) {
      if (model.objects[i].type != state.parameters[parameter].type) continue;
      if (found != kOpen) return false;
      found = i;
    }
    if (found == kOpen) return false;
    objects[parameter] = found;
  }
  return true;
}

std::optional<Pattern> state_of(const Model& model, Index component, const std::string& timeline,
                                const temporal::Value& value) {
  const auto& states = model.components[component].states;
  for (Index s = 0; s < states.size(); ++s) {
    if (!states[s].observed || states[s].observed->timeline != timeline) continue;
    std::vector<Index> objects(states[s].parameters.size(), kOpen);
    if (!matches(model, states[s], value, objects) || !complete(model, states[s], objects)) continue;
    Pattern out{component, s, {}};
    for (const Index object : objects) out.terms.push_back({object, true});
    return out;
  }
  return std::nullopt;
}

// The state of the component of this name, as the value says it.
std::optional<Pattern> own_state(const Model& model, Index component, const temporal::Value& value) {
  const auto* wanted = std::get_if<temporal::State>(&value);
  if (wanted == nullptr) return std::nullopt;
  const auto& states = model.components[component].states;
  for (Index s = 0; s < states.size(); ++s) {
    if (states[s].name != wanted->name || states[s].parameters.size() != wanted->arguments.size()) continue;
    Pattern out{component, s, {}};
    for (std::size_t i = 0; i < wanted->arguments.size(); ++i) {
      const auto object = object_named(model, wanted->arguments[i], states[s].parameters[i].type);
      if (!object) return std::nullopt;
      out.terms.push_back({*object, true});
    }
    return out;
  }
  return std::nullopt;
}

std::optional<Pattern> goal_state(const Model& model, const temporal::ConditionNode& node) {
  for (Index c = 0; c < model.components.size(); ++c)
    if (model.components[c].name == node.timeline) return own_state(model, c, node.operand);
  for (Index c = 0; c < model.components.size(); ++c)
    if (const auto found = state_of(model, c, node.timeline, node.operand)) return found;
  return std::nullopt;
}

void put_objects(const Request& request, Model& model) {
  for (const engine::Object& object : request.objects) {
    const auto type = std::ranges::find(model.types, object.type);
    const bool known =
        std::ranges::find(model.objects, object.name, &model::Object::name) != model.objects.end();
    if (type != model.types.end() && !known)
      model.objects.push_back({object.name, static_cast<Index>(type - model.types.begin())});
  }
}

// The objects that stand behind the relation's name in a timeline's: "way.w2.w3" of "way";
// nothing: it is another timeline.
std::optional<std::vector<Index>> row_of(const Model& model, const model::Relation& relation,
                                         const std::string& timeline) {
  if (!timeline.starts_with(relation.timeline + ".")) return std::nullopt;
  std::vector<Index> row;
  std::size_t from = relation.timeline.size() + 1;
  for (const Index type : relation.types) {
    if (from > timeline.size()) return std::nullopt;
    const std::size_t to =
        row.size() + 1 == relation.types.size() ? timeline.size() : timeline.find('.', from);
    if (to == std::string::npos) return std::nullopt;
    const auto object = object_named(model, timeline.substr(from, to - from), type);
    if (!object) return std::nullopt;
    row.push_back(*object);
    from = to + 1;
  }
  return row;
}

void put_relations(const Request& request, Model& model) {
  for (model::Relation& relation : model.relations) {
    if (relation.timeline.empty()) continue;
    for (const auto& [timeline, value] : request.state) {
      const auto* seen = std::get_if<temporal::State>(&value);
      if (seen == nullptr || seen->name != relation.value) continue;
      if (auto row = row_of(model, relation, timeline)) relation.rows.push_back(std::move(*row));
    }
    std::ranges::sort(relation.rows);
    const auto doubled = std::ranges::unique(relation.rows);
    relation.rows.erase(doubled.begin(), doubled.end());
  }
}

void put_states(const Request& request, Model& model, std::vector<Misfit>& misfits) {
  for (Index c = 0; c < model.components.size(); ++c) {
    const Observation observation = observed_state(request, model, c);
    if (observation.state) model.problem->initial[c] = *observation.state;
    if (observation.state || (observation.seen.empty() && model.problem->initial[c])) continue;
    misfits.push_back(
        {"", "it is not known in which state '" + model.components[c].name + "' is" +
                 (observation.seen.empty()
                      ? std::string(
                            ": no timeline of it was observed; say 'observed' of its states, or its state "
                            "under 'initial'")
                      : ": " + observation.seen + " is no value of its states; say 'observed' of one")});
  }
}

bool is_observed_by(const model::Component& component, const std::string& timeline) {
  return std::ranges::any_of(component.states, [&](const model::State& state) {
    return state.observed && state.observed->timeline == timeline;
  });
}

// What the request knows of the timeline to come takes the place of what the model's problem says.
void put_predictions(const Request& request, Model& model, Index c, std::vector<Misfit>& misfits) {
  const model::Component& component = model.components[c];
  const auto is_observed = [](const model::State& state) { return state.observed.has_value(); };
  if (std::ranges::none_of(component.states, is_observed)) return;  // its times count from the origin
  std::vector<const engine::PredictedValue*> ahead;
  for (const engine::PredictedValue& one : request.predictions)
    if (is_observed_by(component, one.timeline) && one.at > request.origin &&
        one.at - request.origin < model.problem->horizon)
      ahead.push_back(&one);
  std::ranges::stable_sort(ahead, {}, [](const auto* one) { return one->at; });
  std::vector<model::PredictedState>& values = *model.problem->predicted[c];
  values.clear();
  std::optional<Pattern> holds = model.problem->initial[c];
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    const engine::PredictedValue* one = ahead[i];
    if (i + 1 < ahead.size() && ahead[i + 1]->at == one->at)
      continue;  // a window that opens as another closes
    const auto state = state_of(model, c, one->timeline, one->value);
    if (!state)
      return misfits.push_back({"", "'" + one->timeline + " = " + temporal::to_text(one->value) +
                                        "' is predicted, and is no value of the states of '" +
                                        component.name + "'; say 'observed' of one"});
    if (holds == state) continue;
    if (values.size() == model::kMostPredicted)
      return misfits.push_back({"", "more than " + std::to_string(model::kMostPredicted) + " changes of '" +
                                        component.name +
                                        "' are predicted before the horizon; set 'horizon_s' earlier"});
    values.push_back({one->at - request.origin, *state});
    holds = state;
  }
}

Duration from_origin(const Request& request, temporal::Time time) {
  return temporal::bounded(time) ? std::max(Duration{0}, time - request.origin) : time;
}

void put_goal(const Request& request, const engine::Goal& goal, Model& model, std::vector<Misfit>& misfits) {
  if (goal.closes < request.origin) return misfits.push_back({goal.key(), "its window has closed"});
  bool any = false;
  for (const temporal::ConditionNode& node : goal.achieved.nodes) {
    if (node.op == ConditionOp::all_of) continue;
    const auto state = node.op == ConditionOp::eq ? goal_state(model, node) : std::nullopt;
    if (!state)
      return misfits.push_back(
          {goal.key(), "'" + temporal::describe(goal.achieved) +
                           "' is no state of a component of the model; ask for 'TIMELINE = STATE', where "
                           "the timeline is a component's or one by which its states are observed"});
    const Duration opens = from_origin(request, goal.opens);
    model.problem->goals.push_back({goal.key(), *state, opens, from_origin(request, goal.closes), {}, opens});
    any = true;
  }
  if (!any) misfits.push_back({goal.key(), "it asks for nothing; name a state"});
}

}  // namespace

std::optional<Model> read_model(const Request& request, mission::Findings& findings) {
  std::vector<reading::Text> texts{{"model", request.model}};
  if (!request.problem_text.empty()) texts.push_back({"problem", request.problem_text});
  return reading::parse_model(texts, findings, reading::Problem::of_a_request);
}

Observation observed_state(const Request& request, const Model& model, Index component) {
  Observation out;
  for (const model::State& state : model.components[component].states) {
    if (!state.observed || out.state) continue;
    const auto value = request.state.find(state.observed->timeline);
    if (value == request.state.end()) continue;
    out.seen = value->first + " = " + temporal::to_text(value->second);
    out.state = state_of(model, component, value->first, value->second);
  }
  return out;
}

std::vector<Misfit> put_request(const Request& request, Model& model) {
  std::vector<Misfit> misfits;
  put_objects(request, model);
  put_relations(request, model);
  if (!model.problem) {
    model.problem.emplace();
    model.problem->horizon = kDay;
    model.problem->initial.resize(model.components.size());
  }
  model.problem->goals.clear();
  put_states(request, model, misfits);
  for (Index c = 0; c < model.problem->predicted.size(); ++c)
    if (model.problem->predicted[c]) put_predictions(request, model, c, misfits);
  for (const engine::Goal& goal : request.goals) put_goal(request, goal, model, misfits);
  return misfits;
}

}  // namespace roci::planner::timeline_htn::request
