// The owner exchange covers what is exchanged with the owners of commands beyond the command itself: their
// answers, cancels and what becomes of them, queries after a restart, and that an owner is gone.
#pragma once

#include <string>

#include "exec_svc/executive/attempts.hpp"
#include "exec_svc/executive/contingency_runs.hpp"
#include "exec_svc/executive/deadlines.hpp"
#include "exec_svc/executive/run_state.hpp"

namespace roci::exec::executive {

/// Gives each answer of an owner to the attempt that it belongs to, and ignores what nobody awaits.
class OwnerExchange {
 public:
  /// All arguments must outlive this object.
  OwnerExchange(RunState& state, ContingencyRuns& contingencies, const Deadlines& deadlines,
                Attempts& attempts)
      : state_(&state), contingencies_(&contingencies), deadlines_(&deadlines), attempts_(&attempts) {}

  /// Returns false if nothing that matches is awaited.
  bool take_ack(const CommandAck& ack, temporal::Time now);
  void lose_owner(const std::string& owner, temporal::Time now);
  /// Takes in that the cancel did not take: the command may still be running, and no contingency is begun on
  /// top of it.
  void give_cancel_up(Index activity, temporal::Time now, const std::string& answer);
  /// Ends everything: asks owners to stop, closes what no owner works on.
  void withdraw_all(temporal::Time now);
  /// Asks an owner behind a link that has not answered in time what became of its command: the command, the
  /// cancel or the answer may be lost. Returns false if it was asked often enough, or there is no link.
  bool ask_again(Index activity, temporal::Time now);
  /// Asks what became of all that runs: every owner after a restart of the executive, or the named one alone
  /// after its own restart.
  void query_all(temporal::Time now, const std::string& owner = "");

 private:
  bool say_again(Index activity, temporal::Time now);
  bool take_query_answer(Index activity, const CommandAck& ack, temporal::Time now);
  void take_cancel_answer(Index activity, const CommandAck& ack, temporal::Time now);
  bool take_progress(Index activity, const CommandAck& ack, temporal::Time now);

  RunState* state_;
  ContingencyRuns* contingencies_;
  const Deadlines* deadlines_;
  Attempts* attempts_;
};

}  // namespace roci::exec::executive
