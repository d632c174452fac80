#include "exec_svc/reactor/stop_and_replan.hpp"

#include <algorithm>

namespace roci::exec::reactor {

using executive::OutcomeKind;
using mission::Component;
using temporal::Time;

namespace {

constexpr char kAwaits[] = "; no plan before these were observed: ";

std::string names_of(const std::vector<const Component*>& components) {
  std::string out;
  for (const Component* component : components) out += (out.empty() ? "" : ", ") + component->name;
  return out;
}

}  // namespace

/// Decides the next phase. A wish for a plan that comes up during a planner call cancels the call and waits
/// for its end, since there is never more than one.
void StopAndReplan::step(Time now, const ReactorInputs& inputs) {
  MissionState& state = parts_.state;
  const PlanReply* reply = parts_.call.take(inputs);
  if (reply != nullptr && state.phase == MissionPhase::planning && !state.replan_wanted)
    parts_.planning.take_reply(now, *reply);
  if (state.phase == MissionPhase::executing) parts_.recovery.monitor(now, false);
  const bool may_pause =
      state.phase != MissionPhase::pausing && (state.phase != MissionPhase::planning || reply != nullptr);
  if (state.replan_due() && may_pause) begin_pause(now);
  if (state.phase == MissionPhase::pausing) continue_pause(now);
  parts_.call.cancel_if_stale(state.phase == MissionPhase::planning && !state.replan_wanted);
}

void StopAndReplan::begin_pause(Time now) {
  MissionState& state = parts_.state;
  const bool at_work = state.phase == MissionPhase::executing || state.phase == MissionPhase::planning;
  if (state.goals.open().empty() && !at_work) {
    state.replan_wanted = false;
    return;
  }
  if (const auto unobserved = state.beliefs.unobserved(); !unobserved.empty())
    return tell_awaited(unobserved);  // the first observation of the last one brings us here again
  state.replan_wanted = false;
  state.report(Severity::info, "plan.wanted", state.replan_reason);
  if (!parts_.recovery.may_replan(now)) return;
  parts_.plan.restore_validity();
  state.phase = MissionPhase::pausing;
  pause_deadline_ = now + state.mission->executive.fallback_timeout;
  parts_.safing.expect_fallbacks_again();
  parts_.plan.cancel(now);
}

/// Reports once for each wish, and again when others are awaited; the reason of the wish remembers that.
void StopAndReplan::tell_awaited(const std::vector<const Component*>& unobserved) {
  MissionState& state = parts_.state;
  std::string awaited = kAwaits;
  for (const Component* component : unobserved)
    awaited += (awaited == kAwaits ? "" : ", ") + component->name + " (" + component->timeline + " of " +
               component->owner + ")";
  if (state.replan_reason.ends_with(awaited)) return;
  state.replan_reason.resize(std::min(state.replan_reason.find(kAwaits), state.replan_reason.size()));
  state.replan_reason += awaited;
  state.report(Severity::warning, "plan.waits", state.replan_reason);
}

void StopAndReplan::continue_pause(Time now) {
  MissionState& state = parts_.state;
  const bool stopping = parts_.plan.outcome().kind == OutcomeKind::cancelling;
  if (!stopping && state.beliefs.active().empty()) {
    if (parts_.call.open()) return;  // it was made before the pause; its reply brings us here again
    if (now < parts_.call.not_before() && !state.goals.open().empty()) {
      state.wake_at(parts_.call.not_before());
    } else {
      parts_.planning.begin(now);
    }
  } else if (now >= pause_deadline_) {
    make_safe(now);
  } else {
    if (!stopping && !parts_.safing.fallbacks_sent()) parts_.safing.send_fallbacks();
    state.wake_at(pause_deadline_);
  }
}

void StopAndReplan::make_safe(Time now) {
  const auto active = parts_.state.beliefs.active();
  const std::string late = active.empty() ? "what was cancelled was not answered in time"
                                          : names_of(active) + " did not become inactive in time";
  if (parts_.safing.unanswered()) {
    parts_.safing.make_safe_unheard(now, late);
  } else {
    parts_.safing.make_safe(now, late);
  }
}

void StopAndReplan::resume(Time now) {
  MissionState& state = parts_.state;
  parts_.call.forget();
  if (state.phase != MissionPhase::planning) return;
  if (state.replan_wanted) {
    state.phase = MissionPhase::idle;
  } else {
    parts_.planning.begin(now);
  }
}

void StopAndReplan::save(archive::Writer& archive) const { archive(pause_deadline_); }

void StopAndReplan::restore(archive::Reader& archive) { archive(pause_deadline_); }

}  // namespace roci::exec::reactor
