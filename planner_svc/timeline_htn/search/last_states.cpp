#include "planner_svc/timeline_htn/search/last_states.hpp"

#include <algorithm>

namespace roci::planner::timeline_htn::search {

using model::Behaviour, model::StateKind;

namespace {

// Subgoals that a plan reckons with: those of the first choices.
std::vector<Index> reckoned_with(const Behaviour& behaviour) {
  std::vector<bool> beside(behaviour.subgoals.size(), false);
  for (const model::Decision& decision : behaviour.decisions)
    for (std::size_t choice = 1; choice < decision.choices.size(); ++choice)
      for (const Index subgoal : decision.choices[choice].subgoals) beside[subgoal] = true;
  std::vector<Index> out;
  for (Index s = 0; s < behaviour.subgoals.size(); ++s)
    if (!beside[s]) out.push_back(s);
  return out;
}

// By subgoal those that end before it starts, whatever the objects.
std::vector<std::set<Index>> ordered_before(const Behaviour& behaviour, const std::vector<Index>& subgoals) {
  std::vector<std::set<Index>> out(behaviour.subgoals.size());
  for (const model::SubgoalConstraint& one : behaviour.constraints) {
    if (!one.from.subgoal || !one.to.subgoal || !one.from.end || one.to.end) continue;
    const bool at_once_or_later = one.lower.size() == 1 &&
                                  one.lower.front().op == model::Operator::constant &&
                                  one.lower.front().constant >= 0;
    if (at_once_or_later && std::ranges::find(subgoals, *one.from.subgoal) != subgoals.end())
      out[*one.to.subgoal].insert(*one.from.subgoal);
  }
  for (std::size_t round = 0; round < out.size(); ++round)
    for (auto& before : out)
      for (const Index one : std::set<Index>(before)) before.insert(out[one].begin(), out[one].end());
  return out;
}

// Whether a value of the state lasts longer than no time, whatever the objects.
bool takes_time(const model::State& state) {
  return state.kind == StateKind::simple && state.shortest.size() == 1 &&
         state.shortest.front().op == model::Operator::constant && state.shortest.front().constant > 0;
}

}  // namespace

LastStates::Left LastStates::of(Index index, const std::vector<StateId>& parts, Index component) {
  const Behaviour& behaviour = ground_->model().behaviours[index];
  const std::vector<Index> subgoals = reckoned_with(behaviour);
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (moves(ground_->at(parts[i]).state.component, component)) touching.push_back(i);
  if (touching.empty()) return {};
  const auto before = ordered_before(behaviour, subgoals);
  const auto last = std::ranges::find_if(touching, [&](std::size_t one) {
    return std::ranges::all_of(touching, [&](std::size_t other) {
      return other == one || before[subgoals[one]].contains(subgoals[other]);
    });
  });
  if (last == touching.end()) return {true, std::nullopt};
  return {true, of_part(parts[*last], component)};
}

// A value that may move its own timeline on, by what it needs of others, leaves it in any state.
std::optional<std::vector<StateId>> LastStates::of_part(StateId part, Index component) {
  const bool complex = ground_->at(part).kind == StateKind::complex;
  if (ground_->at(part).state.component != component)
    return complex ? of_ways(part, component) : std::nullopt;
  const auto moves_itself = [&](const model::Need& need) { return moves(need.state.component, component); };
  if (complex || std::ranges::any_of(ground_->definition(part).needs, moves_itself)) return std::nullopt;
  if (ground_->at(part).kind == StateKind::resting && !stays(part)) return std::nullopt;
  return std::vector<StateId>{part};
}

// Whether nothing may follow the state at the time at which it is wanted, so that it could be met by one that is over:
// what follows, and what may ask for it, takes time.
bool LastStates::stays(StateId state) {
  const Index component = ground_->at(state).state.component;
  for (const StateId after : std::vector<StateId>(ground_->next(state)))
    if (ground_->at(after).kind != StateKind::simple ||
        ground_->at(after).bounds.shortest <= temporal::Duration{0})
      return false;
  const auto asks = [&](const model::Need& need) { return need.state.component == component; };
  for (const model::Component& other : ground_->model().components)
    for (const model::State& one : other.states)
      if (std::ranges::any_of(one.needs, asks) && !takes_time(one)) return false;
  return true;
}

std::optional<std::vector<StateId>> LastStates::of_ways(StateId state, Index component) {
  if (!above_.insert(state).second) return std::nullopt;
  std::optional<std::vector<StateId>> out{std::in_place};
  const model::GroundState whole = ground_->at(state).state;
  for (const Index index : successors_->behaviours(whole.component, whole.state)) {
    const Behaviour& behaviour = ground_->model().behaviours[index];
    for (const auto& objects : successors_->ways(index, state)) {
      std::vector<StateId> parts;
      for (const Index s : reckoned_with(behaviour))
        parts.push_back(ground_->find(ground_of(behaviour.subgoals[s].state, objects)));
      if (!out || std::ranges::find(parts, kNone) != parts.end()) continue;
      const Left left = of(index, parts, component);
      if (!left.states) out.reset();  // also where it is not touched: what came before it may have done so
      if (out) out->insert(out->end(), left.states->begin(), left.states->end());
    }
  }
  above_.erase(state);
  return out;
}

}  // namespace roci::planner::timeline_htn::search
