// Activities under way: answers of their owners, conditions, timers, failure, retry, cancel.
#include <algorithm>
#include <limits>

#include "exec_svc/executive/plan_run.hpp"

namespace roci::exec {

using temporal::ActivityState;
using temporal::bounded;
using temporal::Duration;
using temporal::LatenessPolicy;
using temporal::PlanActivity;
using temporal::plus;
using temporal::Time;
using temporal::to_text;
using temporal::Truth;

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
  if (run.phase == Phase::recovering) return false;
  if (take_query_answer(activity, ack, now)) return true;
  if (run.phase == Phase::cancelling) {
    take_cancel_answer(activity, ack, now);
    return true;
  }
  if (run.phase == Phase::settling) return ack.stage == CommandStage::completed;
  switch (ack.stage) {
    case CommandStage::accepted:
      if (run.phase == Phase::sent) {
        enter(activity, Phase::running, now);
        change(activity, ActivityState::running, run.cause);
      } else if (!ack.code.empty() || !ack.reason.empty()) {
        change(activity, ActivityState::running, with_reason("its owner repairs", ack));  // R146
      }
      return true;
    case CommandStage::completed:
      if (now > deadline(activity)) {
        fail(activity, now, BreakReason::deadline_passed, "it ended after its deadline", false);
        return true;
      }
      enter(activity, Phase::settling, now);
      return true;
    case CommandStage::rejected:
      if (ack.code == "unknown-command" || ack.code == "unknown-component") {
        fail(activity, now, BreakReason::refused_for_good, with_reason("rejected", ack), false);
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
      fail(activity, now, BreakReason::activity_failed, with_reason("cancelled by its owner", ack), false);
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
    if (runs_[activity].phase == Phase::recovering) {
      if (contingency_owner(activity) == owner) end_contingency(activity, now, lost);
      continue;
    }
    if (plan_.activities[activity].owner != owner || runs_[activity].phase == Phase::settling) continue;
    const bool given_up =
        runs_[activity].phase == Phase::cancelling && runs_[activity].after_cancel != AfterCancel::retry;
    if (given_up && !starting()) {
      close(activity, now, ActivityState::failed, runs_[activity].cause + "; " + lost);
    } else {
      fail(activity, now, BreakReason::activity_failed, lost, false);
    }
  }
}

bool PlanRun::monitor(Time now) {
  bool progress = false;
  const std::vector<Index> active(active_.begin(), active_.end());
  for (const Index activity : active)
    if (runs_[activity].active()) progress = monitor_activity(activity, now) || progress;
  return progress;
}

bool PlanRun::monitor_activity(Index activity, Time now) {
  const PlanActivity& planned = plan_.activities[activity];
  const ActivityRun& run = runs_[activity];
  const Time age = now - run.phase_since;
  const bool commanded = !planned.owner.empty();
  if (run.phase == Phase::recovering) return monitor_contingency(activity, now);
  if (run.phase == Phase::cancelling) {
    if (age < settings_.cancel_timeout) return false;
    cancel_is_over(activity, now, "cancel not answered within " + to_text(settings_.cancel_timeout));
    return true;
  }
  if (run.phase == Phase::sent && age >= settings_.ack_timeout) {
    const std::string cause =
        "command not answered by " + planned.owner + " within " + to_text(settings_.ack_timeout);
    if (run.retries_used < planned.retries && starting()) {
      cancel(activity, now, AfterCancel::retry, cause);
    } else {
      fail(activity, now, BreakReason::activity_failed, cause, true);
    }
    return true;
  }
  if (check_maintenance(activity, now)) return true;
  if (run.phase == Phase::settling) return try_finish(activity, now);
  if (now > deadline(activity)) {
    fail(activity, now, BreakReason::deadline_passed,
         "still running at its deadline " + to_text(deadline(activity)), commanded);
    return true;
  }
  if (commanded && now >= hung_after(activity)) {
    fail(activity, now, BreakReason::activity_failed, "no end long after its longest duration", true);
    return true;
  }
  return false;
}

/// True if it failed. A condition that its own start brings about is given the settle time to become true.
bool PlanRun::check_maintenance(Index activity, Time now) {
  const PlanActivity& planned = plan_.activities[activity];
  ActivityRun& run = runs_[activity];
  if (planned.maintenance.empty() || run.phase == Phase::settling) return false;
  const Truth truth = evaluate(planned.maintenance, lookup());
  if (truth == Truth::yes) run.maintenance_held = true;
  const bool demanded = run.maintenance_held || now >= run.attempt_started + settings_.settle_time;
  if (truth != Truth::no || !demanded) return false;
  fail(activity, now, BreakReason::activity_failed,
       "maintenance condition broken: " + explain(planned.maintenance, lookup()), !planned.owner.empty());
  return true;
}

bool PlanRun::try_finish(Index activity, Time now) {
  const PlanActivity& planned = plan_.activities[activity];
  const Time from = settled_from(activity);
  if (now < from) return false;
  if (evaluate(planned.post, lookup()) == Truth::yes) {
    if (planned.owner.empty()) return false;  // its end point is ready: the dispatch ends it
    succeed(activity, now);
    return true;
  }
  if (now < from + settings_.settle_time) return false;
  fail(activity, now, BreakReason::activity_failed,
       "post condition does not hold: " + explain(planned.post, lookup()), false);
  return true;
}

void PlanRun::succeed(Index activity, Time now) {
  const PlanActivity& planned = plan_.activities[activity];
  if (!planned.owner.empty()) {
    points_.happen(planned.end_point, now);
    ended_now_.push_back(activity);
  }
  close(activity, now, ActivityState::succeeded, "");
}

void PlanRun::fail(Index activity, Time now, BreakReason reason, const std::string& cause,
                   bool still_commanded) {
  const bool may_recover = reason == BreakReason::activity_failed && contingency_of(activity) != nullptr;
  if (may_recover && !still_commanded && begin_contingency(activity, now, cause)) return;
  if (may_recover && still_commanded) {
    cancel(activity, now, AfterCancel::fail, cause);
    return;
  }
  break_plan(reason, plan_.activities[activity].id, cause, plan_.activities[activity].contingency);
  if (still_commanded) {
    cancel(activity, now, AfterCancel::fail, cause);
  } else {
    close(activity, now, ActivityState::failed, cause);
  }
}

void PlanRun::fail_or_retry(Index activity, Time now, const std::string& cause) {
  if (!retry(activity, now, cause)) fail(activity, now, BreakReason::activity_failed, cause, false);
}

/// R99: the same activity again at once, if its preconditions still hold; its duration counts from now.
bool PlanRun::retry(Index activity, Time now, const std::string& cause) {
  const PlanActivity& planned = plan_.activities[activity];
  ActivityRun& run = runs_[activity];
  if (!starting() || run.retries_used >= planned.retries || now > deadline(activity)) return false;
  const auto within = settings_.retry_within.find(planned.name);
  if (within != settings_.retry_within.end() && now > plus(*run.started, within->second)) return false;
  if (evaluate(planned.pre, lookup()) != Truth::yes) return false;
  ++run.retries_used;
  recover(Rung::retry, activity,
          "retry " + std::to_string(run.retries_used) + " of " + std::to_string(planned.retries) +
              " after: " + cause);
  try_again(activity, now, "retry after: " + cause);
  return true;
}

void PlanRun::try_again(Index activity, Time now, const std::string& cause) {
  ActivityRun& run = runs_[activity];
  ++run.attempt;
  run.attempt_started = now;
  run.overrun_noted = false;
  const Duration spent = now - *run.started;
  const temporal::Window duration = points_.duration(activity);
  points_.set_duration(activity, plus(spent, duration.lower), plus(spent, duration.upper));
  enter(activity, Phase::sent, now);
  send(activity, CommandAction::execute);
  change(activity, ActivityState::dispatched, cause);
}

void PlanRun::close(Index activity, Time now, ActivityState state, const std::string& cause) {
  ActivityRun& run = runs_[activity];
  if (run.started) run.ended = now;
  if (plan_.activities[activity].owner.empty() && run.started)
    store_.end(plan_.activities[activity], state == ActivityState::succeeded);
  enter(activity, Phase::done, now);
  change(activity, state, cause);
}

void PlanRun::cancel(Index activity, Time now, AfterCancel after, const std::string& cause) {
  ActivityRun& run = runs_[activity];
  enter(activity, Phase::cancelling, now);
  run.after_cancel = after;
  send(activity, CommandAction::cancel);
  change(activity, run.state, cause);
}

void PlanRun::take_cancel_answer(Index activity, const CommandAck& ack, Time now) {
  ActivityRun& run = runs_[activity];
  if (ack.stage == CommandStage::accepted) return;  // crossed the cancel
  if (ack.stage == CommandStage::completed && run.after_cancel != AfterCancel::fail) {
    enter(activity, Phase::settling, now);
    if (run.after_cancel == AfterCancel::withdraw)
      close(activity, now, ActivityState::succeeded, "completed before the cancel");
    return;
  }
  if (ack.stage == CommandStage::cancel_failed) {
    cancel_is_over(activity, now, with_reason("cancel failed", ack));
    return;
  }
  const std::string cause = run.cause;
  if (run.after_cancel == AfterCancel::retry) {
    fail_or_retry(activity, now, cause);
  } else {
    const bool failed = run.after_cancel == AfterCancel::fail;
    if (failed && starting()) {
      fail(activity, now, BreakReason::activity_failed, cause, false);
      return;
    }
    close(activity, now, failed ? ActivityState::failed : ActivityState::cancelled, cause);
  }
}

/// The cancel did not take: the command may still be running, and no contingency is begun on top of it.
void PlanRun::cancel_is_over(Index activity, Time now, const std::string& answer) {
  const std::string cause = runs_[activity].cause + "; " + answer;
  runs_[activity].contingencies_used = std::numeric_limits<std::uint32_t>::max();
  if (runs_[activity].after_cancel == AfterCancel::retry || starting()) {
    fail(activity, now, BreakReason::activity_failed, cause, false);
  } else {
    close(activity, now, ActivityState::failed, cause);
  }
}

/// Latest end under LatenessPolicy::deadline: the latest next change of the timelines that begin a token with
/// it.
Time PlanRun::deadline(Index activity) const {
  const PlanActivity& planned = plan_.activities[activity];
  if (planned.lateness != LatenessPolicy::deadline) return temporal::no_bound;
  if (tokens_from_[activity].empty()) return points_.window(planned.end_point).upper;
  Time earliest = temporal::no_bound;
  for (const std::size_t token : tokens_from_[activity])
    earliest = std::min(earliest, points_.window(plan_.tokens[token].end_point).upper);
  return earliest;
}

/// An activity without a longest duration is followed as long as its owner lives.
Time PlanRun::hung_after(Index activity) const {
  const Duration longest = points_.duration(activity).upper;
  if (!bounded(longest)) return temporal::no_bound;
  const Duration stretched = temporal::seconds(temporal::to_seconds(longest) * settings_.overrun_factor);
  return plus(runs_[activity].attempt_started, plus(stretched, settings_.overrun_grace));
}

/// From when on a completed command counts as a success, if its post condition holds (R86).
Time PlanRun::settled_from(Index activity) const {
  const PlanActivity& planned = plan_.activities[activity];
  const ActivityRun& run = runs_[activity];
  if (planned.lateness != LatenessPolicy::push || planned.owner.empty()) return run.phase_since;
  return std::max(run.phase_since, run.attempt_started + points_.duration(activity).lower);
}

Time PlanRun::next_timer(Index activity, Time now) const {
  const PlanActivity& planned = plan_.activities[activity];
  const ActivityRun& run = runs_[activity];
  if (run.phase == Phase::cancelling) return run.phase_since + settings_.cancel_timeout;
  if (run.phase == Phase::recovering) return contingency_timer(activity);
  if (run.phase == Phase::settling) {
    const Time from = settled_from(activity);
    return now < from ? from : from + settings_.settle_time;
  }
  Time next = plus(deadline(activity), Duration{1});
  if (!planned.owner.empty()) next = std::min(next, hung_after(activity));
  if (run.phase == Phase::sent) next = std::min(next, run.phase_since + settings_.ack_timeout);
  if (!planned.maintenance.empty() && !run.maintenance_held)
    next = std::min(next, run.attempt_started + settings_.settle_time);
  return next;
}

}  // namespace roci::exec
