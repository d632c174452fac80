#include "planner_svc/temporal_pddl/improvement/plan_completion.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace roci::planner::temporal_pddl::improvement {

using heuristics::CostMeasure;
using search::Guide, search::NodeId, search::PlanPrefix, search::Rejection, search::Running,
    search::SearchContext;
using task::ActionCompression, task::ActionId, task::Snap, task::SnapId, task::SnapKind;
using temporal::Duration, temporal::no_bound;

namespace {

bool worse(const PlanQuality& quality, const PlanQuality& bound) {
  return std::tie(quality.metric, quality.makespan) > std::tie(bound.metric, bound.makespan);
}

}  // namespace

PlanCompletion::PlanCompletion(const SearchContext& context)
    : context_(context),
      task_(context.task),
      only_grows_(only_grows(context.task)),
      evaluation_(context.task),
      relaxed_schedule_(context.task),
      release_times_(context.task),
      space_(context.task, context.options.epsilon, ActionCompression::where_safe, context.limits.touched()),
      goal_(context.task, space_.check(), context.options.epsilon),
      dominance_(context.task, space_.store(), space_.bounds(), space_.check(), context.options.epsilon, true,
                 true) {
  context.limits.memory_on_top(relaxed_schedule_.bytes());
}

void PlanCompletion::restart() {
  space_.clear();
  dominance_.clear();
  open_.clear();
  evaluated_ = generated_ = 0;
}

// Takes the given steps; an end that its start has brought along is no step of its own.
bool PlanCompletion::begin(std::span<const SnapId> beginning) {
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

bool PlanCompletion::complete() {
  PlanPrefix& prefix = successor_.prefix;
  return goal_.complete(successor_.state, prefix) &&
         !worse(quality_of(task_, prefix, space_.check()), bound_);
}

std::optional<PlanPrefix> PlanCompletion::find(std::span<const SnapId> beginning, const PlanQuality& bound,
                                               const Guide& guide, const CompletionRule& rule) {
  restart();
  bound_ = bound;
  guide_ = &guide;
  rule_ = rule;
  relaxed_schedule_.limit(only_grows_ && bound.metric == 0 ? bound.makespan : no_bound);
  if (!begin(beginning)) return std::nullopt;
  if (complete()) return std::move(successor_.prefix);
  if (follow_schedule()) return std::move(successor_.prefix);
  while (!open_.empty() && evaluated_ < rule_.evaluations) {
    std::pop_heap(open_.begin(), open_.end());
    const Entry entry = std::move(open_.back());
    open_.pop_back();
    context_.limits.poll();
    ++context_.statistics.expanded;
    space_.restore(entry.node, prefix_);
    for (const SnapId snap : entry.preferred) {
      if (evaluated_ >= rule_.evaluations) break;
      ++context_.statistics.generated;
      if (!advance(prefix_, snap)) continue;
      if (complete() || follow_schedule()) return std::move(successor_.prefix);
    }
    context_.limits.memory(space_.store().bytes() + dominance_.bytes() + guide_->bytes());
  }
  return std::nullopt;
}

// Takes the step to the state in successor_, which is new and stored then. Returns false if the step is not
// possible, or not worth it.
bool PlanCompletion::advance(const PlanPrefix& prefix, SnapId snap) {
  if (!space_.possible(prefix, snap) || space_.build(prefix, snap, successor_) != Rejection::none)
    return false;
  if (guide_->detectors.prove_dead_end(successor_.state, successor_.prefix.running_actions, space_.steps()))
    return false;
  if (only_grows_ && worse(quality_of(task_, successor_.prefix, space_.check()), bound_)) return false;
  if (is_too_long(successor_.prefix) || dominance_.dominated(successor_)) return false;
  space_.add(prefix.node, successor_);
  dominance_.insert(successor_.prefix.node, successor_.state, successor_.prefix);
  return true;
}

// Evaluates the state in successor_ and follows its relaxed plan as far as that can be taken, again and again
// (Vidal 2004, "A lookahead strategy for heuristic search planning"). Returns whether that led to a complete
// plan.
bool PlanCompletion::follow_schedule() {
  for (bool ahead = true; ahead && evaluated_ < rule_.evaluations;) {
    ahead = false;
    if (!take_up() || !rule_.lookahead) return false;
    way_.assign(relaxed_schedule_.plan().begin(), relaxed_schedule_.plan().end());
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

// Evaluates and queues the state in successor_. Returns false if nothing leads on from it.
bool PlanCompletion::take_up() {
  const PlanPrefix& prefix = successor_.prefix;
  const PlanQuality quality = quality_of(task_, prefix, space_.check());
  ++evaluated_;
  ++context_.statistics.evaluated;
  evaluation_.evaluate(successor_, *guide_, estimate_);
  if (estimate_.dead_end) return false;
  std::vector<SnapId> preferred = estimate_.preferred;
  for (const ActionId action : prefix.running_actions) preferred.push_back(task_.actions[action].end);
  const Duration finish = rule_.tries_schedule ? relaxed_makespan() : no_bound;
  if (rule_.tries_schedule) {
    for (const SnapId snap : relaxed_schedule_.preferred()) {
      if (std::ranges::count(preferred, snap) == 0) preferred.push_back(snap);
    }
  }
  const bool by_time = guide_->measure == CostMeasure::duration;
  std::int64_t total = by_time ? quality.makespan.count() : quality.metric;
  total += rule_.weight * estimate_.cost;
  if (rule_.by_makespan && by_time && finish != no_bound) total = std::max(finish, quality.makespan).count();
  open_.push_back({total, estimate_.steps, generated_++, prefix.node, std::move(preferred)});
  std::push_heap(open_.begin(), open_.end());
  return true;
}

Duration PlanCompletion::relaxed_makespan() {
  const PlanPrefix& prefix = successor_.prefix;
  const std::vector<Duration>& times = *space_.check().earliest(prefix);
  release_times_.measure(prefix.steps, times);
  started_.clear();
  for (const Running& running : prefix.running) started_.push_back(times[running.step]);
  return relaxed_schedule_.measure(
      {successor_.state, prefix.running_actions, prefix.timed_done, &release_times_, started_, prefix.steps});
}

}  // namespace roci::planner::temporal_pddl::improvement
