#include "exec_svc/reactor/background_replan.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::reactor {

using executive::OutcomeKind;
using executive::StepStatus;
using goals::GoalRecord;
using goals::GoalState;
using problem::Forecast;
using temporal::Impact;
using temporal::ImpactKind;
using temporal::PlanActivity;
using temporal::Time;
using temporal::Verdict;

namespace {

constexpr char kModelChangedMeanwhile[] = "a map or arm model changed during the planner call";

struct Remainder {
  const PlanActivity* activity;
  Time ends;
  double part;               ///< of the duration, that is still to come
  temporal::Duration lasts;  ///< likewise, in time
};

Remainder remainder_of(const PlanActivity& activity, Time started, Time now) {
  const Time ends = std::max(now, started + activity.duration_lower);
  const auto whole = static_cast<double>(activity.duration_lower.count());
  return {&activity, ends, whole > 0 ? static_cast<double>((ends - now).count()) / whole : 0.0, ends - now};
}

/// Adds what the rest of an activity will change. Amounts of fluents change gradually over an activity,
/// though the domain simplifies that.
void add_effects(const Remainder& remainder, Forecast& forecast) {
  using enum temporal::ImpactWhen;
  for (const temporal::ImpactWhen moment : {at_start, during, at_end}) {
    for (const Impact& impact : remainder.activity->impacts) {
      if (impact.moment != moment) continue;
      const double* amount = std::get_if<double>(&impact.amount);
      if (impact.kind == ImpactKind::assign) forecast.values.insert_or_assign(impact.timeline, impact.amount);
      if (amount && impact.kind == ImpactKind::delta)
        forecast.changes[impact.timeline] += *amount * remainder.part;
      if (amount && impact.kind == ImpactKind::rate)
        forecast.changes[impact.timeline] += *amount * temporal::to_seconds(remainder.lasts);
    }
  }
}

/// Returns what has come about differently, or an empty text if nothing has.
std::string mismatch(const Forecast& forecast, const beliefs::Beliefs& beliefs) {
  for (const auto& [name, foreseen] : forecast.values) {
    const auto value = beliefs.lookup(name);
    if (!value || *value == foreseen || std::holds_alternative<double>(foreseen)) continue;
    if (foreseen == temporal::Value(true)) return name + " was foreseen and is not so";
    if (foreseen == temporal::Value(false)) return name + " is still so, unforeseen";
    return name + " is " + temporal::to_text(*value) + ", foreseen was " + temporal::to_text(foreseen);
  }
  return "";
}

}  // namespace

void BackgroundReplan::step(Time now, const ReactorInputs& inputs) {
  MissionState& state = parts_.state;
  const auto executing = [&] { return state.phase == MissionPhase::executing; };
  const PlanReply* reply = parts_.call.take(inputs);
  if (reply != nullptr && state.phase == MissionPhase::planning && !state.replan_wanted)
    parts_.planning.take_reply(now, *reply);
  if (reply != nullptr && call_) call_->reply = *reply;
  if (executing()) parts_.recovery.monitor(now, call_.has_value());
  if (!executing()) call_.reset();
  if (call_) proceed(now);
  if (retry_) await_retry(now);
  const bool may_begin =
      state.phase != MissionPhase::pausing && (state.phase != MissionPhase::planning || reply != nullptr);
  if (state.replan_due() && may_begin) {
    if (!possible()) {
      stop_.begin_pause(now);
    } else if (!parts_.call.open()) {
      grant(now);
    }
  }
  if (!executing()) {
    call_.reset();
    retry_ = false;
  }
  if (state.phase == MissionPhase::pausing) stop_.continue_pause(now);
  const bool reply_wanted = state.phase == MissionPhase::planning || call_.has_value();
  parts_.call.cancel_if_stale(reply_wanted && !state.replan_wanted);
}

bool BackgroundReplan::possible() const {
  return parts_.state.phase == MissionPhase::executing && !parts_.plan.invalid() &&
         parts_.plan.outcome().kind == OutcomeKind::running && !parts_.plan.executive().running().empty() &&
         !parts_.state.goals.open().empty() && !may_begin_after_recall();
}

/// Returns whether a command of this plan, which served a recalled goal, may still wait to be sent.
bool BackgroundReplan::may_begin_after_recall() const {
  const auto served = [this](const GoalRecord* record) {
    return record->state == GoalState::recalled && record->plan_version == parts_.plan.version();
  };
  return std::ranges::any_of(parts_.plan.executive().running(), [](const StepStatus& step) {
           return step.state == temporal::ActivityState::dispatched;
         }) && std::ranges::any_of(parts_.state.goals.all(), served);
}

void BackgroundReplan::grant(Time now) {
  parts_.state.replan_wanted = false;
  parts_.state.report(Severity::info, "plan.wanted", parts_.state.replan_reason + "; what runs goes on");
  if (parts_.recovery.may_replan(now)) call_planner(now);
}

void BackgroundReplan::call_planner(Time now) {
  std::vector<Remainder> running;
  for (const StepStatus& step : parts_.plan.executive().running())
    running.push_back(
        remainder_of(*parts_.plan.executive().activity(step.activity), step.started.value_or(now), now));
  std::stable_sort(running.begin(), running.end(),
                   [](const Remainder& a, const Remainder& b) { return a.ends < b.ends; });
  call_ = Call{};
  for (const Remainder& remainder : running) add_effects(remainder, call_->forecast);
  parts_.plan.hold_starts(true);
  const Time earliest = now + parts_.state.mission->planner.allowance;
  parts_.planning.call(now, std::max(earliest, running.back().ends), call_->forecast);
}

void BackgroundReplan::proceed(Time now) {
  if (parts_.plan.invalid()) {
    call_.reset();
  } else if (call_->reply && parts_.state.replan_wanted) {
    call_.reset();  // goals have changed since it was asked for
  } else if (call_->reply && call_->reply->verdict == Verdict::solved) {
    change_plans(now);
  } else if (call_->reply) {
    act_on_failure(now, *std::exchange(call_, std::nullopt)->reply);
  }
}

void BackgroundReplan::act_on_failure(Time now, const PlanReply& reply) {
  MissionState& state = parts_.state;
  if (state.goals.open().empty()) return keep_plan(now);  // what ran has achieved them
  if (parts_.call.is_end_of_cancelled(reply) || parts_.call.count_as_stale(reply))
    return state.want_plan(kModelChangedMeanwhile);
  if (!speaks_of_goals(reply.verdict))
    return parts_.recovery.break_plan(now, std::string("planner call ended as ") + to_string(reply.verdict));
  if (parts_.planning.doubts(now, reply)) {
    parts_.plan.hold_starts(false);
    retry_ = true;
    return;
  }
  parts_.call.clear_failures();
  if (parts_.planning.soft_goal_would_leave(reply)) {
    parts_.planning.relax(reply);
    keep_plan(now);
  } else {  // no hard goal is given up for the sake of what runs
    parts_.plan.invalidate();
    state.want_plan("a hard goal may fit if what runs is cancelled");
  }
}

/// Lets the running plan go on with one goal less, if it serves all others.
void BackgroundReplan::keep_plan(Time now) {
  MissionState& state = parts_.state;
  const auto open = state.goals.open();
  const bool all_served = std::all_of(open.begin(), open.end(), [this](const GoalRecord* record) {
    return record->state == GoalState::planned && record->plan_version == parts_.plan.version();
  });
  if (all_served) {
    parts_.plan.hold_starts(false);
    state.report(Severity::info, "plan.kept", parts_.plan.name() + " goes on");
    state.wake_at(now);
  } else if (possible()) {
    call_planner(now);
  } else {
    state.want_plan("without the goal that does not fit");
  }
}

/// Waits for the next call. A plan that is wanted meanwhile is asked for at once, for all open goals.
void BackgroundReplan::await_retry(Time now) {
  MissionState& state = parts_.state;
  retry_ = !state.replan_wanted && now < parts_.call.not_before();
  if (retry_) return state.wake_at(parts_.call.not_before());
  if (!state.replan_wanted) state.want_plan("the planner call is tried again");
}

void BackgroundReplan::change_plans(Time now) {
  if (!parts_.plan.executive().running().empty()) return;
  MissionState& state = parts_.state;
  const std::string different = mismatch(call_->forecast, state.beliefs);
  if (different.empty() && !parts_.call.is_stale(*call_->reply)) {
    parts_.planning.adopt(now, *std::exchange(call_, std::nullopt)->reply);
    return;
  }
  if (!call_->observed_by) call_->observed_by = now + state.mission->executive.ack_timeout;
  if (!different.empty() && now < *call_->observed_by) {
    state.wake_at(*call_->observed_by);  // observations may follow the acknowledgement
    return;
  }
  call_.reset();
  state.want_plan(different.empty() ? kModelChangedMeanwhile : different);
}

void BackgroundReplan::resume(Time now) {
  stop_.resume(now);
  if (call_ && !call_->reply) parts_.call.resend();
}

}  // namespace roci::exec::reactor
