// What owners say of their commands, and that they are gone.
#include <limits>
#include <set>

#include "exec_svc/executive/plan_run.hpp"

namespace roci::exec::executive {

using temporal::ActivityState;
using temporal::Time;

namespace {

std::string with_reason(const std::string& what, const CommandAck& ack) {
  std::string text = what;
  if (!ack.code.empty()) text += " [" + ack.code + "]";
  return ack.reason.empty() ? text : text + ": " + ack.reason;
}

}  // namespace

bool PlanRun::take_ack(const CommandAck& ack, Time now) {
  const auto found = index_of_.find(ack.activity);
  if (found == index_of_.end()) return take_contingency_ack(ack, now);
  const Index activity = found->second;
  ActivityRun& run = runs_[activity];
  if (!run.active() || run.attempt != ack.attempt || plan_.activities[activity].owner.empty()) return false;
  if (run.phase == ActivityPhase::contingency) return false;
  if (take_query_answer(activity, ack, now)) return true;
  if (run.phase == ActivityPhase::cancelling) {
    take_cancel_answer(activity, ack, now);
    return true;
  }
  if (run.phase == ActivityPhase::settling) return ack.stage == CommandStage::completed;
  switch (ack.stage) {
    case CommandStage::accepted:
      if (run.phase == ActivityPhase::sent) {
        enter(activity, ActivityPhase::running, now);
        change(activity, ActivityState::running, run.reason);
      } else if (!ack.code.empty() || !ack.reason.empty()) {
        change(activity, ActivityState::running, with_reason("its owner repairs", ack));  // R146
      }
      return true;
    case CommandStage::completed:
      if (now > deadline(activity)) {
        fail(activity, now, Breakage::deadline_passed, "it ended after its deadline", false);
        return true;
      }
      enter(activity, ActivityPhase::settling, now);
      return true;
    case CommandStage::rejected:
      if (ack.code == "unknown-command" || ack.code == "unknown-component") {
        fail(activity, now, Breakage::refused_for_good, with_reason("rejected", ack), false);
      } else {
        fail_or_retry(activity, now, with_reason("rejected", ack));
      }
      return true;
    case CommandStage::failed:
      fail_or_retry(activity, now, with_reason("failed", ack));
      return true;
    case CommandStage::unknown:
      fail_or_retry(activity, now, with_reason("its owner does not know the command", ack));
      return true;
    case CommandStage::cancelled:
      fail(activity, now, Breakage::activity_failed, with_reason("cancelled by its owner", ack), false);
      return true;
    case CommandStage::cancel_failed:
      return false;
  }
  return false;
}

void PlanRun::lose_owner(const std::string& owner, Time now) {
  const std::set<Index> active = active_;
  const std::string lost = "owner " + owner + " is lost";
  for (const Index activity : active) {
    if (runs_[activity].phase == ActivityPhase::contingency) {
      if (contingency_owner(activity) == owner) end_contingency(activity, now, lost);
      continue;
    }
    if (plan_.activities[activity].owner != owner || runs_[activity].phase == ActivityPhase::settling)
      continue;
    const bool given_up = runs_[activity].phase == ActivityPhase::cancelling &&
                          runs_[activity].after_cancel != AfterCancel::retry;
    if (given_up && !starting()) {
      close(activity, now, ActivityState::failed, runs_[activity].reason + "; " + lost);
    } else {
      fail(activity, now, Breakage::activity_failed, lost, false);
    }
  }
}

void PlanRun::take_cancel_answer(Index activity, const CommandAck& ack, Time now) {
  ActivityRun& run = runs_[activity];
  if (ack.stage == CommandStage::accepted) return;  // crossed the cancel
  if (ack.stage == CommandStage::completed && run.after_cancel != AfterCancel::fail) {
    enter(activity, ActivityPhase::settling, now);
    if (run.after_cancel == AfterCancel::withdraw)
      close(activity, now, ActivityState::succeeded, "completed before the cancel");
    return;
  }
  if (ack.stage == CommandStage::cancel_failed) {
    cancel_is_over(activity, now, with_reason("cancel failed", ack));
    return;
  }
  const std::string reason = run.reason;
  if (run.after_cancel == AfterCancel::retry) {
    fail_or_retry(activity, now, reason);
  } else {
    const bool failed = run.after_cancel == AfterCancel::fail;
    if (failed && starting()) {
      fail(activity, now, Breakage::activity_failed, reason, false);
      return;
    }
    close(activity, now, failed ? ActivityState::failed : ActivityState::cancelled, reason);
  }
}

/// The cancel did not take: the command may still be running, and no contingency is begun on top of it.
void PlanRun::cancel_is_over(Index activity, Time now, const std::string& answer) {
  const std::string reason = runs_[activity].reason + "; " + answer;
  runs_[activity].contingencies_used = std::numeric_limits<std::uint32_t>::max();
  if (runs_[activity].after_cancel == AfterCancel::retry || starting()) {
    fail(activity, now, Breakage::activity_failed, reason, false);
  } else {
    close(activity, now, ActivityState::failed, reason);
  }
}

}  // namespace roci::exec::executive
