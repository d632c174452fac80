#include "planner_svc/temporal_pddl/search/best_first_width_search.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::search {

using task::ActionCompression, task::ActionId, task::FactId, task::Goal, task::NumericCondition, task::SnapId,
    task::StateView;

namespace {

// As states cost less than evaluations, by a factor of four to twenty, this search gets the largest share of
// the time where evaluations are cheap, and about half of it where they are dear.
constexpr std::size_t kStatesPerEvaluation = 32;
constexpr std::size_t kPairsPerState = 512;  // of facts, likewise
constexpr std::size_t kMemoryShare = 4;

}  // namespace

BestFirstWidthSearch::BestFirstWidthSearch(const SearchContext& context, const Guide& guide,
                                           ActionCompression compression)
    : context_(context),
      task_(context.task),
      guide_(guide),
      semantics_(context.task),
      space_(context.task, context.options.epsilon, compression, context.limits.touched()),
      goal_(context.task, space_.check(), context.options.epsilon),
      dominance_(context.task, space_.store(), space_.bounds(), space_.check(), context.options.epsilon,
                 goal_.has_deadlines()),
      evaluation_(context.task),
      novelty_(context.task.fact_names.size()),
      seed_(context.options.seed),
      random_(context.options.seed),
      missing_(context.task.fact_names.size(), false),
      held_(context.task.fact_names.size() + context.task.actions.size(), false) {}

std::size_t BestFirstWidthSearch::bytes() const {
  return space_.store().bytes() + dominance_.bytes() + novelty_.bytes() + open_.bytes() +
         progress_.capacity() * sizeof(Progress) + milestones_.capacity() * sizeof(Milestone) +
         milestone_bytes_;
}

std::optional<SearchOutcome> BestFirstWidthSearch::run(std::size_t evaluations, std::size_t bytes_elsewhere) {
  const auto found = [&] {
    return SearchOutcome{std::move(successor_.prefix), std::move(successor_.state), {}};
  };
  const std::size_t until = work_ + evaluations * kStatesPerEvaluation;
  if (space_.store().size() == 0) {
    successor_.state = task_.initial_state;
    if (reach(NodeId())) return found();
  }
  while (work_ < until) {
    if (open_.empty() || bytes() > context_.limits.memory_limit() / kMemoryShare) return SearchOutcome{};
    const NodeId node = open_.oldest();
    open_.drop_oldest();
    if (expand(node)) return found();
    context_.limits.memory(bytes() + bytes_elsewhere + guide_.bytes());
    if (++context_.statistics.expanded % 1024 == 0) context_.limits.progress(context_.statistics);
  }
  return std::nullopt;
}

// Builds and queues the successors of the node. Returns whether successor_ is a goal state.
bool BestFirstWidthSearch::expand(NodeId node) {
  context_.limits.poll();
  space_.restore(node, prefix_);
  look_back();
  list_facts(space_.store().state(node), prefix_.running_actions, facts_);
  for (const std::uint32_t fact : facts_) held_[fact] = true;
  const auto applicable = space_.applicable(prefix_);
  candidates_.assign(applicable.begin(), applicable.end());
  if (seed_ != 0) std::ranges::shuffle(candidates_, random_);
  context_.statistics.generated += candidates_.size();
  const bool found = std::ranges::any_of(candidates_, [&](SnapId snap) {
    if (space_.build(prefix_, snap, successor_) != Rejection::none) return false;
    if (guide_.detectors.prove_dead_end(successor_.state, successor_.prefix.running_actions,
                                        space_.steps())) {
      ++context_.statistics.dead_ends;
      return false;
    }
    return !dominance_.dominated(successor_) && reach(node);
  });
  for (const std::uint32_t fact : facts_) held_[fact] = false;
  for (const FactId fact : milestones_[progress_[node.index()].milestone].wanted) missing_[fact] = false;
  return found;
}

// Queues the state in successor_ if it is new. Returns whether it is a goal state.
bool BestFirstWidthSearch::reach(NodeId parent) {
  PlanPrefix& prefix = successor_.prefix;
  if (is_too_long(prefix)) return false;
  account(1);
  if (goal_.complete(successor_.state, prefix)) {
    space_.add(parent, successor_);
    return true;
  }
  const auto own = progress(parent);
  const int news = own ? novelty(*own, parent) : PairNovelty::kNothingNew;
  if (own && news == PairNovelty::kNothingNew) return false;
  space_.add(parent, successor_);  // dead ends too, so as not to evaluate them again
  dominance_.insert(prefix.node, successor_.state, prefix);
  progress_.push_back(own.value_or(Progress()));
  if (own) open_.push({news, own->open_goals}, prefix.node);
  return false;
}

// Returns the progress of the state in successor_, or nothing for a dead end.
std::optional<BestFirstWidthSearch::Progress> BestFirstWidthSearch::progress(NodeId parent) {
  Progress result{0, open_goals(successor_.state), 0};
  if (parent.is_none() || result.open_goals < progress_[parent.index()].open_goals) {
    const auto milestone = set_milestone();
    if (!milestone) return std::nullopt;
    result.milestone = *milestone;
  } else {
    result.milestone = progress_[parent.index()].milestone;
    result.reached = progress_[parent.index()].reached + newly_reached();
  }
  return result;
}

std::optional<std::uint32_t> BestFirstWidthSearch::set_milestone() {
  account(kStatesPerEvaluation);
  evaluation_.evaluate(successor_, guide_, estimate_);
  if (estimate_.dead_end) return std::nullopt;
  Milestone milestone{successor_.prefix.steps.size(), {}};
  for (const SnapId snap : estimate_.relaxed_plan) {
    const auto adds = task_.adds[snap];
    milestone.wanted.insert(milestone.wanted.end(), adds.begin(), adds.end());
  }
  std::ranges::sort(milestone.wanted);
  const auto rest = std::ranges::unique(milestone.wanted);
  milestone.wanted.erase(rest.begin(), rest.end());
  milestone.wanted.shrink_to_fit();
  milestone_bytes_ += milestone.wanted.capacity() * sizeof(FactId);
  milestones_.push_back(std::move(milestone));
  return static_cast<std::uint32_t>(milestones_.size() - 1);
}

void BestFirstWidthSearch::account(std::size_t work) {
  context_.statistics.evaluated -= work_ / kStatesPerEvaluation;
  work_ += work;
  context_.statistics.evaluated += work_ / kStatesPerEvaluation;
  context_.limits.evaluations(context_.statistics.evaluated);
}

// Returns the open goals of the alternative that has the fewest.
std::uint32_t BestFirstWidthSearch::open_goals(StateView state) const {
  std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
  for (const Goal& goal : task_.goals) {
    const auto open =
        std::ranges::count_if(goal.facts, [&](FactId fact) { return !task_.layout.holds(state, fact); });
    const auto unmet = std::ranges::count_if(goal.comparisons, [&](const NumericCondition& condition) {
      return !semantics_.satisfied(condition, state);
    });
    fewest = std::min(fewest, static_cast<std::uint32_t>(open + unmet));
  }
  return fewest;
}

// Marks in missing_ what the milestone's relaxed plan adds and the plan in prefix_ has not reached.
void BestFirstWidthSearch::look_back() {
  const Milestone& milestone = milestones_[progress_[prefix_.node.index()].milestone];
  for (const FactId fact : milestone.wanted) missing_[fact] = true;
  for (std::size_t i = milestone.steps; i < prefix_.steps.size(); ++i) {
    for (const FactId fact : task_.adds[prefix_.steps[i]]) missing_[fact] = false;
  }
}

// Returns how many facts of missing_ the last steps of successor_ reach.
std::uint32_t BestFirstWidthSearch::newly_reached() {
  news_.clear();
  for (std::size_t i = prefix_.steps.size(); i < successor_.prefix.steps.size(); ++i) {
    for (const FactId fact : task_.adds[successor_.prefix.steps[i]]) {
      if (!missing_[fact]) continue;
      missing_[fact] = false;
      news_.push_back(fact);
    }
  }
  for (const FactId fact : news_) missing_[fact] = true;
  return static_cast<std::uint32_t>(news_.size());
}

void BestFirstWidthSearch::list_facts(StateView state, std::span<const ActionId> running,
                                      std::vector<std::uint32_t>& facts) const {
  facts.clear();
  const auto variables = task_.layout.variables();
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const std::uint32_t value = task_.layout.value(state, i);
    if (value > 0) facts.push_back(variables[i].facts[value - 1].value);
  }
  for (const ActionId action : running)
    facts.push_back(static_cast<std::uint32_t>(task_.fact_names.size() + action.index()));
}

// Returns the novelty of the state in successor_ among those with the same progress, and notes the state as
// seen.
int BestFirstWidthSearch::novelty(const Progress& progress, NodeId parent) {
  list_facts(successor_.state, successor_.prefix.running_actions, successor_facts_);
  const bool same_kind = !parent.is_none() && progress_[parent.index()].open_goals == progress.open_goals &&
                         progress_[parent.index()].reached == progress.reached;
  fresh_.clear();
  for (const std::uint32_t fact : successor_facts_) {
    if (!same_kind || !held_[fact]) fresh_.push_back(fact);
  }
  account(successor_facts_.size() * fresh_.size() / kPairsPerState);
  return novelty_.see(successor_facts_, fresh_, std::uint64_t{progress.open_goals} << 32 | progress.reached);
}

}  // namespace roci::planner::temporal_pddl::search
