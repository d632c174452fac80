#include "planner_svc/temporal_pddl/search/goal_serialization.hpp"

#include <algorithm>
#include <random>
#include <utility>

namespace roci::planner::temporal_pddl::search {

using heuristics::FfHeuristic;
using task::ActionCompression, task::FactId, task::SnapId, task::StateLayout;

namespace {

constexpr std::size_t kMaxSubgoals = 8;  // from one state
constexpr int kVainPlans = 4;            // plans that are followed although their goal comes no nearer

// Returns whether two facts of one variable cannot both hold. What negations are of is not known here: they
// count as consistent.
bool inconsistent(const StateLayout& layout, FactId a, FactId b) {
  return a != b && !layout.is_negation(a) && !layout.is_negation(b);
}

}  // namespace

GoalSerialization::GoalSerialization(const SearchContext& context, const Guide& guide, FfHeuristic& ff,
                                     ActionCompression compression)
    : context_(context),
      task_(context.task),
      guide_(guide),
      ff_(ff),
      space_(context.task, context.options.epsilon, compression, context.limits.touched()),
      goal_test_(context.task, space_.check(), context.options.epsilon),
      evaluation_(context.task),
      lookahead_(context.task, space_),
      goals_of_(context.task.layout.variables().size()) {
  if (context.task.goals.size() == 1) goals_ = context.task.goals.front().facts;
  if (context.options.seed != 0) std::ranges::shuffle(goals_, std::mt19937_64(context.options.seed));
  for (std::uint32_t i = 0; i < goals_.size(); ++i)
    goals_of_[context.task.layout.variable_of(goals_[i])].push_back(i);
}

std::optional<SearchOutcome> GoalSerialization::run(std::size_t evaluations, std::size_t bytes_elsewhere) {
  const auto found = [&] { return SearchOutcome{std::move(state_.prefix), std::move(state_.state), {}}; };
  const std::size_t until = evaluated_ + evaluations;
  if (space_.store().size() == 0 && begin()) return found();
  while (evaluated_ < until) {
    if (subgoal_ == subgoals_.size()) return SearchOutcome{};
    const Step step = follow();
    if (step == Step::found) return found();
    if (step == Step::in_vain) take_up(subgoal_ + 1);
    context_.limits.memory(bytes() + bytes_elsewhere + guide_.bytes());
  }
  return std::nullopt;
}

// Sets out from the initial state. Returns whether nothing is to be done.
bool GoalSerialization::begin() {
  state_.state = task_.initial_state;
  space_.add(NodeId(), state_);
  if (goal_test_.complete(state_.state, state_.prefix)) return true;
  if (look_at()) survey();
  return false;
}

// Follows the relaxed plan of the subgoal at hand once.
GoalSerialization::Step GoalSerialization::follow() {
  context_.limits.poll();
  if (!lookahead_.follow(state_.prefix, plan_, false, next_)) return Step::in_vain;
  std::swap(state_, next_);
  if (goal_test_.complete(state_.state, state_.prefix)) return Step::found;
  if (guide_.detectors.prove_dead_end(state_.state, state_.prefix.running_actions, space_.steps()) ||
      !look_at())
    return Step::in_vain;
  const FactId goal = subgoals_[subgoal_].goal;
  if (task_.layout.holds(state_.state, goal)) return survey() ? Step::further : Step::in_vain;
  const auto distance = ff_.distance(goal);
  if (!distance) return Step::in_vain;
  in_vain_ = *distance < nearest_ ? 0 : in_vain_ + 1;
  nearest_ = std::min(nearest_, *distance);
  if (in_vain_ == kVainPlans) return Step::in_vain;
  ff_.plan_for(goal, plan_);
  return Step::further;
}

bool GoalSerialization::look_at() {
  ++evaluated_;
  context_.limits.evaluations(++context_.statistics.evaluated);
  return ff_.look_at(evaluation_.context_of(state_));
}

// Surveys the state at hand, which has been looked at. Returns whether it is the best so far; its subgoals
// are next then.
bool GoalSerialization::survey() {
  undone_.assign(goals_.size(), false);
  std::vector<Subgoal> subgoals;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    if (task_.layout.holds(state_.state, goals_[i])) continue;
    const auto distance = ff_.distance(goals_[i]);
    if (!distance) return false;
    subgoals.push_back({false, *distance, goals_[i]});
    ff_.plan_for(goals_[i], subgoals.back().plan);
    mark_undone(subgoals.back().plan, i);
  }
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    if (task_.layout.holds(state_.state, goals_[i]) && !undone_[i]) ++kept;
  }
  if (space_.store().size() > 1 && kept <= kept_) return false;
  for (Subgoal& subgoal : subgoals)
    subgoal.waits =
        undone_[static_cast<std::size_t>(std::ranges::find(goals_, subgoal.goal) - goals_.begin())];
  std::ranges::stable_sort(subgoals, {}, [](const Subgoal& p) { return std::pair(p.waits, p.distance); });
  if (subgoals.size() > kMaxSubgoals) subgoals.resize(kMaxSubgoals);
  kept_ = kept;
  base_ = state_;
  subgoals_ = std::move(subgoals);
  take_up(0);
  return true;
}

// Marks goals that the relaxed plan of another one undoes or needs undone.
void GoalSerialization::mark_undone(std::span<const SnapId> plan, std::size_t goal) {
  const auto mark = [&](FactId fact, bool deleted) {
    for (const std::uint32_t i : goals_of_[task_.layout.variable_of(fact)]) {
      const bool undone = deleted ? goals_[i] == fact && task_.layout.holds(state_.state, fact)
                                  : inconsistent(task_.layout, goals_[i], fact);
      if (i != goal && undone) undone_[i] = true;
    }
  };
  for (const SnapId snap : plan) {
    for (const FactId fact : task_.deletes[snap]) mark(fact, true);
    for (const FactId fact : task_.conditions[snap]) mark(fact, false);
  }
}

void GoalSerialization::take_up(std::size_t subgoal) {
  subgoal_ = subgoal;
  if (subgoal == subgoals_.size()) return;
  state_ = base_;
  plan_ = subgoals_[subgoal].plan;
  nearest_ = subgoals_[subgoal].distance;
  in_vain_ = 0;
}

}  // namespace roci::planner::temporal_pddl::search
