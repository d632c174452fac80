#include "planner_svc/timeline_htn/checking/timeline_checker.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include "planner_svc/timeline_htn/checking/check.hpp"
#include "planner_svc/timeline_htn/checking/owners_values.hpp"
#include "planner_svc/timeline_htn/model/check.hpp"
#include "planner_svc/timeline_htn/reading/load.hpp"

namespace roci::planner::timeline_htn::checking {

using model::GroundState, model::Index, model::Model;

namespace {

// Calls `take` with each state of a component, until it returns true.
bool each_state(const Model& model, Index component, const std::function<bool(const GroundState&)>& take) {
  const auto& states = model.components[component].states;
  for (Index s = 0; s < states.size(); ++s) {
    GroundState state{component, s, {}};
    const std::function<bool()> next = [&] {
      if (state.objects.size() == states[s].parameters.size()) return take(state);
      for (Index object = 0; object < model.objects.size(); ++object) {
        if (model.objects[object].type != states[s].parameters[state.objects.size()].type) continue;
        state.objects.push_back(object);
        const bool taken = next();
        state.objects.pop_back();
        if (taken) return true;
      }
      return false;
    };
    if (next()) return true;
  }
  return false;
}

// "parked(wp1)", "true", "3"; as words, since all values have such a form.
std::string shown(const Model& model, const GroundState& state) {
  const model::Observed& observed = *model.components[state.component].states[state.state].observed;
  temporal::State out{observed.word, {}};
  for (const model::Term& term : observed.terms)
    out.arguments.push_back(model.objects[term.object ? term.index : state.objects[term.index]].name);
  return temporal::to_text(out);
}

bool shows_as(const Model& model, const GroundState& state, const std::string& timeline,
              const temporal::Value& value) {
  const auto& observed = model.components[state.component].states[state.state].observed;
  return observed && observed->timeline == timeline && shown(model, state) == temporal::to_text(value);
}

model::Pattern pattern_of(const GroundState& state) {
  model::Pattern out{state.component, state.state, {}};
  for (const Index object : state.objects) out.terms.push_back({object, true});
  return out;
}

void put_states(const engine::Request& request, Model& model, std::vector<std::string>& out) {
  for (Index c = 0; c < model.components.size(); ++c) {
    const bool seen = each_state(model, c, [&](const GroundState& state) {
      for (const auto& [timeline, value] : request.state)
        if (shows_as(model, state, timeline, value)) {
          model.problem->initial[c] = pattern_of(state);
          return true;
        }
      return false;
    });
    if (!seen && !model.problem->initial[c])
      out.push_back("neither the request nor the model says in which state '" + model.components[c].name +
                    "' begins");
  }
}

// The state that a comparison asks for: of the component of that name, else one that shows so.
std::optional<model::Pattern> asked_for(const Model& model, const temporal::ConditionNode& node) {
  std::optional<model::Pattern> out;
  if (node.op != temporal::ConditionOp::eq) return out;
  const auto take = [&](const GroundState& state) {
    out = pattern_of(state);
    return true;
  };
  for (Index c = 0; c < model.components.size() && !out; ++c)
    if (model.components[c].name == node.timeline)
      each_state(model, c, [&](const GroundState& state) {
        return model::value_of(model, state) == node.operand && take(state);
      });
  for (Index c = 0; c < model.components.size() && !out; ++c)
    each_state(model, c, [&](const GroundState& state) {
      return shows_as(model, state, node.timeline, node.operand) && take(state);
    });
  return out;
}

// Every row that a relation of the model could have is looked up by its timeline's name.
void put_relations(const engine::Request& request, Model& model) {
  for (model::Relation& relation : model.relations) {
    if (relation.timeline.empty()) continue;
    std::vector<std::pair<std::string, std::vector<Index>>> rows{{relation.timeline, {}}};
    for (const Index type : relation.types) {
      std::vector<std::pair<std::string, std::vector<Index>>> longer;
      for (const auto& [name, row] : rows)
        for (Index o = 0; o < model.objects.size(); ++o)
          if (model.objects[o].type == type) {
            longer.emplace_back(name + "." + model.objects[o].name, row);
            longer.back().second.push_back(o);
          }
      rows = std::move(longer);
    }
    for (const auto& [name, row] : rows) {
      const auto seen = request.state.find(name);
      if (seen == request.state.end() || std::ranges::find(relation.rows, row) != relation.rows.end())
        continue;
      const auto* state = std::get_if<temporal::State>(&seen->second);
      if (state && state->name == relation.value) relation.rows.push_back(row);
    }
    std::ranges::sort(relation.rows);
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
      std::optional<model::Pattern> state;
      each_state(model, c, [&](const GroundState& known) {
        if (!shows_as(model, known, one->timeline, one->value)) return false;
        state = pattern_of(known);
        return true;
      });
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
