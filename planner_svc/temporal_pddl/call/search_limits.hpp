// How much a planning call may cost, and the check of it from inside long loops.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string_view>
#include <vector>

#include "planner_svc/temporal_pddl/call/progress.hpp"
#include "planner_svc/temporal_pddl/call/statistics.hpp"

namespace roci::planner::temporal_pddl::call {

/// How much a call may cost. The engine has no clock: `out_of_time` knows the deadline; it is polled like
/// Monitor::cancelled.
struct Budget {
  /// How many heuristic evaluations the first plan may take: work that does not depend on the machine.
  std::size_t evaluations = std::numeric_limits<std::size_t>::max();
  std::size_t memory_bytes = std::numeric_limits<std::size_t>::max();
  std::function<bool()> out_of_time;  ///< empty: the call has no deadline
};

/// What the caller sees of a running call. Either function may be empty.
struct Monitor {
  /// Gets the statistics so far now and then (about every thousand expansions).
  std::function<void(const Statistics&)> progress;
  /// Stops the work; it is polled at least about every millisecond, so it must be cheap.
  std::function<bool()> cancelled;
  /// Hears at each of these polls how far the call has come; so it must be cheap too.
  std::function<void(const Progress&)> watch;
};

/// Holds a call to its budget: every loop of the engine reports here and is ended by a PlanningFailure.
class SearchLimits {
 public:
  /// Both must outlive the limits.
  SearchLimits(const Budget& budget, const Monitor& monitor) : budget_(budget), monitor_(monitor) {}

  /// Says from now on what the call is doing; the text must stay.
  void phase(std::string_view what) { progress_.phase = what; }
  /// Says of the best plan so far what Progress tells of it.
  void plan_found(double metric, temporal::Duration makespan);
  /// Throws PlanningFailure (cancelled, timeout) if the caller or the clock wants the call to end.
  void poll() const;
  /// Polls once in a few hundred calls only: for steps of about a microsecond.
  void step() {
    if (++steps_ % 256 == 0) poll();
  }
  /// Keeps the peak, and throws PlanningFailure (out_of_memory) if the engine's memory would exceed the
  /// budget.
  void memory(std::size_t bytes);
  /// Counts so many bytes on top of all that is reported from now on, as they stay for good.
  void hold(std::size_t bytes) { held_bytes_ = bytes; }
  /// Does as memory() for what comes for a time on top of what was last reported there.
  void memory_on_top(std::size_t more);
  /// Does as memory_on_top() before the memory is taken.
  void require_room(std::size_t more) const;
  /// Throws PlanningFailure (timeout) if that many heuristic evaluations exceed the budget for the first
  /// plan.
  void evaluations(std::size_t count);
  /// Lets evaluations() pass everything from now on.
  void first_plan_found() { has_plan_ = true; }

  /// Searches set a mark, by ActionId, for each action whose facts hold in a state that they expand; null:
  /// nobody asks. The marks must outlive the searches.
  void mark_touched(std::vector<bool>* marks) { touched_ = marks; }
  std::vector<bool>* touched() const { return touched_; }

  void progress(const Statistics& statistics) const {
    if (monitor_.progress) monitor_.progress(statistics);
  }
  bool cancelled() const { return monitor_.cancelled && monitor_.cancelled(); }
  std::size_t memory_limit() const { return budget_.memory_bytes; }
  std::size_t peak_bytes() const { return peak_bytes_; }

 private:
  const Budget& budget_;
  const Monitor& monitor_;
  std::size_t steps_ = 0;
  std::size_t held_bytes_ = 0;
  bool has_plan_ = false;
  std::size_t bytes_ = 0;  // as last reported
  std::size_t peak_bytes_ = 0;
  Progress progress_;
  std::vector<bool>* touched_ = nullptr;
};

}  // namespace roci::planner::temporal_pddl::call
