/// How attempts at an activity begin and end: start, success, failure, another attempt, cancel.
#pragma once

#include <string>
#include <vector>

#include "exec_svc/executive/contingency_runs.hpp"
#include "exec_svc/executive/deadlines.hpp"
#include "exec_svc/executive/run_state.hpp"

namespace roci::exec::executive {

class Attempts {
 public:
  /// All outlive this.
  Attempts(RunState& state, ContingencyRuns& contingencies, const Deadlines& deadlines)
      : state_(&state), contingencies_(&contingencies), deadlines_(&deadlines) {}

  void start(Index activity, temporal::Time now);
  /// Sends the next command of its sequence. False: there is none.
  bool send_next(Index activity, temporal::Time now);
  void succeed(Index activity, temporal::Time now);
  /// The activity has failed: its contingency begins, or it fails alone, where the plan says so, or the plan is
  /// broken. `still_commanded`: its owner may be at work, and is asked to stop first.
  void fail(Index activity, temporal::Time now, Breakage breakage, const std::string& reason,
            bool still_commanded);
  /// As fail(), but the activity is tried again if it may be.
  void fail_or_retry(Index activity, temporal::Time now, const std::string& reason);
  /// Asks its owner to stop it.
  void cancel(Index activity, temporal::Time now, AfterCancel after, const std::string& reason);
  /// After its contingency: the activity again, or a broken plan.
  void resume_after(const ContingencyEnd& end, temporal::Time now);
  /// Ends come as they come; two that came in the wrong order cannot be mended by waiting: the plan is
  /// broken. Looks at those since the last call.
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
