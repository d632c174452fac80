#include "planner_svc/timeline_htn/search/relaxation.hpp"

#include <algorithm>
#include <utility>

#include "planner_svc/timeline_htn/search/last_states.hpp"
#include "planner_svc/timeline_htn/search/search.hpp"

namespace roci::planner::timeline_htn::search {

using model::NeedKind;

namespace {

constexpr int kMostRounds = 8;

}  // namespace

Relaxation::Relaxation(const model::Model& model, std::size_t most_bytes,
                       const std::function<bool()>& cancelled)
    : model_(model),
      most_bytes_(most_bytes),
      cancelled_(cancelled),
      ground_(model),
      successors_(ground_, bindings_, Order::first_declared),
      timelines_(model.components.size()) {
  for (const auto& component : model.components)
    for (const auto& state : component.states)
      for (const auto& need : state.needs)
        if (need.kind == NeedKind::met_by) left_for_another_.emplace(need.state.component, need.state.state);
}

std::optional<NeverReached> Relaxation::run() {
  const PartialPlan plan(ground_, bindings_, goal_order(*model_.problem));
  if (!plan.sound()) return std::nullopt;
  for (Index c = 0; c < model_.components.size(); ++c) {
    timelines_[c].initial = plan.tokens()[plan.begun(c)].state;
    timelines_[c].predicted = model::is_predicted(model_, c);
    if (timelines_[c].predicted)
      for (const Index token : plan.predicted(c)) timelines_[c].known.push_back(plan.tokens()[token].state);
  }
  for (Index cause = 0; cause < plan.mending_count(); ++cause) {
    tasks_.push_back({kNone, 0, {}, true, false});
    task_ways_.clear();
    for (const auto& [behaviour, binding] : plan.mending(cause))
      add_way(tasks_.back(), behaviour, bindings_.at(binding));
  }
  causes_ = tasks_.size();
  for (int round = 0; round < kMostRounds; ++round) {
    start();
    if (!propagate()) return std::nullopt;
    if (auto out = unmet()) return out;
    if (!leave_out()) break;
  }
  if (causes_ == 0) return std::nullopt;
  start(false);
  if (!propagate() || !start_mended() || !propagate()) return std::nullopt;
  return unmet();
}

// With the goals, or with what mends errors alone.
void Relaxation::start(bool with_goals) {
  for (Mark& one : marks_) one = {.left_out = one.left_out};
  forget_tasks(0, with_goals);
  for (Timeline& timeline : timelines_) {
    timeline.reached = {timeline.initial};
    timeline.wishes.clear();
    timeline.changes = 0;
    mark(timeline.initial).reached = true;
    for (const StateId state : timeline.known)
      if (!std::exchange(mark(state).reached, true)) timeline.reached.push_back(state);
  }
  if (with_goals) ask_for_goals();
}

void Relaxation::ask_for_goals() {
  for (const model::Goal& goal : model_.problem->goals) ask_for(ground_.find(ground_of(goal.state, {})), 0);
}

// All but what is triggered comes about anew, and where it is not asked for (false) only if it is from now on.
void Relaxation::forget_tasks(std::size_t first, bool asked) {
  for (std::size_t t = first; t < tasks_.size(); ++t) {
    tasks_[t].done = false;
    tasks_[t].asked = asked || t < causes_;
    for (Way& way : tasks_[t].ways) way.begun = false;
  }
}

// Begins again where all that mends errors is complete: the goals come after that (false: nothing was mended).
// A timeline whose last state is known goes on from there; the others from wherever they came to. What was there
// earlier may still meet a need, or a goal to rest, if it ended just then.
bool Relaxation::start_mended() {
  LastStates last(ground_, successors_);
  std::vector<std::vector<StateId>> begin(timelines_.size());
  bool known = false;
  for (Index c = 0; c < timelines_.size(); ++c) {
    const auto left = timelines_[c].predicted ? std::nullopt : left_by_mending(last, c);
    known = known || left;
    begin[c] = left.value_or(timelines_[c].reached);
  }
  if (!known) return false;
  for (Mark& one : marks_) one = {.earlier = one.reached, .done = one.done, .left_out = one.left_out};
  forget_tasks(causes_, false);
  for (Index c = 0; c < timelines_.size(); ++c) {
    Timeline& timeline = timelines_[c];
    timeline.earlier = std::exchange(timeline.reached, std::move(begin[c]));
    timeline.wishes.clear();
    timeline.changes = 0;
    for (const StateId state : timeline.reached) {
      mark(state).reached = true;
      mark(state).over = is_complex(state);
    }
  }
  ask_for_goals();
  return true;
}

// Where a timeline can stand then: where the last of what mends one cause or another has left it, or where it began.
std::optional<std::vector<StateId>> Relaxation::left_by_mending(LastStates& last, Index component) {
  std::set<StateId> out;
  bool may_stay = true;
  for (std::size_t cause = 0; cause < causes_; ++cause) {
    bool stays = false;
    for (const Way& way : tasks_[cause].ways) {
      const auto done = [&](StateId part) { return is_done(part, 0); };
      if (!way.begun || way.left_out || !std::ranges::all_of(way.parts, done)) continue;
      const LastStates::Left left = last.of(way.behaviour, way.parts, component);
      if (left.touched && !left.states) return std::nullopt;
      stays = stays || !left.touched;
      for (const StateId state : left.states.value_or(std::vector<StateId>{}))
        if (mark(state).reached) out.insert(state);
    }
    may_stay = may_stay && stays;
  }
  if (may_stay) out.insert(timelines_[component].initial);
  return std::vector<StateId>(out.begin(), out.end());
}

// What began and cannot come about; false: nothing did.
bool Relaxation::leave_out() {
  bool more = false;
  for (Task& task : tasks_)
    for (Way& way : task.ways) {
      const auto done = [&](StateId part) { return is_done(part, below(task)); };
      if (!way.begun || way.left_out || std::ranges::all_of(way.parts, done)) continue;
      more = way.left_out = true;
    }
  for (const Timeline& timeline : timelines_)
    for (const StateId state : timeline.reached) {
      if (mark(state).left_out) continue;
      const bool never_ends = is_complex(state) && state != timeline.initial && !mark(state).done;
      if (!never_ends && unmet_need(state) == nullptr) continue;
      more = mark(state).left_out = true;
    }
  return more;
}

const model::Need* Relaxation::unmet_need(StateId state) const {
  const model::State& definition = ground_.definition(state);
  std::vector<Index> variables = ground_.at(state).state.objects;
  variables.resize(variables.size() + definition.free.size(), kNone);
  for (const model::Need& need : definition.needs) {
    const Timeline& timeline = timelines_[need.state.component];
    const auto fits = [&](StateId other) { return ground_.fits(other, need.state, variables); };
    if (std::ranges::none_of(timeline.reached, fits) && std::ranges::none_of(timeline.earlier, fits))
      return &need;
  }
  return nullptr;
}

std::size_t Relaxation::bytes() const {
  std::size_t out = ground_.bytes() + bindings_.bytes() + marks_.capacity() * sizeof(Mark) +
                    tasks_.size() * 200 + way_bytes_;
  for (const Timeline& timeline : timelines_)
    if (timeline.graph) out += timeline.graph->bytes();
  return out;
}

}  // namespace roci::planner::timeline_htn::search
