#include "planner_svc/timeline_htn/search/decompositions.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

namespace roci::planner::timeline_htn::search {

std::optional<Decompositions::Way> Decompositions::way_of(Index index, const std::vector<Index>& objects) {
  const model::Behaviour& behaviour = ground_->model().behaviours[index];
  std::vector<bool> beside(behaviour.subgoals.size(), false);
  for (const auto& decision : behaviour.decisions)
    for (std::size_t choice = 1; choice < decision.choices.size(); ++choice)
      for (const Index subgoal : decision.choices[choice].subgoals) beside[subgoal] = true;
  Way way;
  for (std::size_t s = 0; s < behaviour.subgoals.size(); ++s) {
    const model::Pattern& pattern = behaviour.subgoals[s].state;
    model::GroundState part{pattern.component, pattern.state, {}};
    for (const auto& term : pattern.terms) part.objects.push_back(model::object_of(term, objects));
    const StateId number = ground_->find(part);
    if (number == kNone) return std::nullopt;
    if (!beside[s]) way.parts.push_back(number);
  }
  return way;
}

// Finds the complex states below one that were not measured yet, with their ways.
std::vector<StateId> Decompositions::explore(StateId root) {
  std::vector<StateId> found;
  if (entries_.contains(root)) return found;
  entries_[root];
  found.push_back(root);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const StateId state = found[i];
    const model::GroundState ground = ground_->at(state).state;
    std::vector<Way> ways;
    for (const Index index : successors_->behaviours(ground.component, ground.state)) {
      for (const auto& objects : successors_->ways(index, state)) {
        std::optional<Way> way = way_of(index, objects);
        if (!way) continue;
        for (const StateId part : way->parts)
          if (is_complex(part) && !entries_.contains(part)) {
            entries_[part];
            found.push_back(part);
          }
        ways.push_back(std::move(*way));
      }
    }
    entries_[state].ways = std::move(ways);
  }
  return found;
}

// The fewest values, by rounds until nothing changes: a way counts once all its parts are known.
void Decompositions::measure(const std::vector<StateId>& states) {
  for (bool more = true; more;) {
    more = false;
    for (auto state = states.rbegin(); state != states.rend(); ++state) {
      Entry& own = entries_[*state];
      for (const Way& way : own.ways) {
        std::uint64_t sum = 1;
        for (const StateId part : way.parts) {
          if (is_complex(part)) {
            const std::uint32_t below = entries_[part].values;
            sum = below == kNone || sum >= kNone ? kNone : sum + below;
          } else if (ground_->at(part).kind == model::StateKind::simple && sum < kNone) {
            ++sum;
          }
        }
        if (sum < own.values) {
          own.values = static_cast<std::uint32_t>(sum);
          more = true;
        }
      }
    }
  }
}

// The greatest sets that agree with each other: of each state itself and what all its ways share.
void Decompositions::find_landmarks(const std::vector<StateId>& states) {
  for (bool more = true; more;) {
    more = false;
    for (auto state = states.rbegin(); state != states.rend(); ++state) {
      Entry& own = entries_[*state];
      if (own.values == kNone) continue;
      std::optional<std::vector<StateId>> shared;  // nothing: no way is known yet
      for (const Way& way : own.ways) {
        std::vector<StateId> all;
        bool known = true;
        for (const StateId part : way.parts) {
          if (!is_complex(part)) {
            if (ground_->at(part).kind == model::StateKind::simple) all.push_back(part);
            continue;
          }
          const Entry& below = entries_[part];
          known = known && below.settled;
          all.insert(all.end(), below.landmarks.begin(), below.landmarks.end());
        }
        if (!known) continue;
        std::ranges::sort(all);
        const auto doubled = std::ranges::unique(all);
        all.erase(doubled.begin(), doubled.end());
        if (!shared) {
          shared = std::move(all);
          continue;
        }
        std::vector<StateId> both;
        std::ranges::set_intersection(*shared, all, std::back_inserter(both));
        shared = std::move(both);
      }
      if (!shared) continue;
      const auto place = std::ranges::lower_bound(*shared, *state);
      if (place == shared->end() || *place != *state) shared->insert(place, *state);
      if (own.settled && own.landmarks == *shared) continue;
      own.settled = true;
      own.landmarks = std::move(*shared);
      more = true;
    }
  }
}

Decompositions::Entry& Decompositions::entry(StateId state) {
  const std::vector<StateId> found = explore(state);
  if (!found.empty()) {
    measure(found);
    find_landmarks(found);
  }
  return entries_[state];
}

bool Decompositions::derivable_without(StateId root, const std::vector<StateId>& excluded) {
  if (!derivable(root)) return false;
  const auto is_excluded = [&](StateId state) { return std::ranges::binary_search(excluded, state); };
  if (is_excluded(root)) return false;
  std::vector<StateId> below{root};
  std::unordered_map<StateId, bool> derived{{root, false}};
  for (std::size_t i = 0; i < below.size(); ++i)
    for (const Way& way : entries_[below[i]].ways)
      for (const StateId part : way.parts)
        if (is_complex(part) && !is_excluded(part) && derived.emplace(part, false).second)
          below.push_back(part);
  for (bool more = true; more && !derived[root];) {
    more = false;
    for (auto state = below.rbegin(); state != below.rend(); ++state) {
      if (derived[*state]) continue;
      const bool made_up = std::ranges::any_of(entries_[*state].ways, [&](const Way& way) {
        return std::ranges::all_of(way.parts, [&](StateId part) {
          return !is_complex(part) || (!is_excluded(part) && derived[part]);
        });
      });
      if (made_up) more = derived[*state] = true;
    }
  }
  return derived[root];
}

bool Decompositions::derivable(StateId state) {
  if (const std::vector<StateId> found = explore(state); !found.empty()) measure(found);
  return entries_[state].values != kNone;
}

bool Decompositions::derivable(Index behaviour, const std::vector<Index>& objects) {
  const std::optional<Way> way = way_of(behaviour, objects);
  return !way ||
         std::ranges::all_of(way->parts, [&](StateId part) { return !is_complex(part) || derivable(part); });
}

std::uint32_t Decompositions::values(StateId state) { return entry(state).values; }

const std::vector<StateId>& Decompositions::landmarks(StateId state) { return entry(state).landmarks; }

}  // namespace roci::planner::timeline_htn::search
