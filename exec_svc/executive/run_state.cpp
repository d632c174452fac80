#include "exec_svc/executive/run_state.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "core/temporal/activity_timeline.hpp"

namespace roci::exec::executive {

using temporal::ActivityState;
using temporal::PlanActivity;
using temporal::Time;
using temporal::TimePoint;

RunState::RunState(temporal::FlexiblePlan flexible_plan, const ExecutiveSettings& executive_settings,
                   const Permissions& permitted, TimelineStore& timelines, std::uint64_t current_epoch)
    : plan(std::move(flexible_plan)),
      settings(executive_settings),
      permissions(permitted),
      store(timelines),
      epoch(current_epoch),
      points(plan, executive_settings.start == StartPolicy::latest, executive_settings.only_committed),
      runs(plan.activities.size()),
      unfinished(plan.activities.size()) {
  outcome.kind = OutcomeKind::running;
  for (Index i = 0; i < plan.activities.size(); ++i) index_of[plan.activities[i].id] = i;
}

temporal::Lookup RunState::lookup() const {
  return [this](const std::string& timeline) {
    const auto progress = progress_named(timeline);
    return progress ? progress : store.value_of(timeline);
  };
}

temporal::Lookup RunState::lookup_to_retry(Index activity) const {
  return [this, &id = plan.activities[activity].id](const std::string& timeline) {
    const auto progress = progress_named(timeline);
    return progress ? progress : store.value_without(id, timeline);
  };
}

// Returns how an activity of the plan went, if the timeline's name asks for that.
std::optional<temporal::Value> RunState::progress_named(const std::string& timeline) const {
  const std::string id = temporal::activity_of(timeline);
  if (id.empty()) return std::nullopt;
  const auto activity = index_of.find(id);
  const bool absent = activity == index_of.end();
  return temporal::state(absent ? "absent" : temporal::to_string(runs[activity->second].state));
}

StepStatus RunState::status(Index activity) const {
  const PlanActivity& planned = plan.activities[activity];
  const ActivityRun& run = runs[activity];
  const temporal::Window window = points.window(planned.start_point);
  return {planned.id,   planned.name, run.attempt, run.state, window.lower,
          window.upper, run.started,  run.ended,   run.reason};
}

std::vector<temporal::Property> RunState::with_bound(Index activity,
                                                     std::vector<temporal::Property> planned) const {
  const auto found = bound.find(activity);
  if (found == bound.end()) return planned;
  const PlanActivity& whole = plan.activities[activity];
  const auto place_in = [](auto& arguments, const std::string& name) {
    return std::ranges::find(arguments, name, &temporal::Property::name);
  };
  for (const temporal::Property& argument : found->second) {
    const auto same = place_in(planned, argument.name);
    const bool nowhere = place_in(whole.arguments, argument.name) == whole.arguments.end() &&
                         std::ranges::none_of(whole.then, [&](const temporal::PlanCommand& next) {
                           return place_in(next.arguments, argument.name) != next.arguments.end();
                         });
    if (same != planned.end()) {
      same->value = argument.value;
    } else if (nowhere && planned == whole.arguments) {
      planned.push_back(argument);
    }
  }
  return planned;
}

void RunState::change(Index activity, ActivityState state, std::string reason) {
  runs[activity].state = state;
  runs[activity].reason = std::move(reason);
  while (first_waiting < runs.size() && runs[first_waiting].state != ActivityState::waiting) ++first_waiting;
  outputs.changes.push_back(status(activity));
}

void RunState::enter(Index activity, ActivityPhase phase, Time now) {
  ActivityRun& run = runs[activity];
  if (phase == ActivityPhase::done && run.phase != ActivityPhase::done) --unfinished;
  run.phase = phase;
  run.phase_since = now;
  run.queries = 0;
  run.refusals = 0;
  if (run.active()) {
    active.insert(activity);
  } else {
    active.erase(activity);
  }
}

void RunState::send(Index activity, CommandAction action) {
  const PlanActivity& planned = plan.activities[activity];
  ActivityRun& run = runs[activity];
  // A command that is sent again, or queried after a restart, keeps the key of its issue.
  if (run.issued != run.attempt) {
    run.issued = run.attempt;
    run.epoch = epoch;
    run.plan = plan.version;
  }
  const CommandOf sent = command(activity);
  outputs.commands.push_back({action, planned.id, run.attempt, sent.owner, sent.subsystem, sent.command_name,
                              with_bound(activity, sent.arguments), points.duration(activity).lower,
                              run.epoch, run.latest_end, sent.robot, run.plan});
}

CommandOf RunState::command(Index activity) const {
  const PlanActivity& planned = plan.activities[activity];
  const std::size_t number = std::min(runs[activity].command, planned.then.size());
  const bool last = number == planned.then.size();
  const auto of =
      [&](const auto& sent) {  // an activity's own command has the same members as those that follow
        const temporal::Duration own =
            temporal::bounded(sent.answer_within) ? sent.answer_within : settings.ack_timeout;
        return CommandOf{sent.owner,
                         sent.robot,
                         sent.subsystem,
                         sent.command_name,
                         sent.arguments,
                         own + settings.round_trip(sent.owner),
                         last};
      };
  return number == 0 ? of(planned) : of(planned.then[number - 1]);
}

std::vector<TimePoint> RunState::ready_points() const {
  std::vector<TimePoint> ready(points.ready().begin(), points.ready().end());
  const auto priority = [this](TimePoint point) {
    const PointOwner& owner = points.owner(point);
    return owner.role == PointRole::start ? plan.activities[owner.activity].priority : 0;
  };
  std::ranges::stable_sort(ready, std::ranges::greater{}, priority);
  return ready;
}

void RunState::close(Index activity, Time now, ActivityState state, const std::string& reason) {
  ActivityRun& run = runs[activity];
  if (run.started) run.ended = now;
  if (run.started) store.end(plan.activities[activity], state == ActivityState::succeeded);
  enter(activity, ActivityPhase::done, now);
  change(activity, state, reason);
}

void RunState::skip(Index activity, const std::string& reason) {
  const PlanActivity& planned = plan.activities[activity];
  enter(activity, ActivityPhase::done, {});
  points.drop(planned.start_point);
  points.drop(planned.end_point);
  change(activity, ActivityState::skipped, reason);
}

void RunState::report_recovery(RecoveryAction action, Index activity, std::string reason) {
  outputs.recoveries.push_back({action, plan.activities[activity].id, std::move(reason)});
}

void RunState::break_plan(Breakage breakage, const std::string& who, const std::string& reason,
                          const std::string& contingency) {
  if (outcome.kind == OutcomeKind::running)
    outcome = {OutcomeKind::broken, breakage, who, reason, contingency};
}

void RunState::update_outcome() {
  if (outcome.kind == OutcomeKind::running && unfinished == 0) outcome.kind = OutcomeKind::finished;
  if (outcome.kind == OutcomeKind::cancelling && active.empty()) outcome.kind = OutcomeKind::cancelled;
}

}  // namespace roci::exec::executive
