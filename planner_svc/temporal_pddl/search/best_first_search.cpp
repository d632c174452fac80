#include "planner_svc/temporal_pddl/search/best_first_search.hpp"

#include <algorithm>

#include "planner_svc/temporal_pddl/call/planning_failure.hpp"
#include "planner_svc/temporal_pddl/search/failure_diagnosis.hpp"

namespace roci::planner::temporal_pddl::search {

using call::PlanningFailure;
using task::ActionCompression;
using temporal::Verdict;

namespace {

constexpr int kPatience = 8;   // relaxed plans that are followed although the estimate does not fall
constexpr int kCarefully = 4;  // of these, the first ones; the others in the order of the relaxed plan

}  // namespace

BestFirstSearch::BestFirstSearch(const SearchContext& context, const Guide& guide, SearchStyle style)
    : context_(context),
      task_(context.task),
      guide_(guide),
      follows_plans_(style.lookahead),
      complete_(style.steps == ActionCompression::where_safe),
      space_(context.task, context.options.epsilon, style.steps, context.limits.touched()),
      goal_(context.task, space_.check(), context.options.epsilon),
      dominance_(context.task, space_.store(), space_.bounds(), space_.check(), context.options.epsilon,
                 goal_.has_deadlines()),
      dominate_(context.options.dominance && !goal_.has_openings()),
      evaluation_(context.task),
      open_({context.options.landmarks && dominate_, context.options.novelty && dominate_}),
      novelty_(context.task),
      lookahead_(context.task, space_),
      random_(context.options.seed) {}

std::optional<SearchOutcome> BestFirstSearch::run(std::size_t evaluations, std::size_t bytes_elsewhere) {
  bytes_elsewhere_ = bytes_elsewhere;
  const std::size_t until = evaluations > SIZE_MAX - evaluated_ ? SIZE_MAX : evaluated_ + evaluations;
  if (space_.store().size() == 0) {
    successor_.state = task_.initial_state;
    if (reach(NodeId())) return found();
  }
  while (evaluated_ < until) {
    const auto entry = open_.pop();
    if (!entry) {
      if (too_long_)
        throw PlanningFailure(Verdict::out_of_memory,
                              "a plan may have at most 32767 steps, and none so short was found");
      return failed();
    }
    context_.limits.poll();
    if (prefix_.node != entry->parent) space_.restore(entry->parent, prefix_);
    const Rejection rejection = space_.build(prefix_, entry->snap, successor_);
    if (rejection == Rejection::temporal) ++context_.statistics.temporally_inconsistent;
    if (rejection != Rejection::none) continue;
    if (is_too_long(successor_.prefix)) {
      too_long_ = true;
      continue;
    }
    if (guide_.detectors.prove_dead_end(successor_.state, successor_.prefix.running_actions,
                                        space_.steps())) {
      ++context_.statistics.dead_ends;
      continue;
    }
    if (dominate_ && dominance_.dominated(successor_)) {
      ++context_.statistics.dominated;
      continue;
    }
    if (reach(entry->parent)) return found();
  }
  return std::nullopt;
}

SearchOutcome BestFirstSearch::found() {
  return {std::move(successor_.prefix), std::move(successor_.state), {}};
}

SearchOutcome BestFirstSearch::failed() const {
  std::string reason = goal_.failure_reason(space_.store().size(), context_.statistics.dead_ends > 0);
  const std::string number = unmet_comparison(task_, space_.store());
  if (!number.empty()) reason += "; " + number;
  std::vector<call::BlockedFact> blocked;
  for (std::string& fact : goal_.never_held()) blocked.push_back({std::move(fact), number});
  return {std::nullopt, {}, std::move(reason), std::move(blocked)};
}

// Stores the state in successor_ and takes it up, and then what its relaxed plan leads to as long as that is
// nearer to the goals. Returns whether successor_ is a goal state.
bool BestFirstSearch::reach(NodeId parent) {
  space_.add(parent, successor_);
  if (take_up()) return true;
  Priority best = by_plan();
  int in_vain = 0;
  while (follows_plans_ && in_vain < kPatience && !estimate_.dead_end) {
    if (!look_ahead(in_vain < kCarefully)) return false;
    if (take_up()) return true;
    const bool nearer = by_plan() < best;
    in_vain = nearer ? 0 : in_vain + 1;
    if (nearer) best = by_plan();
  }
  return false;
}

// Follows the relaxed plan to a stored state in successor_. Returns whether it is new and no known dead end.
bool BestFirstSearch::look_ahead(bool careful) {
  if (!lookahead_.follow(successor_.prefix, estimate_.relaxed_plan, careful, ahead_)) return false;
  std::swap(successor_, ahead_);
  return !guide_.detectors.prove_dead_end(successor_.state, successor_.prefix.running_actions,
                                          space_.steps()) &&
         !(dominate_ && dominance_.dominated(successor_));
}

// Evaluates the stored state in successor_ and queues what can follow. Returns whether it is a goal state.
bool BestFirstSearch::take_up() {
  PlanPrefix& prefix = successor_.prefix;
  if (dominate_) dominance_.insert(prefix.node, successor_.state, prefix);
  if (goal_.complete(successor_.state, prefix)) return true;

  context_.limits.poll();
  ++evaluated_;
  context_.limits.evaluations(++context_.statistics.evaluated);
  evaluation_.evaluate(successor_, guide_, estimate_);
  if (!estimate_.dead_end) expand(prefix);
  account();
  return false;
}

void BestFirstSearch::expand(const PlanPrefix& prefix) {
  ++context_.statistics.expanded;
  const Priority by_plan = this->by_plan();
  const Priority by_landmarks{estimate_.landmarks, estimate_.steps};
  const bool shorter = by_plan < best_plan_;
  const bool fewer_landmarks = estimate_.landmarks < best_landmarks_;
  if (shorter) best_plan_ = by_plan;
  if (fewer_landmarks) best_landmarks_ = estimate_.landmarks;
  if (shorter || fewer_landmarks) open_.boost();
  const auto applicable = space_.applicable(prefix);
  candidates_.assign(applicable.begin(), applicable.end());
  if (context_.options.seed != 0) std::ranges::shuffle(candidates_, random_);
  if (!context_.options.preferred_operators) estimate_.preferred.clear();
  std::ranges::sort(estimate_.preferred);
  const std::int64_t news =
      context_.options.novelty ? novelty_.see(successor_.state, prefix.running_actions, estimate_.steps) : 0;
  open_.push({by_plan, by_landmarks, {-news, estimate_.steps}}, prefix.node, candidates_,
             estimate_.preferred);
  context_.statistics.generated += candidates_.size();
}

void BestFirstSearch::account() {
  context_.statistics.bytes_per_state = space_.store().mean_bytes_per_state();
  context_.limits.memory(bytes() + bytes_elsewhere_ + guide_.bytes());
  if (context_.statistics.expanded % 1024 == 0) context_.limits.progress(context_.statistics);
}

}  // namespace roci::planner::temporal_pddl::search
