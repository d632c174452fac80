#include "planner_svc/timeline_htn/search/transition_graph.hpp"

#include <algorithm>

namespace roci::planner::timeline_htn::search {

TransitionGraph::TransitionGraph(Ground& ground, StateId from) {
  find_parts(ground, from);
  for (const StateId state : states_)
    for (const StateId after : ground.next(state))
      if (part_[after] != part_[state]) edges_[part_[state]].push_back(part_[after]);
  for (auto& list : edges_) {
    std::ranges::sort(list);
    const auto doubled = std::ranges::unique(list);
    list.erase(doubled.begin(), doubled.end());
    bytes_ += list.capacity() * sizeof(Index) + sizeof(list);
  }
  bytes_ += (states_.capacity() + part_.capacity()) * sizeof(Index);
}

void TransitionGraph::find_parts(Ground& ground, StateId from) {
  struct Visit {
    StateId state;
    std::size_t edge;
  };
  std::vector<Index> number, lowest;  // by state; kNone: not met
  std::vector<StateId> waiting;       // met, in no part yet
  std::vector<Visit> stack;
  const auto meet = [&](StateId state) {
    if (state >= number.size()) {
      number.resize(state + 1, kNone);
      lowest.resize(state + 1, kNone);
      part_.resize(state + 1, kNone);
    }
    if (number[state] != kNone) return false;
    number[state] = lowest[state] = static_cast<Index>(states_.size());
    states_.push_back(state);
    waiting.push_back(state);
    stack.push_back({state, 0});
    return true;
  };
  meet(from);
  while (!stack.empty()) {
    const StateId state = stack.back().state;
    const std::vector<StateId>& next = ground.next(state);
    if (stack.back().edge < next.size()) {
      const StateId after = next[stack.back().edge++];
      if (!meet(after) && part_[after] == kNone) lowest[state] = std::min(lowest[state], number[after]);
      continue;
    }
    if (lowest[state] == number[state]) {
      StateId one = kNone;
      do {
        one = waiting.back();
        waiting.pop_back();
        part_[one] = static_cast<Index>(edges_.size());
      } while (one != state);
      edges_.emplace_back();
    }
    stack.pop_back();
    if (!stack.empty()) {
      const StateId above = stack.back().state;
      lowest[above] = std::min(lowest[above], lowest[state]);
    }
  }
}

const std::vector<bool>& TransitionGraph::leading_to(Index target) {
  if (const auto known = leading_.find(target); known != leading_.end()) return known->second;
  std::vector<bool> out(edges_.size(), false);
  out[target] = true;
  for (std::size_t part = target + 1; part < edges_.size(); ++part)
    out[part] = std::ranges::any_of(edges_[part], [&](Index after) { return out[after]; });
  bytes_ += out.size() / 8 + 64;
  return leading_.emplace(target, std::move(out)).first->second;
}

}  // namespace roci::planner::timeline_htn::search
