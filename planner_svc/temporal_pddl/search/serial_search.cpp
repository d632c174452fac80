#include "planner_svc/temporal_pddl/search/serial_search.hpp"

#include <algorithm>
#include <random>
#include <utility>

namespace roci::planner::temporal_pddl {

namespace {

constexpr std::size_t kMostPursuits = 8;  // from one state
constexpr int kPatience = 4;              // plans that are followed although their goal comes no nearer

// Of one variable: can they not both hold? What negations are of is not known here: they err on the safe
// side.
bool inconsistent(const StateLayout& layout, FactId a, FactId b) {
  return a != b && !layout.is_negation(a) && !layout.is_negation(b);
}

}  // namespace

SerialSearch::SerialSearch(const Task& task, Heuristic& pruning, FfHeuristic& ff, const Options& options,
                           ActionSteps steps, Watch& watch, Statistics& statistics)
    : task_(task),
      pruning_(pruning),
      ff_(ff),
      watch_(watch),
      statistics_(statistics),
      space_(task, options.epsilon, steps),
      goal_test_(task, space_.check(), options.epsilon),
      evaluation_(task),
      lookahead_(task, space_),
      goals_of_(task.layout.variables().size()) {
  if (task.goals.size() == 1) goals_ = task.goals.front().facts;
  if (options.seed != 0) std::ranges::shuffle(goals_, std::mt19937_64(options.seed));
  for (std::uint32_t i = 0; i < goals_.size(); ++i)
    goals_of_[task.layout.variable_of(goals_[i])].push_back(i);
}

std::optional<SearchOutcome> SerialSearch::run(std::size_t evaluations, std::size_t bytes_elsewhere) {
  const auto found = [&] { return SearchOutcome{std::move(state_.prefix), std::move(state_.state), {}}; };
  const std::size_t until = evaluated_ + evaluations;
  if (space_.store().size() == 0 && begin()) return found();
  while (evaluated_ < until) {
    if (pursuit_ == pursuits_.size()) return SearchOutcome{};
    const Step step = follow();
    if (step == Step::found) return found();
    if (step == Step::in_vain) take_up(pursuit_ + 1);
    watch_.memory(bytes() + bytes_elsewhere + pruning_.bytes());
  }
  return std::nullopt;
}

// True: nothing is to be done.
bool SerialSearch::begin() {
  state_.state = task_.initial_state;
  space_.add(NodeId(), state_);
  if (goal_test_.complete(state_.state, state_.prefix)) return true;
  if (look_at()) survey();
  return false;
}

// Of the pursuit at hand, once.
SerialSearch::Step SerialSearch::follow() {
  watch_.poll();
  if (!lookahead_.follow(state_.prefix, plan_, false, next_)) return Step::in_vain;
  std::swap(state_, next_);
  if (goal_test_.complete(state_.state, state_.prefix)) return Step::found;
  if (pruning_.hopeless(state_.state, state_.prefix.running_actions, space_.steps()) || !look_at())
    return Step::in_vain;
  const FactId goal = pursuits_[pursuit_].goal;
  if (task_.layout.holds(state_.state, goal)) return survey() ? Step::further : Step::in_vain;
  const auto distance = ff_.distance(goal);
  if (!distance) return Step::in_vain;
  in_vain_ = *distance < nearest_ ? 0 : in_vain_ + 1;
  nearest_ = std::min(nearest_, *distance);
  if (in_vain_ == kPatience) return Step::in_vain;
  ff_.plan_for(goal, plan_);
  return Step::further;
}

bool SerialSearch::look_at() {
  ++evaluated_;
  watch_.evaluations(++statistics_.evaluated);
  return ff_.look_at(evaluation_.situation(state_));
}

// Of the state at hand, which has been looked at. True: it is the best so far, and its pursuits are next.
bool SerialSearch::survey() {
  undone_.assign(goals_.size(), false);
  std::vector<Pursuit> pursuits;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    if (task_.layout.holds(state_.state, goals_[i])) continue;
    const auto distance = ff_.distance(goals_[i]);
    if (!distance) return false;
    pursuits.push_back({false, *distance, goals_[i]});
    ff_.plan_for(goals_[i], pursuits.back().plan);
    mark_undone(pursuits.back().plan, i);
  }
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    if (task_.layout.holds(state_.state, goals_[i]) && !undone_[i]) ++kept;
  }
  if (space_.store().size() > 1 && kept <= kept_) return false;
  for (Pursuit& pursuit : pursuits)
    pursuit.waits =
        undone_[static_cast<std::size_t>(std::ranges::find(goals_, pursuit.goal) - goals_.begin())];
  std::ranges::stable_sort(pursuits, {}, [](const Pursuit& p) { return std::pair(p.waits, p.distance); });
  if (pursuits.size() > kMostPursuits) pursuits.resize(kMostPursuits);
  kept_ = kept;
  base_ = state_;
  pursuits_ = std::move(pursuits);
  take_up(0);
  return true;
}

// Goals that the relaxed plan of another one undoes or needs undone.
void SerialSearch::mark_undone(std::span<const SnapId> plan, std::size_t goal) {
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

void SerialSearch::take_up(std::size_t pursuit) {
  pursuit_ = pursuit;
  if (pursuit == pursuits_.size()) return;
  state_ = base_;
  plan_ = pursuits_[pursuit].plan;
  nearest_ = pursuits_[pursuit].distance;
  in_vain_ = 0;
}

}  // namespace roci::planner::temporal_pddl
