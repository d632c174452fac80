#include "exec_svc/executive/owner_exchange.hpp"

#include <set>
#include <utility>

namespace roci::exec::executive {

using temporal::ActivityState;
using temporal::Time;

namespace {

// Bounds how often a command is sent again in a later epoch before it counts as rejected.
constexpr std::uint32_t kRefusals = 8;

std::string with_reason(const std::string& what, const CommandAck& ack) {
  std::string text = what;
  if (!ack.code.empty()) text += " [" + ack.code + "]";
  return ack.reason.empty() ? text : text + ": " + ack.reason;
}

}  // namespace

bool OwnerExchange::take_ack(const CommandAck& ack, Time now) {
  const auto found = state_->index_of.find(ack.activity);
  if (found == state_->index_of.end()) {
    if (!contingencies_->expects(ack)) return false;
    if (const auto end = contingencies_->take(ack, now)) attempts_->resume_after(*end, now);
    return true;
  }
  const Index activity = found->second;
  const ActivityRun& run = state_->runs[activity];
  const bool same_key = run.attempt == ack.attempt && (ack.epoch == 0 || ack.epoch == run.epoch);
  if (!run.active() || !same_key || state_->plan.activities[activity].owner.empty()) return false;
  if (run.phase == ActivityPhase::contingency) return false;
  if (ack.refused_epoch && run.refusals < kRefusals) return say_again(activity, now);
  if (take_query_answer(activity, ack, now)) return true;
  if (run.phase == ActivityPhase::cancelling) {
    take_cancel_answer(activity, ack, now);
    return true;
  }
  if (run.phase == ActivityPhase::settling) return ack.stage == CommandStage::completed;
  return take_progress(activity, ack, now);
}

/// Sends again what was refused: a command gets a key of the epoch that has begun since; a query and a cancel
/// keep the key of their command.
bool OwnerExchange::say_again(Index activity, Time now) {
  ActivityRun& run = state_->runs[activity];
  ++run.refusals;
  if (run.asked) {
    state_->send(activity, CommandAction::query);
  } else if (run.phase == ActivityPhase::cancelling) {
    state_->send(activity, CommandAction::cancel);
  } else if (run.phase == ActivityPhase::sent) {
    run.epoch = state_->epoch;
    run.plan = state_->plan.version;
    state_->send(activity, CommandAction::execute);
  } else {
    return false;
  }
  run.phase_since = run.phase == ActivityPhase::running ? run.phase_since : now;
  return true;
}

bool OwnerExchange::take_progress(Index activity, const CommandAck& ack, Time now) {
  const ActivityRun& run = state_->runs[activity];
  switch (ack.stage) {
    case CommandStage::accepted:
      if (run.phase == ActivityPhase::sent) {
        state_->enter(activity, ActivityPhase::running, now);
        state_->change(activity, ActivityState::running, run.reason);
      } else if (!ack.code.empty() || !ack.reason.empty()) {
        state_->change(activity, ActivityState::running, with_reason("its owner repairs", ack));  // R146
      }
      return true;
    case CommandStage::completed:
      if (now > deadlines_->end(activity)) {
        attempts_->fail(activity, now, Breakage::deadline_passed, "it ended after its deadline", false);
        return true;
      }
      if (!attempts_->send_next(activity, now)) state_->enter(activity, ActivityPhase::settling, now);
      return true;
    case CommandStage::rejected:
      if (ack.code == "unknown-command" || ack.code == "unknown-component") {
        attempts_->fail(activity, now, Breakage::refused_for_good, with_reason("rejected", ack), false);
      } else {
        attempts_->fail_or_retry(activity, now, with_reason("rejected", ack));
      }
      return true;
    case CommandStage::failed:
      attempts_->fail_or_retry(activity, now, with_reason("failed", ack));
      return true;
    case CommandStage::unknown:
      attempts_->fail_or_retry(activity, now, with_reason("its owner does not know the command", ack));
      return true;
    case CommandStage::cancelled:
      attempts_->fail(activity, now, Breakage::activity_failed, with_reason("cancelled by its owner", ack),
                      false);
      return true;
    case CommandStage::cancel_failed:
      return false;
  }
  return false;
}

void OwnerExchange::lose_owner(const std::string& owner, Time now) {
  const std::set<Index> active = state_->active;
  const std::string lost = "owner " + owner + " is lost";
  for (const Index activity : active) {
    const ActivityRun& run = state_->runs[activity];
    if (run.phase == ActivityPhase::contingency) {
      if (const auto end = contingencies_->lose_owner(activity, owner, lost))
        attempts_->resume_after(*end, now);
      continue;
    }
    if (state_->command(activity).owner != owner || run.phase == ActivityPhase::settling) continue;
    const bool given_up = run.phase == ActivityPhase::cancelling && run.after_cancel != AfterCancel::retry;
    if (given_up && !state_->starting()) {
      state_->close(activity, now, ActivityState::failed, run.reason + "; " + lost);
    } else {
      attempts_->fail(activity, now, Breakage::activity_failed, lost, false);
    }
  }
}

void OwnerExchange::take_cancel_answer(Index activity, const CommandAck& ack, Time now) {
  const ActivityRun& run = state_->runs[activity];
  if (ack.stage == CommandStage::accepted) return;  // crossed the cancel
  const bool all_done = ack.stage == CommandStage::completed && state_->command(activity).last;
  if (ack.stage == CommandStage::completed && run.after_cancel == AfterCancel::retry) {
    if (!attempts_->send_next(activity, now)) state_->enter(activity, ActivityPhase::settling, now);
    return;
  }
  if (all_done && run.after_cancel == AfterCancel::withdraw)
    return state_->close(activity, now, ActivityState::succeeded, "completed before the cancel");
  if (ack.stage == CommandStage::cancel_failed)
    return give_cancel_up(activity, now, with_reason("cancel failed", ack));
  const std::string reason = run.reason;
  if (run.after_cancel == AfterCancel::retry) return attempts_->fail_or_retry(activity, now, reason);
  const bool failed = run.after_cancel == AfterCancel::fail;
  if (failed && state_->starting())
    return attempts_->fail(activity, now, Breakage::activity_failed, reason, false);
  state_->close(activity, now, failed ? ActivityState::failed : ActivityState::cancelled, reason);
}

void OwnerExchange::give_cancel_up(Index activity, Time now, const std::string& answer) {
  const ActivityRun& run = state_->runs[activity];
  const std::string reason = run.reason + "; " + answer;
  contingencies_->exhaust(activity);
  if (run.after_cancel == AfterCancel::retry || state_->starting()) {
    attempts_->fail(activity, now, Breakage::activity_failed, reason, false);
  } else {
    state_->close(activity, now, ActivityState::failed, reason);
  }
}

void OwnerExchange::withdraw_all(Time now) {
  for (Index i = 0; i < state_->runs.size(); ++i) {
    ActivityRun& run = state_->runs[i];
    const bool owner_works = run.phase == ActivityPhase::sent || run.phase == ActivityPhase::running;
    if (run.phase == ActivityPhase::done) continue;
    if (run.phase == ActivityPhase::cancelling) {
      if (run.after_cancel == AfterCancel::retry) run.after_cancel = AfterCancel::withdraw;
    } else if (owner_works && !state_->plan.activities[i].owner.empty()) {
      attempts_->cancel(i, now, AfterCancel::withdraw, "cancel requested");
    } else {
      if (run.phase == ActivityPhase::contingency) contingencies_->cancel(i);
      const bool settling = run.phase == ActivityPhase::settling;
      state_->close(i, now, ActivityState::cancelled,
                    settling ? "cancelled before its end was confirmed" : "");
    }
  }
}

bool OwnerExchange::ask_again(Index activity, Time now) {
  ActivityRun& run = state_->runs[activity];
  const bool linked = state_->settings.linked(state_->command(activity).owner);
  if (!linked || run.queries >= state_->settings.queries) return false;
  ++run.queries;
  run.asked = true;
  run.phase_since = now;
  state_->send(activity, CommandAction::query);
  return true;
}

void OwnerExchange::query_all(Time now, const std::string& owner) {
  for (const Index activity : state_->active) {
    ActivityRun& run = state_->runs[activity];
    if (state_->plan.activities[activity].owner.empty() || run.phase == ActivityPhase::settling) continue;
    if (!owner.empty() &&
        (run.phase == ActivityPhase::contingency || state_->command(activity).owner != owner))
      continue;
    if (run.phase == ActivityPhase::contingency) {
      contingencies_->query(activity, now);
      continue;
    }
    run.asked = true;
    if (run.phase != ActivityPhase::running) run.phase_since = now;  // the time for an answer counts anew
    state_->send(activity, CommandAction::query);
  }
}

/// Returns false if the ack is to be taken like any other. Only a query is answered with `unknown` while no
/// cancel was sent; late or not, the same key may always be sent again.
bool OwnerExchange::take_query_answer(Index activity, const CommandAck& ack, Time now) {
  ActivityRun& run = state_->runs[activity];
  const bool asked = std::exchange(run.asked, false);
  if (ack.stage == CommandStage::unknown && run.phase == ActivityPhase::sent) {
    run.phase_since = now;
    state_->send(activity, CommandAction::execute);  // the key is the same: it is done once
    return true;
  }
  if (asked && ack.stage == CommandStage::accepted && run.phase == ActivityPhase::cancelling) {
    run.phase_since = now;
    state_->send(activity, CommandAction::cancel);
    return true;
  }
  return false;
}

}  // namespace roci::exec::executive
