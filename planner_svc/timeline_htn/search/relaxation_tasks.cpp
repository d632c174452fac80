// What complex states and triggered behaviours are made of, which of it may begin, and which comes about.
#include <algorithm>
#include <set>
#include <utility>

#include "planner_svc/timeline_htn/search/decompositions.hpp"
#include "planner_svc/timeline_htn/search/relaxation.hpp"

namespace roci::planner::timeline_htn::search {

using model::Behaviour, model::Pattern, model::StateKind;

bool Relaxation::add_task(StateId state, ComponentSet above) {
  const auto [entry, added] = task_of_.emplace(std::pair(state, above), tasks_.size());
  if (!added) return !std::exchange(tasks_[entry->second].asked, true);
  tasks_.push_back({state, above, {}, false, false});
  return true;
}

// A goal, or a part of what lies below states of these components.
void Relaxation::ask_for(StateId state, ComponentSet above) {
  if (is_complex(state)) add_task(state, above);
  if ((above & bit(component(state))) == 0) wish(state, true, above);
}

void Relaxation::add_way(Task& task, Index index, const std::vector<Index>& objects) {
  const Behaviour& behaviour = model_.behaviours[index];
  std::set<Index> beside;
  for (const model::Decision& decision : behaviour.decisions)
    for (std::size_t choice = 1; choice < decision.choices.size(); ++choice)
      beside.insert(decision.choices[choice].subgoals.begin(), decision.choices[choice].subgoals.end());
  Way way{index, std::vector<Index>(objects.size(), kNone), {}};
  const auto use = [&](const Pattern& pattern) {
    for (const model::Term& term : pattern.terms)
      if (!term.object) way.objects[term.index] = objects[term.index];
  };
  for (Index s = 0; s < behaviour.subgoals.size(); ++s)
    if (!beside.contains(s)) use(behaviour.subgoals[s].state);
  for (const model::Precondition& condition : behaviour.conditions) use(condition.state);
  if (!task_ways_.emplace(index, way.objects).second) return;
  for (Index s = 0; s < behaviour.subgoals.size(); ++s) {
    if (beside.contains(s)) continue;
    const StateId part = ground_.find(ground_of(behaviour.subgoals[s].state, objects));
    if (part == kNone) return;
    const bool nested = (below(task) & bit(component(part))) != 0;
    if (nested && !is_complex(part)) return;
    way.parts.push_back(part);
  }
  if (task.state == kNone || successors_.below().derivable(index, objects))
    task.ways.push_back(std::move(way));
  way_bytes_ += 120;
}

ComponentSet Relaxation::below(const Task& task) const {
  return task.state == kNone ? 0 : task.above | bit(component(task.state));
}

void Relaxation::find_ways(Task& task) {
  task.known = true;
  task_ways_.clear();
  const model::GroundState state = ground_.at(task.state).state;
  for (const Index behaviour : successors_.behaviours(state.component, state.state))
    for (const auto& objects : successors_.ways(behaviour, task.state)) add_way(task, behaviour, objects);
  task_ways_.clear();
}

bool Relaxation::fits(const model::Precondition& condition, const std::vector<Index>& objects) const {
  return std::ranges::any_of(timelines_[condition.state.component].reached, [&](StateId state) {
    return ground_.fits(state, condition.state, objects) != condition.negated;
  });
}

bool Relaxation::begins(StateId state, ComponentSet above) {
  return state == kNone || (above & bit(component(state))) != 0 || (mark(state).reached && !mark(state).over);
}

bool Relaxation::is_done(StateId part, ComponentSet above) {
  if (!is_complex(part))
    return mark(part).reached || (mark(part).earlier && kind(part) == StateKind::resting);
  const auto task = task_of_.find({part, above});
  return task != task_of_.end() && tasks_[task->second].done;
}

bool Relaxation::carry_out(std::size_t index) {
  if (tasks_[index].done || !tasks_[index].asked || !begins(tasks_[index].state, tasks_[index].above))
    return false;
  if (!tasks_[index].known) find_ways(tasks_[index]);
  const ComponentSet above = below(tasks_[index]);
  bool more = false;
  for (std::size_t w = 0; w < tasks_[index].ways.size(); ++w) {
    if (tasks_[index].ways[w].left_out) continue;
    if (!tasks_[index].ways[w].begun) {
      const Way& way = tasks_[index].ways[w];
      const auto& conditions = model_.behaviours[way.behaviour].conditions;
      if (!std::ranges::all_of(conditions, [&](const auto& one) { return fits(one, way.objects); })) continue;
      more = tasks_[index].ways[w].begun = true;
      for (const StateId part : std::vector<StateId>(way.parts)) ask_for(part, above);
    }
    Task& task = tasks_[index];
    if (task.done || !std::ranges::all_of(task.ways[w].parts, [&](StateId p) { return is_done(p, above); }))
      continue;
    more = task.done = true;
    if (task.state != kNone) mark(task.state).done = true;
  }
  return more;
}

}  // namespace roci::planner::timeline_htn::search
