// After a restart: what runs is as it was, but nobody knows what its owners did and heard meanwhile.
#include <utility>

#include "exec_svc/executive/plan_run.hpp"

namespace roci::exec::executive {

using temporal::Time;

void PlanRun::resume(Time now) {
  for (const Index activity : active_) {
    ActivityRun& run = runs_[activity];
    if (plan_.activities[activity].owner.empty() || run.phase == ActivityPhase::settling) continue;
    if (run.phase == ActivityPhase::contingency) {
      run.contingency.command_since = now;
      send_contingency(activity, CommandAction::query);
      continue;
    }
    run.asked = true;
    if (run.phase != ActivityPhase::running) run.phase_since = now;  // the time for an answer counts anew
    send(activity, CommandAction::query);
  }
}

/// False: the word is taken like any other. Only a query is answered with `unknown` while no cancel was sent;
/// late or not, the same key may always be sent again.
bool PlanRun::take_query_answer(Index activity, const CommandAck& ack, Time now) {
  ActivityRun& run = runs_[activity];
  const bool asked = std::exchange(run.asked, false);
  if (ack.stage == CommandStage::unknown && run.phase == ActivityPhase::sent) {
    run.phase_since = now;
    send(activity, CommandAction::execute);  // the key is the same: it is done once
    return true;
  }
  if (asked && ack.stage == CommandStage::accepted && run.phase == ActivityPhase::cancelling) {
    run.phase_since = now;
    send(activity, CommandAction::cancel);
    return true;
  }
  return false;
}

}  // namespace roci::exec::executive
