#include "planner_svc/timeline_htn/model/bounds.hpp"
#include "planner_svc/timeline_htn/reading/sections.hpp"

namespace roci::planner::timeline_htn::reading {

using mission::Entry;
using model::Index, model::Part;

namespace {

temporal::Duration seconds(const Entry& entry) {
  if (entry.text() == "none") return temporal::no_bound;
  const double number = entry.number();
  if (number < 0 || number > temporal::to_seconds(model::kLongestDuration))
    entry.fail("expected seconds from the origin on, at most 31 years");
  return temporal::seconds(number);
}

void read_goal(const Entry& entry, model::Goal& goal, const Names& names, Vocabulary& vocabulary) {
  Entry state = entry;
  if (entry.is_mapping()) {
    entry.allow_only({"state", "window_s", "release_s", "after"});
    state = entry.at("state");
    if (const auto window = entry.find("window_s")) {
      const auto both = window->items();
      if (both.size() != 2) window->fail("expected [opens, closes]");
      goal.opens = seconds(both[0]);
      goal.closes = seconds(both[1]);
      if (goal.opens == temporal::no_bound) both[0].fail("a window opens at some time; write 0");
    }
    if (const auto release = entry.find("release_s")) {
      goal.release = seconds(*release);
      if (goal.release == temporal::no_bound)
        release->fail("a goal is released at some time; write its seconds");
    }
    if (const auto after = entry.find("after"))
      for (const Entry& one : one_or_more(*after, model::kMostGoals))
        goal.after.push_back(names.index(one.text(), one));
  }
  Line line(state);
  Scope none;
  goal.state = vocabulary.pattern(line, none);
  line.expect_end();
}

// Values of a timeline that are known beforehand, in order of time.
void read_predicted(const Entry& list, Index component, model::Problem& problem, Vocabulary& vocabulary) {
  const model::Component& of = vocabulary.model.components[component];
  auto& values = problem.predicted[component].emplace();
  for (const model::Behaviour& behaviour : vocabulary.model.behaviours)
    for (const model::Subgoal& subgoal : behaviour.subgoals)
      if (subgoal.state.component == component)
        list.fail("behaviour '" + behaviour.name + "' sets '" + of.name + "' by its subgoal '" +
                  subgoal.name +
                  "', and a plan changes nothing that is predicted; write a condition or a need instead");
  for (const Entry& one : items(list, model::kMostPredicted)) {
    one.attempt([&] {
      one.allow_only({"at_s", "state"});
      const Entry at = one.at("at_s");
      const Entry state = one.at("state");
      model::PredictedState value{seconds(at), {}};
      if (value.at == temporal::no_bound || value.at == temporal::Duration{0})
        at.fail("a predicted state comes at some time behind the origin; 'initial' says what holds there");
      if (!values.empty() && value.at == values.back().at)
        at.fail("two states of '" + of.name + "' are predicted for one time; keep one");
      if (!values.empty() && value.at < values.back().at)
        at.fail("predicted states stand in order of time; put this one before that at " +
                temporal::to_text(values.back().at));
      Line line(state);
      Scope none;
      value.state = vocabulary.pattern_of(component, line, none);
      line.expect_end();
      const model::State& held = of.states[value.state.state];
      if (held.kind != model::StateKind::resting || !held.needs.empty())
        state.fail("'" + held.name + "' is " +
                   (held.needs.empty() ? std::string("a state of kind ") + model::to_text(held.kind)
                                       : std::string("a state with needs")) +
                   "; only default states without needs can be predicted");
      const auto& before = values.empty() ? problem.initial[component] : std::optional(values.back().state);
      if (before && *before == value.state)
        state.fail("it is in this state already; leave one out, or name what comes between");
      values.push_back(std::move(value));
    });
  }
}

}  // namespace

void read_problem(const Entry& section, Vocabulary& vocabulary, Places& places) {
  section.allow_only({"horizon_s", "goals_changed", "initial", "predicted", "goals"});
  if (vocabulary.model.problem) section.fail("there is a problem already; keep one");
  places[{Part::problem, 0, 0}] = section.place();
  model::Problem& problem = vocabulary.model.problem.emplace();
  problem.initial.resize(vocabulary.model.components.size());
  const Entry horizon = section.at("horizon_s");
  problem.horizon = seconds(horizon);
  if (problem.horizon == temporal::no_bound) horizon.fail("a plan ends at some time; write its seconds");
  problem.goals_changed = section.truth_or("goals_changed", false);
  if (const auto initial = section.find("initial")) {
    initial->each_field([&](const std::string& name, const Entry& state) {
      const Index component = vocabulary.components.index(name, state);
      if (problem.initial[component]) state.fail("the state of '" + name + "' stands twice; keep one");
      Line line(state);
      Scope none;
      problem.initial[component] = vocabulary.pattern_of(component, line, none);
      line.expect_end();
    });
  }
  if (const auto predicted = section.find("predicted")) {
    problem.predicted.resize(vocabulary.model.components.size());
    predicted->each_field([&](const std::string& name, const Entry& list) {
      const Index component = vocabulary.components.index(name, list);
      places[{Part::prediction, component, 0}] = list.place();
      read_predicted(list, component, problem, vocabulary);
    });
  }
  const auto goals = section.find("goals");
  if (!goals) return;
  const auto all = fields(*goals, model::kMostGoals);
  Names names("goal");
  for (const auto& [name, value] : all)
    value.attempt([&, &name = name, &value = value] { names.add(name, value); });
  for (const auto& [name, value] : all) {
    places[{Part::goal, static_cast<Index>(problem.goals.size()), 0}] = value.place();
    model::Goal& goal = problem.goals.emplace_back();
    goal.id = name;
    value.attempt([&, &value = value] { read_goal(value, goal, names, vocabulary); });
  }
}

}  // namespace roci::planner::timeline_htn::reading
