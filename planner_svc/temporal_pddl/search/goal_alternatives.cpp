#include "planner_svc/temporal_pddl/search/goal_alternatives.hpp"

#include <algorithm>

#include "planner_svc/temporal_pddl/heuristics/landmark_count.hpp"
#include "planner_svc/temporal_pddl/search/best_first_search.hpp"

namespace roci::planner::temporal_pddl::search {

using heuristics::FfHeuristic, heuristics::Heuristic, heuristics::LandmarkCount;
using task::Task;

namespace {

constexpr std::size_t kMostAlternatives = 16;
constexpr std::size_t kFirstBudget = 100;  // evaluations

Task with_goal(const Task& task, std::size_t alternative) {
  Task out = task;
  out.goals = {task.goals[alternative]};
  out.derived_goal_reads = {};
  out.derived_goal_reads.push_back(task.derived_goal_reads[alternative]);
  return out;
}

}  // namespace

// Is the search for one alternative, with all that knows of no other one.
struct GoalAlternatives::Attempt {
  Attempt(const SearchContext& of, const Guide& guide, task::ActionCompression compression,
          std::size_t alternative)
      : task(with_goal(of.task, alternative)), context{task, of.options, of.limits, of.statistics}, ff(task) {
    if (of.options.landmarks) landmarks.emplace(task, ff, of.limits);
    Heuristic& heuristic = landmarks ? static_cast<Heuristic&>(*landmarks) : ff;
    search.emplace(context, Guide{heuristic, guide.detectors, guide.measure}, SearchStyle{compression, true});
  }
  std::size_t bytes() const {
    return task.bytes() + (landmarks ? landmarks->bytes() : ff.bytes()) + search->bytes();
  }

  Task task;
  SearchContext context;
  FfHeuristic ff;
  std::optional<LandmarkCount> landmarks;
  std::optional<BestFirstSearch> search;
  std::size_t evaluated = 0;
};

bool GoalAlternatives::has_some(const Task& task) {
  return task.goals.size() > 1 && task.goals.size() <= kMostAlternatives;
}

GoalAlternatives::GoalAlternatives(const SearchContext& context, const Guide& guide,
                                   task::ActionCompression compression)
    : context_(context),
      guide_(guide),
      compression_(compression),
      turns_left_(context.task.goals.size()),
      budget_(kFirstBudget) {
  for (std::size_t i = 0; i < context.task.goals.size(); ++i) open_.push_back(i);
}

GoalAlternatives::~GoalAlternatives() = default;

std::optional<SearchOutcome> GoalAlternatives::run(std::size_t evaluations, std::size_t bytes_elsewhere) {
  while (evaluations > 0) {
    if (open_.empty()) return SearchOutcome{};
    if (!attempt_) attempt_ = std::make_unique<Attempt>(context_, guide_, compression_, open_.front());
    const std::size_t turn = std::min(evaluations, budget_ - attempt_->evaluated);
    const std::size_t elsewhere = bytes_elsewhere + attempt_->bytes() - attempt_->search->bytes();
    auto outcome = attempt_->search->run(turn, elsewhere);
    if (outcome && outcome->plan) return outcome;
    evaluations -= turn;
    attempt_->evaluated += turn;
    if (!outcome && attempt_->evaluated < budget_) continue;
    attempt_.reset();
    if (!outcome) open_.push_back(open_.front());
    open_.pop_front();
    if (--turns_left_ > 0) continue;
    turns_left_ = open_.size();
    budget_ *= 2;
  }
  return std::nullopt;
}

std::size_t GoalAlternatives::bytes() const { return attempt_ ? attempt_->bytes() : 0; }

}  // namespace roci::planner::temporal_pddl::search
