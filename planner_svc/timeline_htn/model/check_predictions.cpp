#include <algorithm>
#include <optional>
#include <span>

#include "planner_svc/timeline_htn/model/complaints.hpp"
#include "planner_svc/timeline_htn/model/evaluate.hpp"

namespace roci::planner::timeline_htn::model {

namespace {

// Gives the variables among the terms their objects; false where one has another already.
bool match(const std::vector<Term>& terms, const Pattern& state, std::vector<std::optional<Index>>& bound) {
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Index object = state.terms[i].index;
    std::optional<Index>& own = bound[terms[i].object ? bound.size() - 1 : terms[i].index];
    if (terms[i].object ? terms[i].index != object : own.value_or(object) != object) return false;
    if (!terms[i].object) own = object;
  }
  return true;
}

bool follows(const Component& component, const Pattern& before, const Pattern& after) {
  return std::ranges::any_of(component.transitions, [&](const Transition& one) {
    std::vector<std::optional<Index>> bound(one.variables.size() + 1);
    return one.from == before.state && one.to == after.state && match(one.from_terms, before, bound) &&
           match(one.to_terms, after, bound);
  });
}

/// Is a state with the objects that its terms are.
struct Held {
  Held(const Model& model, const Pattern& pattern)
      : state(model.components[pattern.component].states[pattern.state]), text(to_text(model, pattern, {})) {
    for (const Term& term : pattern.terms) objects.push_back(term.index);
    bounds = model::bounds(model, state, objects);
    exists = bounds &&
             std::ranges::all_of(state.where, [&](const Test& test) { return holds(model, test, objects); });
  }
  const State& state;
  std::string text;
  std::vector<Index> objects;
  std::optional<Bounds> bounds;
  bool exists = false;
};

void check_values(Complaints& complaints, Index c) {
  const Model& model = complaints.model;
  const Problem& problem = *model.problem;
  temporal::Duration since{0};
  const Pattern* before = &*problem.initial[c];
  const std::vector<PredictedState>& values = *problem.predicted[c];
  for (std::size_t i = 0; i <= values.size(); ++i) {
    const Held held(model, *before);
    const bool last = i == values.size() || values[i].at >= problem.horizon;
    const temporal::Duration until = last ? problem.horizon : values[i].at;
    if (i == 0 && held.state.kind != StateKind::resting)
      complaints.error("'" + model.components[c].name + "' is predicted, and begins in " + held.text +
                           ", which is no default state",
                       "name a default state under 'initial'");
    if (i > 0 && !held.exists)
      complaints.error(
          "there is no state " + held.text + ": what its 'where' or its duration says does not hold",
          "name other objects, or mend the tables");
    if (i > 0 && held.exists && until - since < held.bounds->shortest)
      complaints.error(held.text + " is predicted for " + temporal::to_text(until - since) + ", and lasts " +
                           temporal::to_text(held.bounds->shortest) + " at least",
                       "mend the times, or 'duration_s'");
    if (last) break;
    if (!follows(model.components[c], *before, values[i].state))
      complaints.error("no transition leads from " + held.text + " to " +
                           to_text(model, values[i].state, {}) + ", which is predicted behind it",
                       "add the transition, or mend the predicted states");
    since = values[i].at;
    before = &values[i].state;
  }
}

}  // namespace

void check_predictions(Complaints& complaints) {
  const Model& model = complaints.model;
  const Problem& problem = *model.problem;
  for (Index c = 0; c < model.components.size(); ++c) {
    if (!is_predicted(model, c)) continue;
    complaints.about(Part::prediction, c);
    for (const Behaviour& behaviour : model.behaviours)
      for (const Subgoal& subgoal : behaviour.subgoals)
        if (subgoal.state.component == c)
          complaints.error(
              "'" + model.components[c].name + "' is predicted, and behaviour '" + behaviour.name +
                  "' sets it by its subgoal '" + subgoal.name + "'",
              "a plan changes nothing that is predicted; write a condition, or a need of a state");
    if (problem.initial[c]) check_values(complaints, c);
  }
  for (Index g = 0; g < problem.goals.size(); ++g) {
    complaints.about(Part::goal, g);
    if (is_predicted(model, problem.goals[g].state.component))
      complaints.error("it asks for a state of '" + model.components[problem.goals[g].state.component].name +
                           "', which is predicted",
                       "a plan changes nothing that is predicted; ask for something else");
  }
}

}  // namespace roci::planner::timeline_htn::model
