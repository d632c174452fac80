#include "planner_svc/timeline_htn/adapter/timeline_resolver.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "core/temporal/network_distances.hpp"
#include "planner_svc/timeline_htn/adapter/asked_decision.hpp"
#include "planner_svc/timeline_htn/model/check.hpp"
#include "planner_svc/timeline_htn/reading/load.hpp"
#include "planner_svc/timeline_htn/request/asked_numbers.hpp"
#include "planner_svc/timeline_htn/request/problem_of.hpp"
#include "planner_svc/timeline_htn/search/search.hpp"

namespace roci::planner::timeline_htn::adapter {

using engine::OpenDecision;
using model::Index, model::Model, model::Pattern, model::StateKind;
using temporal::Duration;

namespace {

constexpr std::uint64_t kChoiceWork = 200'000;                 // steps for one choice
constexpr std::size_t kChoiceBytes = std::size_t{256} << 20U;  // of the plans that are tried for it

model::Model read(const OpenDecision& open) {
  mission::Findings findings;
  std::optional<Model> model = request::read_model(open.request, findings);
  if (!model) throw std::runtime_error(reading::errors_of(findings));
  engine::Request without_goals = open.request;
  without_goals.goals.clear();
  static_cast<void>(request::put_request(without_goals, *model));  // states follow
  request::put_recorded(open.plan.function_values, *model);
  return std::move(*model);
}

/// Tries choices and values against where the components are.
class Trial {
 public:
  Trial(const OpenDecision& open, Model model)
      : open_(open), model_(std::move(model)), ground_(model_), known_(model_.components.size(), true) {
    const auto asked = find_asked(ground_, open.plan, open.decision);
    if (!asked)
      throw std::runtime_error("decision " + open.decision.id +
                               " is of no behaviour of the model in the plan");
    asked_ = *asked;
    model_.problem->horizon =
        model_.problem->horizon - std::max(Duration{0}, open.request.origin - open.plan.origin);
    put_states();
  }

  std::optional<engine::Resolution> resolve() {
    const model::Behaviour& behaviour = asked_.of(model_);
    const model::Decision& decision = behaviour.decisions[asked_.decision];
    if (!all_known(decision)) return std::nullopt;
    if (decision.over) {
      for (const temporal::DecisionChoice& choice : open_.decision.choices) {
        const auto object = std::ranges::find(model_.objects, choice.name, &model::Object::name);
        const bool first = &choice == &open_.decision.choices.front();
        if (object != model_.objects.end() &&
            permits(*decision.variable, static_cast<Index>(object - model_.objects.begin())) &&
            possible(asked_.concerned,
                     bound(*decision.variable, static_cast<Index>(object - model_.objects.begin())),
                     first ? std::optional(behind_) : std::nullopt))
          return engine::Resolution{choice.name, ""};
      }
      return std::nullopt;
    }
    if (decision.variable) {
      for (const Index object : values(*decision.variable))
        if (possible(asked_.concerned, bound(*decision.variable, object), behind_))
          return engine::Resolution{"", model_.objects[object].name};
      return std::nullopt;
    }
    for (std::size_t c = 0; c < decision.choices.size(); ++c) {
      std::vector<bool> subgoals = asked_.concerned;
      if (c > 0) subgoals.assign(behaviour.subgoals.size(), false);
      for (const Index subgoal : decision.choices[c].subgoals) subgoals[subgoal] = true;
      if (possible(subgoals, asked_.objects, c == 0 ? behind_ : std::set<std::string>{}))
        return engine::Resolution{decision.choices[c].name, ""};
    }
    return std::nullopt;
  }

 private:
  // Where the components stand: as they are seen. What is not seen, or is a complex state that is under way,
  // is where the plan has it.
  void put_states() {
    const temporal::NetworkDistances network(open_.plan.point_count, temporal::all_constraints(open_.plan));
    for (Index c = 0; c < model_.components.size(); ++c) {
      const request::Observation seen = request::observed_state(open_.request, model_, c);
      const StateKind kind =
          seen.state ? model_.components[c].states[seen.state->state].kind : StateKind::complex;
      if (seen.state && kind != StateKind::complex) {
        model_.problem->initial[c] = *seen.state;
        known_[c] = kind != StateKind::simple;
        continue;
      }
      const bool can_be_seen = model_.components[c].layer == model::Layer::primitive &&
                               std::ranges::any_of(model_.components[c].states,
                                                   [](const model::State& one) { return !!one.observed; });
      known_[c] = seen.state || !can_be_seen;
      std::optional<Pattern> rests;
      for (const temporal::Token& token : open_.plan.tokens) {
        const auto state =
            token.timeline == model_.components[c].name ? resting(c, token.held) : std::nullopt;
        if (state && (!rests || network.implies(token.start_point, open_.decision.decide_before, Duration{0},
                                                temporal::no_bound)))
          rests = state;
      }
      if (rests) model_.problem->initial[c] = *rests;
    }
    for (const temporal::PlanActivity& activity : open_.plan.activities)
      if (network.implies(open_.decision.decide_before, activity.start_point, Duration{0},
                          temporal::no_bound))
        behind_.insert(activity.name);
  }

  // A state to rest in, or an error.
  std::optional<Pattern> resting(Index c, const temporal::Value& held) const {
    const auto* value = std::get_if<temporal::State>(&held);
    if (value == nullptr) return std::nullopt;
    const auto& states = model_.components[c].states;
    const auto state = std::ranges::find(states, value->name, &model::State::name);
    if (state == states.end() || state->parameters.size() != value->arguments.size() ||
        (state->kind != StateKind::resting && state->kind != StateKind::error))
      return std::nullopt;
    Pattern out{c, static_cast<Index>(state - states.begin()), {}};
    for (const std::string& argument : value->arguments) {
      const auto object = std::ranges::find(model_.objects, argument, &model::Object::name);
      if (object == model_.objects.end()) return std::nullopt;
      out.terms.push_back({static_cast<Index>(object - model_.objects.begin()), true});
    }
    return out;
  }

  // Whether all is seen that subgoals stand on: their own component, those that they need,
  // and conditions of behaviours for them.
  bool all_known(const model::Decision& decision) const {
    const model::Behaviour& behaviour = asked_.of(model_);
    for (const model::Precondition& one : behaviour.conditions)
      if (decision.over && !known_[one.state.component] &&
          std::ranges::find(one.state.terms, model::Term{*decision.variable, false}) != one.state.terms.end())
        return false;
    std::vector<bool> looked_at = asked_.concerned;
    for (const model::Choice& choice : decision.choices)
      for (const Index subgoal : choice.subgoals) looked_at[subgoal] = true;
    for (Index s = 0; s < looked_at.size(); ++s) {
      if (!looked_at[s]) continue;
      const Pattern& wanted = behaviour.subgoals[s].state;
      const auto& needs = model_.components[wanted.component].states[wanted.state].needs;
      if (!known_[wanted.component] ||
          !std::ranges::all_of(needs, [&](const model::Need& need) { return known_[need.state.component]; }))
        return false;
      for (const model::Behaviour& other : model_.behaviours)
        if (other.achieves && other.achieves->component == wanted.component &&
            other.achieves->state == wanted.state &&
            !std::ranges::all_of(other.conditions,
                                 [&](const auto& condition) { return known_[condition.state.component]; }))
          return false;
    }
    return true;
  }

  // The value that was planned on first, then the others in the order of the model.
  std::vector<Index> values(Index variable) {
    const model::Behaviour& behaviour = asked_.of(model_);
    std::vector<Index> out = search::admissible(ground_, behaviour, variable, asked_.objects);
    const auto planned = std::ranges::find(out, asked_.objects[variable]);
    if (planned != out.end()) std::rotate(out.begin(), planned, planned + 1);
    return out;
  }

  std::vector<Index> bound(Index variable, Index object) const {
    std::vector<Index> out = asked_.objects;
    out[variable] = object;
    return out;
  }

  // Whether the conditions of the behaviour that speak of the variable hold now.
  bool permits(Index variable, Index object) const {
    const model::Behaviour& behaviour = asked_.of(model_);
    const std::vector<Index> objects = bound(variable, object);
    return std::ranges::all_of(behaviour.conditions, [&](const model::Precondition& one) {
      if (std::ranges::find(one.state.terms, model::Term{variable, false}) == one.state.terms.end())
        return true;
      Pattern wanted = one.state;
      for (model::Term& term : wanted.terms) term = {model::object_of(term, objects), true};
      return (model_.problem->initial[wanted.component] == wanted) != one.negated;
    });
  }

  // Whether the subgoals come about from here with no commands but their own and, where that is said,
  // those that are permitted.
  bool possible(const std::vector<bool>& subgoals, const std::vector<Index>& objects,
                std::optional<std::set<std::string>> permitted) {
    const model::Behaviour& behaviour = asked_.of(model_);
    if (model_.problem->horizon <= Duration{0} || open_.stop.stop_requested()) return false;
    std::vector<Index> goal_of(subgoals.size(), search::kNone);
    model_.problem->goals.clear();
    for (Index s = 0; s < subgoals.size(); ++s) {
      if (!subgoals[s]) continue;
      Pattern state = behaviour.subgoals[s].state;
      for (model::Term& term : state.terms) term = {model::object_of(term, objects), true};
      if (permitted) permitted->insert(to_text(model_, state, {}));
      goal_of[s] = static_cast<Index>(model_.problem->goals.size());
      model_.problem->goals.push_back(
          {behaviour.subgoals[s].name, state, Duration{0}, temporal::no_bound, {}});
    }
    for (const model::SubgoalConstraint& one : behaviour.constraints)
      if (one.from.subgoal && one.to.subgoal && one.from.end && !one.to.end &&
          goal_of[*one.from.subgoal] != search::kNone && goal_of[*one.to.subgoal] != search::kNone &&
          !one.lower.empty() && model::evaluate(model_, one.lower, objects).value_or(-1) >= 0)
        model_.problem->goals[goal_of[*one.to.subgoal]].after.push_back(goal_of[*one.from.subgoal]);
    if (!model::usable(model::check(model_))) return false;
    search::Search search(model_, {});
    const auto stopped = [this] { return open_.stop.stop_requested(); };
    if (search.run(kChoiceWork, kChoiceBytes, stopped) != search::Outcome::solved) return false;
    if (!permitted) return true;
    return std::ranges::all_of(search.plan().activities(), [&](const search::Activity& activity) {
      return activity.state == search::kNone || !search.ground().definition(activity.state).command ||
             permitted->contains(search.ground().text(activity.state));
    });
  }

  const OpenDecision& open_;
  Model model_;
  search::Ground ground_;
  std::vector<bool> known_;  // by component
  AskedDecision asked_;
  std::set<std::string> behind_;  // names of the activities that come after the decision
};

}  // namespace

std::optional<engine::Resolution> TimelineResolver::resolve(const OpenDecision& open) const {
  return Trial(open, read(open)).resolve();
}

}  // namespace roci::planner::timeline_htn::adapter
