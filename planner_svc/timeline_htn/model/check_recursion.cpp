#include <algorithm>
#include <set>

#include "planner_svc/timeline_htn/model/complaints.hpp"

namespace roci::planner::timeline_htn::model {

namespace {

constexpr std::size_t kMostWays = 20'000;
constexpr Index kOther = ~Index{0};

using StateKey = std::pair<Index, Index>;  // component, state

StateKey key_of(const Pattern& pattern) { return {pattern.component, pattern.state}; }

bool is_complex(const Model& model, const StateKey& key) {
  return model.components[key.first].states[key.second].kind == StateKind::complex;
}

// For each parameter of a subgoal's state: which parameter of the achieved state it equals, or none.
std::vector<Index> carried(const Behaviour& behaviour, const Subgoal& subgoal) {
  std::vector<Index> out;
  for (const Term& term : subgoal.state.terms) {
    const auto found = std::ranges::find(behaviour.achieves->terms, term);
    out.push_back(found == behaviour.achieves->terms.end()
                      ? kOther
                      : static_cast<Index>(found - behaviour.achieves->terms.begin()));
  }
  return out;
}

// A way from a state to one that stands below it, with the parameters that come along.
struct Way {
  StateKey at;
  std::vector<Index> from;  // for each parameter there: which of the first state, or kOther
  friend auto operator<=>(const Way&, const Way&) = default;
};

std::vector<Way> steps(const Model& model, const Behaviour& behaviour, const std::vector<Index>& from) {
  std::vector<Way> out;
  for (const Subgoal& subgoal : behaviour.subgoals) {
    if (!is_complex(model, key_of(subgoal.state))) continue;
    Way way{key_of(subgoal.state), carried(behaviour, subgoal)};
    for (Index& parameter : way.from)
      if (parameter != kOther) parameter = from[parameter];
    out.push_back(std::move(way));
  }
  return out;
}

// Whether the behaviour leads back to the same state with the same objects.
bool leads_to_itself(const Model& model, const Behaviour& behaviour) {
  const StateKey goal = key_of(*behaviour.achieves);
  std::vector<Index> identity(behaviour.achieves->terms.size());
  for (Index i = 0; i < identity.size(); ++i) identity[i] = i;
  std::vector<Way> open = steps(model, behaviour, identity);
  std::set<Way> seen(open.begin(), open.end());
  while (!open.empty() && seen.size() < kMostWays) {
    const Way way = std::move(open.back());
    open.pop_back();
    if (way.at == goal && way.from == identity) return true;
    // Where only one behaviour leads on there is no other way; where several do, another one may be taken.
    const Behaviour* only = nullptr;
    std::size_t count = 0;
    for (const Behaviour& next : model.behaviours)
      if (next.achieves && key_of(*next.achieves) == way.at) {
        only = &next;
        ++count;
      }
    if (count != 1) continue;
    for (Way& next : steps(model, *only, way.from))
      if (seen.insert(next).second) open.push_back(std::move(next));
  }
  return false;
}

// The complex states that some behaviour brings about in finitely many steps.
std::set<StateKey> that_end(const Model& model) {
  std::set<StateKey> out;
  for (bool more = true; more;) {
    more = false;
    for (const Behaviour& behaviour : model.behaviours) {
      if (!behaviour.achieves || out.contains(key_of(*behaviour.achieves))) continue;
      const bool ends = std::ranges::all_of(behaviour.subgoals, [&](const Subgoal& subgoal) {
        return !is_complex(model, key_of(subgoal.state)) || out.contains(key_of(subgoal.state));
      });
      if (ends) more = out.insert(key_of(*behaviour.achieves)).second || more;
    }
  }
  return out;
}

}  // namespace

void check_recursion(Complaints& complaints) {
  const Model& model = complaints.model;
  const std::set<StateKey> ending = that_end(model);
  for (std::size_t i = 0; i < model.behaviours.size(); ++i) {
    const Behaviour& behaviour = model.behaviours[i];
    complaints.about(Part::behaviour, i);
    if (!behaviour.achieves) {
      for (const Subgoal& subgoal : behaviour.subgoals)
        if (is_complex(model, key_of(subgoal.state)) && !ending.contains(key_of(subgoal.state)))
          complaints.error("its subgoal '" + subgoal.name + "' never ends",
                           "add a behaviour that achieves it without itself");
      continue;
    }
    if (leads_to_itself(model, behaviour)) {
      complaints.error("it never ends: it needs " + to_text(model, *behaviour.achieves, behaviour.variables) +
                           " to achieve just that, with the same objects",
                       "let the subgoal have another argument, nearer to the goal");
    } else if (!ending.contains(key_of(*behaviour.achieves))) {
      complaints.error("it never ends: every behaviour for " +
                           to_text(model, *behaviour.achieves, behaviour.variables) + " needs it again",
                       "add a behaviour for the last step, without recursion");
    }
  }
}

}  // namespace roci::planner::timeline_htn::model
