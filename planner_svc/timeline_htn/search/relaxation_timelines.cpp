// How far timelines come: by what is asked for, and by what follows by itself.
#include <algorithm>
#include <utility>

#include "planner_svc/timeline_htn/search/relaxation.hpp"

namespace roci::planner::timeline_htn::search {

using model::StateKind;

const TransitionGraph& Relaxation::graph(Index component) {
  Timeline& timeline = timelines_[component];
  if (!timeline.graph) timeline.graph.emplace(ground_, timeline.initial);
  return *timeline.graph;
}

// Goes on until nothing is added; false: it was cancelled, or takes too much memory.
bool Relaxation::propagate() {
  for (bool more = true; more;) {
    more = false;
    for (Timeline& timeline : timelines_)
      for (std::size_t i = 0; !timeline.predicted && i < timeline.reached.size(); ++i) {
        if (steps_++ % 1024 == 0 && (bytes() > most_bytes_ || cancelled_())) return false;
        more = go_on(timeline, timeline.reached[i]) || more;
      }
    for (std::size_t t = 0; t < tasks_.size(); ++t) {
      if (steps_++ % 64 == 0 && (bytes() > most_bytes_ || cancelled_())) return false;
      more = carry_out(t) || more;
    }
  }
  return true;
}

bool Relaxation::reach(StateId state) {
  if (mark(state).reached) return std::exchange(mark(state).over, false);
  if (mark(state).left_out) return false;
  mark(state).reached = true;
  timelines_[component(state)].reached.push_back(state);
  const model::State& definition = ground_.definition(state);
  std::vector<Index> variables = ground_.at(state).state.objects;
  variables.resize(variables.size() + definition.free.size(), kNone);
  for (const model::Need& need : definition.needs)
    for (const StateId other : graph(need.state.component).states())
      if (ground_.fits(other, need.state, variables) && !is_complex(other)) wish(other, false, 0);
  return true;
}

void Relaxation::wish(StateId state, bool by_complex, ComponentSet above) {
  Timeline& timeline = timelines_[component(state)];
  if (timeline.predicted) return;
  const Index part = graph(component(state)).part(state);
  if (part == kNone) return;
  const bool itself = kind(state) != StateKind::resting || is_left_for_another(state);
  const auto same = std::ranges::find_if(timeline.wishes, [&](const Wish& one) {
    return one.part == part && one.by_complex == by_complex && one.above == above;
  });
  if (same == timeline.wishes.end()) {
    timeline.wishes.push_back({part, by_complex, above, state, itself});
  } else if (!same->also_from_itself && (itself || same->only != state)) {
    same->also_from_itself = true;
  } else {
    return;
  }
  ++timeline.changes;
}

bool Relaxation::is_left_for_another(StateId state) const {
  return left_for_another_.contains({component(state), ground_.at(state).state.state});
}

// What may follow a state that is reached.
bool Relaxation::go_on(Timeline& timeline, StateId from) {
  if (is_complex(from) && from != timeline.initial && !mark(from).done) return false;
  const bool leaves = !mark(from).left;
  if (!leaves && mark(from).changes == timeline.changes) return false;
  mark(from).left = true;
  mark(from).changes = timeline.changes;
  bool more = false;
  const std::vector<StateId> next = ground_.next(from);
  if (leaves && (kind(from) == StateKind::simple || is_complex(from) || is_left_for_another(from)))
    for (const StateId after : next) more = (!is_complex(after) && reach(after)) || more;
  if (leaves && kind(from) == StateKind::simple) more = go_on_by_itself(from) || more;
  for (std::size_t w = 0; w < timeline.wishes.size(); ++w) {
    const Wish one = timeline.wishes[w];
    if (one.only == from && !one.also_from_itself) continue;
    const std::vector<bool>& leads = timeline.graph->leading_to(one.part);
    for (const StateId after : next) {
      if (!leads[timeline.graph->part(after)] || (is_complex(after) && !one.by_complex)) continue;
      more = reach(after) || more;
      if (is_complex(after) && !mark(after).left_out) more = add_task(after, one.above) || more;
    }
  }
  return more;
}

bool Relaxation::go_on_by_itself(StateId from) {
  bool more = false;
  std::vector<StateId> last{from};
  for (std::size_t step = 0; step < kStepsByItself; ++step) {
    std::vector<StateId> now;
    for (const StateId one : last)
      for (const StateId after : std::vector<StateId>(ground_.next(one)))
        if (!is_complex(after) && !ground_.definition(after).command) now.push_back(after);
    for (const StateId after : now) more = reach(after) || more;
    last = std::move(now);
  }
  return more;
}

}  // namespace roci::planner::timeline_htn::search
