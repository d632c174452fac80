// Attempts at an activity begin and end here: by start, success, failure, another attempt, cancel.
#pragma once

#include <string>
#include <vector>

#include "exec_svc/executive/contingency_runs.hpp"
#include "exec_svc/executive/deadlines.hpp"
#include "exec_svc/executive/run_state.hpp"

namespace roci::exec::executive {

/// Leads activities through their attempts: start, success, failure, retry and cancel.
class Attempts {
 public:
  /// All arguments must outlive this object.
  Attempts(RunState& state, ContingencyRuns& contingencies, const Deadlines& deadlines)
      : state_(&state), contingencies_(&contingencies), deadlines_(&deadlines) {}

  void start(Index activity, temporal::Time now);
  /// Sends the next command of its sequence. Returns false if there is none.
  bool send_next(Index activity, temporal::Time now);
  void succeed(Index activity, temporal::Time now);
  /// Ends the activity as failed: its contingency begins, or it fails alone, where the plan says so, or the
  /// plan is broken. With `still_commanded`, its owner may be at work, and is asked to stop first.
  void fail(Index activity, temporal::Time now, Breakage breakage, const std::string& reason,
            bool still_commanded);
  /// Does as fail(), but tries the activity again if it may.
  void fail_or_retry(Index activity, temporal::Time now, const std::string& reason);
  /// Asks its owner to stop it.
  void cancel(Index activity, temporal::Time now, AfterCancel after, const std::string& reason);
  /// Goes on after its contingency: the activity comes again, or the plan is broken.
  void resume_after(const ContingencyEnd& end, temporal::Time now);
  /// Checks the order of the ends observed since the last call. If two came in an order that the plan
  /// forbids, waiting cannot repair that, and the plan is broken.
  void check_order_of_ends();

 private:
  bool fails_alone(Index activity, Breakage breakage) const;
  void close_alone(Index activity, temporal::Time now, const std::string& reason);
  bool retry(Index activity, temporal::Time now, const std::string& reason);
  void try_again(Index activity, temporal::Time now, const std::string& reason);

  RunState* state_;
  ContingencyRuns* contingencies_;
  const Deadlines* deadlines_;
  std::vector<Index> ended_now_;  ///< observed ends since the last look at their order
};

}  // namespace roci::exec::executive
