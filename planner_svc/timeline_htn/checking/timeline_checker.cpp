#include "planner_svc/timeline_htn/checking/timeline_checker.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <string_view>

#include "planner_svc/timeline_htn/checking/check.hpp"
#include "planner_svc/timeline_htn/checking/owners_values.hpp"
#include "planner_svc/timeline_htn/model/check.hpp"
#include "planner_svc/timeline_htn/reading/load.hpp"

namespace roci::planner::timeline_htn::checking {

using model::Index, model::Model;

namespace {

using Names = std::map<std::string_view, Index>;

std::optional<Index> object_named(const Model& model, const std::string& name, Index type) {
  for (Index i = 0; i < model.objects.size(); ++i)
    if (model.objects[i].type == type && model.objects[i].name == name) return i;
  return std::nullopt;
}

std::optional<Index> first_object(const Model& model, Index type) {
  for (Index i = 0; i < model.objects.size(); ++i)
    if (model.objects[i].type == type) return i;
  return std::nullopt;
}

// The state with these arguments for the parameters that `terms` names. A parameter that is not among them may be
// any object of its type: it is the first.
std::optional<model::Pattern> state_with(const Model& model, Index component, Index state,
                                         const std::vector<model::Term>& terms,
                                         const std::vector<std::string>& arguments) {
  if (terms.size() != arguments.size()) return std::nullopt;
  const auto& parameters = model.components[component].states[state].parameters;
  std::vector<std::optional<Index>> objects(parameters.size());
  for (std::size_t i = 0; i < terms.size(); ++i) {
    std::optional<Index>& known = objects[terms[i].index];
    const auto object = object_named(model, arguments[i], parameters[terms[i].index].type);
    if (!object || (known && *known != *object)) return std::nullopt;
    known = object;
  }
  model::Pattern out{component, state, {}};
  for (Index i = 0; i < objects.size(); ++i) {
    const auto object = objects[i] ? objects[i] : first_object(model, parameters[i].type);
    if (!object) return std::nullopt;
    out.terms.push_back({*object, true});
  }
  return out;
}

// The first state of a component that is seen as this value of this timeline.
std::optional<model::Pattern> seen_as(const Model& model, Index component, const std::string& timeline,
                                      const temporal::Value& value) {
  const auto& states = model.components[component].states;
  const auto* seen = std::get_if<temporal::State>(&value);
  for (Index s = 0; s < states.size(); ++s) {
    if (!states[s].observed || states[s].observed->timeline != timeline) continue;
    const model::Observed& observed = *states[s].observed;
    if (observed.word != (seen ? seen->name : temporal::to_text(value))) continue;
    if (auto out = state_with(model, component, s, observed.terms,
                              seen ? seen->arguments : std::vector<std::string>{}))
      return out;
  }
  return std::nullopt;
}

void put_states(const engine::Request& request, Model& model, std::vector<std::string>& out) {
  for (Index c = 0; c < model.components.size(); ++c) {
    std::optional<model::Pattern> seen;
    for (const model::State& state : model.components[c].states) {
      if (seen || !state.observed) continue;
      const auto value = request.state.find(state.observed->timeline);
      if (value != request.state.end()) seen = seen_as(model, c, value->first, value->second);
    }
    if (seen) model.problem->initial[c] = seen;
    if (!seen && !model.problem->initial[c])
      out.push_back("neither the request nor the model says in which state '" + model.components[c].name +
                    "' begins");
  }
}

// The state that a comparison asks for: of the component of that name, else one that shows so.
std::optional<model::Pattern> asked_for(const Model& model, const temporal::ConditionNode& node) {
  if (node.op != temporal::ConditionOp::eq) return std::nullopt;
  const auto* wanted = std::get_if<temporal::State>(&node.operand);
  for (Index c = 0; c < model.components.size() && wanted != nullptr; ++c) {
    if (model.components[c].name != node.timeline) continue;
    const auto& states = model.components[c].states;
    for (Index s = 0; s < states.size(); ++s) {
      std::vector<model::Term> terms;
      for (Index i = 0; i < states[s].parameters.size(); ++i) terms.push_back({i, false});
      if (states[s].name != wanted->name) continue;
      if (auto out = state_with(model, c, s, terms, wanted->arguments)) return out;
    }
  }
  for (Index c = 0; c < model.components.size(); ++c)
    if (auto out = seen_as(model, c, node.timeline, node.operand)) return out;
  return std::nullopt;
}

// Adds each row of objects of these types whose names, with dots between, are the text. A name may itself have dots.
void add_rows(const Model& model, const Names& names, std::span<const Index> types, std::string_view text,
              std::vector<Index>& row, std::vector<std::vector<Index>>& out) {
  for (std::size_t end = text.find('.');; end = text.find('.', end + 1)) {
    const bool last = end == std::string_view::npos;
    const auto object = names.find(text.substr(0, end));
    if (object != names.end() && model.objects[object->second].type == types.front() &&
        last == (types.size() == 1)) {
      row.push_back(object->second);
      if (last)
        out.push_back(row);
      else
        add_rows(model, names, types.subspan(1), text.substr(end + 1), row, out);
      row.pop_back();
    }
    if (last) return;
  }
}

void put_relations(const engine::Request& request, Model& model) {
  Names names;
  for (Index i = 0; i < model.objects.size(); ++i) names.emplace(model.objects[i].name, i);
  for (model::Relation& relation : model.relations) {
    if (relation.timeline.empty()) continue;
    const std::string front = relation.timeline + ".";
    std::vector<Index> row;
    for (auto seen = request.state.lower_bound(front);
         seen != request.state.end() && seen->first.starts_with(front); ++seen) {
      const auto* state = std::get_if<temporal::State>(&seen->second);
      if (state && state->name == relation.value)
        add_rows(model, names, relation.types, std::string_view(seen->first).substr(front.size()), row,
                 relation.rows);
    }
    std::ranges::sort(relation.rows);
    const auto doubled = std::ranges::unique(relation.rows);
    relation.rows.erase(doubled.begin(), doubled.end());
  }
}

// Walks the predictions of the request, as it stands in order of time or not, and keeps what changes the state.
void put_predicted(const engine::Request& request, Model& model, std::vector<std::string>& out) {
  for (Index c = 0; c < model.problem->predicted.size(); ++c) {
    const auto& states = model.components[c].states;
    const auto shows = [&](const std::string& timeline) {
      return std::ranges::any_of(states, [&](const model::State& state) {
        return state.observed && state.observed->timeline == timeline;
      });
    };
    const bool observed =
        std::ranges::any_of(states, [](const model::State& state) { return state.observed.has_value(); });
    if (!model.problem->predicted[c] || !observed) continue;
    std::multimap<temporal::Time, const engine::PredictedValue*> ahead;
    for (const engine::PredictedValue& one : request.predictions)
      if (one.at > request.origin && shows(one.timeline)) ahead.emplace(one.at, &one);
    auto& values = *model.problem->predicted[c];
    values.clear();
    for (auto entry = ahead.begin(); entry != ahead.end(); ++entry) {
      const auto& [at, one] = *entry;
      if (std::next(entry) != ahead.end() && std::next(entry)->first == at) continue;  // the last one counts
      const model::Pattern* before = !values.empty()             ? &values.back().state
                                     : model.problem->initial[c] ? &*model.problem->initial[c]
                                                                 : nullptr;
      const auto state = seen_as(model, c, one->timeline, one->value);
      if (!state)
        out.push_back(one->timeline + " = " + temporal::to_text(one->value) +
                      " is predicted, and is no state of '" + model.components[c].name + "'");
      else if (before == nullptr || *state != *before)
        values.push_back({at - request.origin, *state});
    }
  }
}

void put_goals(const engine::Request& request, Model& model, std::vector<std::string>& out) {
  const auto since_origin = [&](temporal::Time time) {
    return temporal::bounded(time) ? std::max(temporal::Duration{0}, time - request.origin) : time;
  };
  model.problem->goals.clear();
  for (const engine::Goal& goal : request.goals)
    for (const temporal::ConditionNode& node : goal.achieved.nodes) {
      if (node.op == temporal::ConditionOp::all_of) continue;
      const auto state = asked_for(model, node);
      if (state)
        model.problem->goals.push_back({goal.key(),
                                        *state,
                                        since_origin(goal.opens),
                                        since_origin(goal.closes),
                                        {},
                                        since_origin(goal.opens)});
      else
        out.push_back("goal '" + goal.key() + "' asks for no state of the model");
    }
}

}  // namespace

std::optional<Model> model_of(const engine::Request& request, std::vector<std::string>& out,
                              std::span<const engine::FunctionUse> values) {
  std::vector<reading::Text> texts{{"model", request.model}};
  if (!request.problem_text.empty()) texts.push_back({"problem", request.problem_text});
  mission::Findings findings;
  auto model = reading::parse_model(texts, findings, reading::Problem::of_a_request);
  if (!model) {
    out.push_back(reading::errors_of(findings));
    return std::nullopt;
  }
  for (const engine::Object& object : request.objects) {
    const auto type = std::ranges::find(model->types, object.type);
    if (type != model->types.end() &&
        std::ranges::find(model->objects, object.name, &model::Object::name) == model->objects.end())
      model->objects.push_back({object.name, static_cast<Index>(type - model->types.begin())});
  }
  if (!model->problem) {
    model->problem.emplace().horizon = temporal::seconds(86400);
    model->problem->initial.resize(model->components.size());
  }
  put_relations(request, *model);
  put_values(values, *model);
  put_states(request, *model, out);
  put_predicted(request, *model, out);
  put_goals(request, *model, out);
  if (out.empty())
    for (const model::Fault& fault : model::check(*model))
      if (!fault.warning) out.push_back(fault.what + "; " + fault.remedy);
  return out.empty() ? model : std::nullopt;
}

std::vector<std::string> TimelineChecker::faults(const engine::CheckedPlan& checked) const {
  std::vector<std::string> out;
  const auto model = model_of(checked.request, out, checked.values);
  if (!model) return out;
  out = checking::faults(*model, checked.plan);
  if (out.empty()) check_values(*model, checked.plan, checked.values, out);
  return out;
}

}  // namespace roci::planner::timeline_htn::checking
