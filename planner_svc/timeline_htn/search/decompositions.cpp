#include "planner_svc/timeline_htn/search/decompositions.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <queue>
#include <unordered_set>
#include <utility>

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

// The fewest values first (Knuth 1977, who takes Dijkstra's shortest paths to grammars):
// a way counts once all its parts are known.
void Decompositions::measure(const std::vector<StateId>& states) {
  struct Sum {
    StateId state;
    std::uint64_t values = 1;
    std::size_t missing = 0;
  };
  std::vector<Sum> sums;
  std::unordered_map<StateId, std::vector<std::size_t>> waiting;
  std::priority_queue<std::pair<std::uint64_t, StateId>, std::vector<std::pair<std::uint64_t, StateId>>,
                      std::greater<>>
      queue;
  const auto offer = [&](const Sum& sum) {
    if (sum.missing == 0 && sum.values < kNone) queue.emplace(sum.values, sum.state);
  };
  for (const StateId state : states) {
    for (const Way& way : entries_[state].ways) {
      Sum sum{state};
      for (const StateId part : way.parts) {
        if (!is_complex(part)) {
          sum.values += ground_->at(part).kind == model::StateKind::simple ? 1 : 0;
        } else if (const std::uint32_t known = entries_[part].values; known != kNone) {
          sum.values += known;
        } else {
          ++sum.missing;
          waiting[part].push_back(sums.size());
        }
      }
      offer(sum);
      sums.push_back(sum);
    }
  }
  while (!queue.empty()) {
    const auto [values, state] = queue.top();
    queue.pop();
    Entry& own = entries_[state];
    if (own.values != kNone) continue;
    own.values = static_cast<std::uint32_t>(values);
    for (const std::size_t way : waiting[state]) {
      sums[way].values += values;
      --sums[way].missing;
      offer(sums[way]);
    }
  }
}

// What all ways of a state share, with the state; nothing: no way is known yet. A way by way of what cannot come about
// without this state shares all of it anyway.
std::optional<std::vector<StateId>> Decompositions::shared_by_ways(StateId state) {
  std::optional<std::vector<StateId>> shared;
  std::vector<StateId> all, both;
  for (const Way& way : entries_[state].ways) {
    const bool counts = std::ranges::all_of(way.parts, [&](StateId part) {
      if (!is_complex(part)) return true;
      const Entry& below = entries_[part];
      return part != state && !below.landmarks.empty() && !std::ranges::binary_search(below.landmarks, state);
    });
    if (!counts) continue;
    all.clear();
    for (const StateId part : way.parts)
      if (ground_->at(part).kind == model::StateKind::simple) all.push_back(part);
    std::ranges::sort(all);
    const auto doubled = std::ranges::unique(all);
    all.erase(doubled.begin(), doubled.end());
    for (const StateId part : way.parts) {
      if (!is_complex(part)) continue;
      both.clear();
      std::ranges::set_union(all, entries_[part].landmarks, std::back_inserter(both));
      std::swap(all, both);
    }
    if (!shared) {
      shared = all;
      continue;
    }
    both.clear();
    std::ranges::set_intersection(*shared, all, std::back_inserter(both));
    std::swap(*shared, both);
  }
  if (!shared) return shared;
  const auto place = std::ranges::lower_bound(*shared, state);
  if (place == shared->end() || *place != state) shared->insert(place, state);
  return shared;
}

// The greatest sets that agree with each other: of each state itself and what all its ways share. Those of few values
// come first, so that nearly all are found in one round.
void Decompositions::find_landmarks(StateId root) {
  std::vector<StateId> states{root};
  std::unordered_map<StateId, std::vector<StateId>> above{{root, {}}};
  for (std::size_t i = 0; i < states.size(); ++i)
    for (const Way& way : entries_[states[i]].ways)
      for (const StateId part : way.parts) {
        if (!is_complex(part) || entries_[part].settled || entries_[part].values == kNone) continue;
        const auto [entry, added] = above.try_emplace(part);
        if (added) states.push_back(part);
        entry->second.push_back(states[i]);
      }
  std::ranges::stable_sort(states, {}, [&](StateId state) { return entries_[state].values; });
  std::unordered_set<StateId> stale(states.begin(), states.end());
  while (!stale.empty()) {
    for (const StateId state : states) {
      if (stale.erase(state) == 0) continue;
      std::optional<std::vector<StateId>> shared = shared_by_ways(state);
      Entry& own = entries_[state];
      if (!shared || own.landmarks == *shared) continue;
      own.landmarks = std::move(*shared);
      stale.insert(above[state].begin(), above[state].end());
    }
  }
  for (const StateId state : states) entries_[state].settled = true;
}

Decompositions::Entry& Decompositions::entry(StateId state) {
  if (const std::vector<StateId> found = explore(state); !found.empty()) measure(found);
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

bool Decompositions::derivable(StateId state) { return entry(state).values != kNone; }

bool Decompositions::derivable(Index behaviour, const std::vector<Index>& objects) {
  const std::optional<Way> way = way_of(behaviour, objects);
  return !way ||
         std::ranges::all_of(way->parts, [&](StateId part) { return !is_complex(part) || derivable(part); });
}

std::uint32_t Decompositions::values(StateId state) { return entry(state).values; }

const std::vector<StateId>& Decompositions::landmarks(StateId state) {
  Entry& own = entry(state);
  if (!own.settled && own.values != kNone) find_landmarks(state);
  return own.landmarks;
}

}  // namespace roci::planner::timeline_htn::search
