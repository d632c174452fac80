#include "planner_svc/timeline_htn/model/check.hpp"

#include <algorithm>
#include <set>

#include "planner_svc/timeline_htn/model/complaints.hpp"
#include "planner_svc/timeline_htn/model/evaluate.hpp"

namespace roci::planner::timeline_htn::model {

namespace {

bool achieved_by_some(const Model& model, Index component, Index state) {
  return std::ranges::any_of(model.behaviours, [&](const Behaviour& behaviour) {
    return behaviour.achieves && behaviour.achieves->component == component &&
           behaviour.achieves->state == state;
  });
}

bool triggers_some(const Model& model, Index component, Index state) {
  return std::ranges::any_of(model.behaviours, [&](const Behaviour& behaviour) {
    return std::ranges::any_of(behaviour.triggers, [&](const Pattern& pattern) {
      return pattern.component == component && pattern.state == state;
    });
  });
}

void check_state(Complaints& complaints, Index component_index, Index index) {
  const Model& model = complaints.model;
  const Component& component = model.components[component_index];
  const State& state = component.states[index];
  const bool left = std::ranges::any_of(
      component.transitions, [&](const Transition& transition) { return transition.from == index; });
  if ((state.kind == StateKind::complex || state.kind == StateKind::simple) && !left)
    complaints.error("nothing can follow it, and it is none to rest in",
                     "add a transition from it, e.g. to a state of kind default");
  if (state.kind == StateKind::error && !left && !triggers_some(model, component_index, index))
    complaints.warning("nothing leads out of it", "add a transition, or a behaviour that it triggers");
  if (state.kind == StateKind::complex && !achieved_by_some(model, component_index, index))
    complaints.error("no behaviour achieves it", "add one, or make it a simple state");
  if (state.command && component.layer == Layer::abstract)
    complaints.error("it has a command, and its component is abstract",
                     "give the command to a state of a primitive component");
  const std::vector<Index> nothing;
  const auto constant = [](const Expression& expression) {
    return std::ranges::none_of(expression, [](const ExpressionNode& n) { return n.op == Operator::table; });
  };
  if (constant(state.shortest) && constant(state.longest) && !bounds(model, state, nothing))
    complaints.error("its duration is negative, above 31 years, or its longest is below its shortest",
                     "mend the bounds");
}

void check_components(Complaints& complaints) {
  const Model& model = complaints.model;
  for (Index i = 0; i < model.components.size(); ++i) {
    const Component& component = model.components[i];
    complaints.about(Part::component, i);
    if (std::ranges::none_of(component.states,
                             [](const State& state) { return state.kind == StateKind::resting; }))
      complaints.error("it has no state to rest in", "make one of its states of kind default");
    for (Index s = 0; s < component.states.size(); ++s) {
      complaints.about(Part::state, i, s);
      check_state(complaints, i, s);
    }
  }
}

void check_decision(Complaints& complaints, const Behaviour& behaviour, const Decision& decision,
                    std::set<Index>& chosen) {
  const Model& model = complaints.model;
  if (decision.over && behaviour.achieves &&
      std::ranges::find(behaviour.achieves->terms, Term{*decision.variable, false}) !=
          behaviour.achieves->terms.end())
    complaints.error("decision '" + decision.name + "' is over '" +
                         behaviour.variables[*decision.variable].name + "', which it achieves",
                     "name a variable of its own");
  for (const Index index : decision.subgoals) {
    const Subgoal& subgoal = behaviour.subgoals[index];
    if (!chosen.insert(index).second)
      complaints.error("subgoal '" + subgoal.name + "' stands in two choices",
                       "give each choice subgoals of its own");
    const State& state = model.components[subgoal.state.component].states[subgoal.state.state];
    if (state.kind != StateKind::simple ||
        std::ranges::find(subgoal.state.terms, Term{*decision.variable, false}) == subgoal.state.terms.end())
      complaints.error("subgoal '" + subgoal.name + "' of decision '" + decision.name +
                           "' is not simple, or is the same whatever is decided",
                       "name a simple state of the variable; the plan is made anew behind it");
  }
  for (std::size_t c = 0; c < decision.choices.size(); ++c) {
    for (const Index index : decision.choices[c].subgoals) {
      const Subgoal& subgoal = behaviour.subgoals[index];
      if (!chosen.insert(index).second)
        complaints.error("subgoal '" + subgoal.name + "' stands in two choices",
                         "give each choice subgoals of its own");
      const State& state = model.components[subgoal.state.component].states[subgoal.state.state];
      if (c > 0 && state.kind != StateKind::simple)
        complaints.error("subgoal '" + subgoal.name + "' of choice '" + decision.choices[c].name +
                             "' is not simple; only the first choice of a decision is planned on",
                         "make it a simple state, or let a new plan come of that choice");
    }
  }
}

void check_behaviours(Complaints& complaints) {
  const Model& model = complaints.model;
  for (Index i = 0; i < model.behaviours.size(); ++i) {
    const Behaviour& behaviour = model.behaviours[i];
    complaints.about(Part::behaviour, i);
    if (!behaviour.achieves && behaviour.triggers.empty() && !behaviour.on_goal_change)
      complaints.error("it achieves nothing and nothing triggers it", "add 'achieves' or 'triggers'");
    std::set<Index> chosen;
    for (const Decision& decision : behaviour.decisions)
      check_decision(complaints, behaviour, decision, chosen);
    for (const Subgoal& subgoal : behaviour.subgoals) {
      const State& state = model.components[subgoal.state.component].states[subgoal.state.state];
      if (state.kind == StateKind::error)
        complaints.error("its subgoal '" + subgoal.name + "' is an error state",
                         "an error state is never planned for; name another one");
      if (behaviour.achieves && subgoal.state.component == behaviour.achieves->component &&
          state.kind != StateKind::complex)
        complaints.error("its subgoal '" + subgoal.name +
                             "' is a state of the very component that it stands on, '" +
                             model.components[subgoal.state.component].name +
                             "', and only complex states stand within another one",
                         "give the subgoal a component of its own");
    }
  }
  check_recursion(complaints);
  check_time(complaints);
}

// Of a state whose numbers nobody was asked for yet nothing is said.
bool exists(const Model& model, const Pattern& pattern) {
  std::vector<Index> objects;
  for (const Term& term : pattern.terms) objects.push_back(term.index);
  const State& state = model.components[pattern.component].states[pattern.state];
  std::set<AskedNumber> asked;
  add_asked(model, state, objects, asked);
  const auto open = [&](const AskedNumber& one) { return !model.numbers[one.table].asked->given; };
  if (std::ranges::any_of(asked, open)) return true;
  return bounds(model, state, objects) &&
         std::ranges::all_of(state.where, [&](const Test& test) { return holds(model, test, objects); });
}

bool comes_after_itself(const Problem& problem, Index goal) {
  std::vector<Index> open = problem.goals[goal].after;
  std::set<Index> seen(open.begin(), open.end());
  while (!open.empty()) {
    const Index before = open.back();
    open.pop_back();
    if (before == goal) return true;
    for (const Index next : problem.goals[before].after)
      if (seen.insert(next).second) open.push_back(next);
  }
  return false;
}

void check_goal(Complaints& complaints, const Problem& problem, Index index) {
  const Model& model = complaints.model;
  const Goal& goal = problem.goals[index];
  const State& state = model.components[goal.state.component].states[goal.state.state];
  if (state.kind == StateKind::error) complaints.error("it asks for an error state", "ask for another state");
  if (!exists(model, goal.state))
    complaints.error("there is no state " + to_text(model, goal.state, {}) +
                         ": what its 'where' or its duration says does not hold",
                     "name other objects, or mend the tables");
  if (goal.closes < goal.opens)
    complaints.error("its window closes before it opens", "exchange the two times");
  if (goal.opens > problem.horizon)
    complaints.error("its window opens after the horizon, " + temporal::to_text(problem.horizon),
                     "set 'horizon_s' later");
  if (goal.opens <= goal.closes && goal.closes < goal.release)
    complaints.error("its window closes before 'release_s'",
                     "release it sooner, or let its window close later");
  if (goal.opens <= problem.horizon && goal.release > problem.horizon)
    complaints.error("it is released after the horizon, " + temporal::to_text(problem.horizon),
                     "set 'horizon_s' later");
  if (comes_after_itself(problem, index))
    complaints.error("it comes after itself", "take one goal out of 'after'");
}

void check_problem(Complaints& complaints) {
  const Model& model = complaints.model;
  if (!model.problem) return;
  const Problem& problem = *model.problem;
  for (Index i = 0; i < model.components.size(); ++i) {
    complaints.about(Part::problem, 0);
    if (i >= problem.initial.size() || !problem.initial[i]) {
      complaints.error("the problem does not say in which state '" + model.components[i].name + "' begins",
                       "add it under 'initial'");
      continue;
    }
    const State& state = model.components[i].states[problem.initial[i]->state];
    if (state.kind == StateKind::complex)
      complaints.error("'" + model.components[i].name + "' begins in a complex state, '" + state.name + "'",
                       "name a default, simple or error state");
    else if (!exists(model, *problem.initial[i]))
      complaints.error("there is no state " + to_text(model, *problem.initial[i], {}) +
                           ": what its 'where' or its duration says does not hold",
                       "name other objects, or mend the tables");
  }
  for (Index i = 0; i < problem.goals.size(); ++i) {
    complaints.about(Part::goal, i);
    check_goal(complaints, problem, i);
  }
  check_predictions(complaints);
}

}  // namespace

std::vector<Fault> check(const Model& model) {
  std::vector<Fault> out;
  Complaints complaints(model, out);
  check_components(complaints);
  check_behaviours(complaints);
  check_problem(complaints);
  return out;
}

bool usable(const std::vector<Fault>& faults) {
  return std::ranges::all_of(faults, [](const Fault& fault) { return fault.warning; });
}

}  // namespace roci::planner::timeline_htn::model
