#include "planner_svc/temporal_pddl/call/search_limits.hpp"

#include <algorithm>

#include "planner_svc/temporal_pddl/call/planning_failure.hpp"

namespace roci::planner::temporal_pddl::call {

using temporal::Verdict;

void SearchLimits::plan_found(double metric, temporal::Duration makespan) {
  progress_.has_plan = true;
  progress_.metric = metric;
  progress_.makespan = makespan;
}

void SearchLimits::poll() const {
  if (monitor_.watch) monitor_.watch(progress_);
  if (cancelled()) throw PlanningFailure(Verdict::cancelled, "cancelled by the caller");
  if (budget_.out_of_time && budget_.out_of_time())
    throw PlanningFailure(Verdict::timeout, "the time limit is reached");
}

void SearchLimits::memory(std::size_t bytes) {
  bytes_ = bytes;
  memory_on_top(0);
}

void SearchLimits::memory_on_top(std::size_t more) {
  const std::size_t bytes = held_bytes_ + bytes_ + more;
  peak_bytes_ = std::max(peak_bytes_, bytes);
  require_room(more);
}

void SearchLimits::require_room(std::size_t more) const {
  if (held_bytes_ + bytes_ + more > budget_.memory_bytes)
    throw PlanningFailure(Verdict::out_of_memory, "the memory limit is reached");
}

void SearchLimits::evaluations(std::size_t count) {
  progress_.evaluated = count;
  if (!has_plan_ && count > budget_.evaluations)
    throw PlanningFailure(Verdict::timeout, "the limit of heuristic evaluations is reached");
}

}  // namespace roci::planner::temporal_pddl::call
