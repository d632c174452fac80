#include "planner_svc/temporal_pddl/improvement/completion.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace roci::planner::temporal_pddl {

namespace {

bool worse(const Quality& quality, const Quality& bound) {
  return std::tie(quality.metric, quality.makespan) > std::tie(bound.metric, bound.makespan);
}

}  // namespace

Completion::Completion(const Task& task, const Options& options, Watch& watch, Statistics& statistics)
    : task_(task),
      watch_(watch),
      statistics_(statistics),
      only_grows_(only_grows(task)),
      evaluation_(task),
      earliest_finish_(task),
      freedom_(task),
      space_(task, options.epsilon, ActionSteps::as_needed),
      goal_(task, space_.check(), options.epsilon),
      dominance_(task, space_.store(), space_.bounds(), space_.check(), options.epsilon, true, true) {}

void Completion::restart() {
  space_.clear();
  dominance_.clear();
  open_.clear();
  evaluated_ = generated_ = 0;
}

// Takes the given steps; an end that its start has brought along is no step of its own.
bool Completion::begin(std::span<const SnapId> beginning) {
  successor_.prefix = {};
  successor_.state = task_.initial_state;
  successor_.new_constraints = 0;
  successor_.times.clear();
  space_.add(NodeId(), successor_);
  for (const SnapId step : beginning) {
    const Snap& snap = task_.snaps[step];
    prefix_ = successor_.prefix;
    if (snap.kind == SnapKind::end && std::ranges::count(prefix_.running_actions, snap.action) == 0) continue;
    if (space_.build(prefix_, step, successor_) != Rejection::none) return false;
    space_.add(prefix_.node, successor_);
  }
  return true;
}

bool Completion::complete() {
  PlanPrefix& prefix = successor_.prefix;
  return goal_.complete(successor_.state, prefix) &&
         !worse(quality_of(task_, prefix, space_.check()), bound_);
}

std::optional<PlanPrefix> Completion::find(std::span<const SnapId> beginning, const Quality& bound,
                                           const Guide& guide, const CompletionRule& rule) {
  restart();
  bound_ = bound;
  guide_ = &guide;
  rule_ = rule;
  earliest_finish_.limit(only_grows_ && bound.metric == 0 ? bound.makespan : kNever);
  if (!begin(beginning)) return std::nullopt;
  if (complete()) return std::move(successor_.prefix);
  if (pursue()) return std::move(successor_.prefix);
  while (!open_.empty() && evaluated_ < rule_.evaluations) {
    std::pop_heap(open_.begin(), open_.end());
    const Entry entry = std::move(open_.back());
    open_.pop_back();
    watch_.poll();
    ++statistics_.expanded;
    space_.restore(entry.node, prefix_);
    for (const SnapId snap : entry.preferred) {
      if (evaluated_ >= rule_.evaluations) break;
      ++statistics_.generated;
      if (!advance(prefix_, snap)) continue;
      if (complete() || pursue()) return std::move(successor_.prefix);
    }
    watch_.memory(space_.store().bytes() + dominance_.bytes() + guide_->heuristic.bytes());
  }
  return std::nullopt;
}

// To the state in successor_, which is new and stored. False: the step is not possible, or not worth it.
bool Completion::advance(const PlanPrefix& prefix, SnapId snap) {
  if (!space_.possible(prefix, snap) || space_.build(prefix, snap, successor_) != Rejection::none)
    return false;
  if (guide_->heuristic.hopeless(successor_.state, successor_.prefix.running_actions, space_.steps()))
    return false;
  if (only_grows_ && worse(quality_of(task_, successor_.prefix, space_.check()), bound_)) return false;
  if (successor_.prefix.steps.size() + 2 > kMaxSteps || dominance_.dominated(successor_)) return false;
  space_.add(prefix.node, successor_);
  dominance_.insert(successor_.prefix.node, successor_.state, successor_.prefix);
  return true;
}

// Evaluates the state in successor_ and follows its relaxed plan as far as that can be taken, again and again
// (Vidal 2004, "A lookahead strategy for heuristic search planning"). True: to a complete plan.
bool Completion::pursue() {
  for (bool ahead = true; ahead && evaluated_ < rule_.evaluations;) {
    ahead = false;
    if (!take_up() || !rule_.ahead) return false;
    way_.assign(earliest_finish_.plan().begin(), earliest_finish_.plan().end());
    for (bool moved = true; moved;) {
      moved = false;
      for (SnapId& step : way_) {
        if (step.is_none()) continue;
        kept_ = successor_;
        if (!advance(kept_.prefix, step)) {
          std::swap(successor_, kept_);
          continue;
        }
        step = SnapId();
        ahead = moved = true;
        if (complete()) return true;
      }
    }
  }
  return false;
}

// Evaluates and queues the state in successor_. False: nothing leads on from it.
bool Completion::take_up() {
  const PlanPrefix& prefix = successor_.prefix;
  const Quality quality = quality_of(task_, prefix, space_.check());
  ++evaluated_;
  ++statistics_.evaluated;
  evaluation_.evaluate(successor_, guide_->heuristic, estimate_);
  if (estimate_.dead_end) return false;
  std::vector<SnapId> preferred = estimate_.preferred;
  for (const ActionId action : prefix.running_actions) preferred.push_back(task_.actions[action].end);
  const Ticks finish = rule_.looks_out ? look_out() : kNever;
  if (rule_.looks_out) {
    for (const SnapId snap : earliest_finish_.preferred()) {
      if (std::ranges::count(preferred, snap) == 0) preferred.push_back(snap);
    }
  }
  const bool by_time = guide_->measure == CostMeasure::duration;
  std::int64_t total = by_time ? quality.makespan : quality.metric;
  total += rule_.weight * estimate_.cost;
  if (rule_.by_finish && by_time && finish != kNever) total = std::max(finish, quality.makespan);
  open_.push_back({total, estimate_.steps, generated_++, prefix.node, std::move(preferred)});
  std::push_heap(open_.begin(), open_.end());
  return true;
}

Ticks Completion::look_out() {
  const PlanPrefix& prefix = successor_.prefix;
  const std::vector<Ticks>& times = *space_.check().earliest(prefix);
  freedom_.measure(prefix.steps, times);
  started_.clear();
  for (const Running& running : prefix.running) started_.push_back(times[running.step]);
  return earliest_finish_.measure(
      {successor_.state, prefix.running_actions, prefix.timed_done, &freedom_, started_, prefix.steps});
}

}  // namespace roci::planner::temporal_pddl
