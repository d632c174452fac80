// A failed activity's contingency: the commands of a template, one after the other; then the activity again,
// or a broken plan. Others run on meanwhile (R141).
#include <algorithm>
#include <map>

#include "exec_svc/executive/plan_run.hpp"

namespace roci::exec::executive {

using temporal::ActivityState;
using temporal::PlanActivity;
using temporal::plus;
using temporal::Time;
using temporal::to_text;

namespace {

std::vector<temporal::Property> filled(std::vector<temporal::Property> arguments,
                                       const PlanActivity& failed) {
  for (temporal::Property& argument : arguments)
    for (const temporal::Property& known : failed.arguments)
      if (argument.value == "{" + known.name + "}") argument.value = known.value;
  return arguments;
}

}  // namespace

/// The contingency that may still be used for an activity that has been started.
const Contingency* PlanRun::contingency_of(Index activity) const {
  const PlanActivity& planned = plan_.activities[activity];
  const ActivityRun& run = runs_[activity];
  const auto found = settings_.contingencies.find(planned.contingency);
  if (!starting() || !run.started || planned.owner.empty() || found == settings_.contingencies.end())
    return nullptr;
  return run.contingencies_used < found->second.times && !found->second.commands.empty() ? &found->second
                                                                                         : nullptr;
}

/// Who executes the command that runs; empty: none does.
std::string PlanRun::contingency_owner(Index activity) const {
  const auto& commands = settings_.contingencies.at(plan_.activities[activity].contingency).commands;
  const std::size_t command = runs_[activity].contingency.command;
  return command < commands.size() ? commands[command].owner : "";
}

bool PlanRun::begin_contingency(Index activity, Time now, const std::string& reason) {
  const Contingency* contingency = contingency_of(activity);
  if (contingency == nullptr) return false;
  ActivityRun& run = runs_[activity];
  ++run.contingencies_used;
  run.contingency = {0, "", now, now, false, reason};
  enter(activity, ActivityPhase::contingency, now);
  send_contingency(activity, CommandAction::execute);
  change(activity, ActivityState::running, "contingency " + contingency->name + " after: " + reason);
  recover(RecoveryAction::contingency, activity,
          contingency->name + ", " + std::to_string(run.contingencies_used) + " of " +
              std::to_string(contingency->times) + ", after: " + reason);
  return true;
}

void PlanRun::send_contingency(Index activity, CommandAction action) {
  const PlanActivity& planned = plan_.activities[activity];
  const Contingency& contingency = settings_.contingencies.at(planned.contingency);
  ActivityRun& run = runs_[activity];
  if (run.contingency.command >= contingency.commands.size()) return;
  const ContingencyCommand& command = contingency.commands[run.contingency.command];
  if (run.contingency.command_id.empty()) {
    run.contingency.command_id =
        planned.id + ".c" + std::to_string(++run.contingency_commands) + "-" + command.command_name;
    contingency_of_[run.contingency.command_id] = activity;
  }
  outputs_.commands.push_back({action, run.contingency.command_id, 1, command.owner, command.subsystem,
                               command.command_name, filled(command.arguments, planned),
                               temporal::Duration{0}});
}

bool PlanRun::take_contingency_ack(const CommandAck& ack, Time now) {
  const auto found = contingency_of_.find(ack.activity);
  if (found == contingency_of_.end()) return false;
  const Index activity = found->second;
  ContingencyRun& current = runs_[activity].contingency;
  if (runs_[activity].phase != ActivityPhase::contingency || current.command_id != ack.activity)
    return false;
  if (ack.stage == CommandStage::unknown && !current.accepted) {
    current.command_since = now;
    send_contingency(activity, CommandAction::execute);  // the key is the same: it is done once
  } else if (ack.stage == CommandStage::accepted) {
    current.accepted = true;
  } else if (ack.stage == CommandStage::completed) {
    ++current.command;
    current.command_id.clear();
    current.command_since = now;
    current.accepted = false;
    send_contingency(activity, CommandAction::execute);
  } else {
    end_contingency(activity, now,
                    "one of its commands failed" + (ack.reason.empty() ? "" : ": " + ack.reason));
  }
  return true;
}

bool PlanRun::monitor_contingency(Index activity, Time now) {
  const PlanActivity& planned = plan_.activities[activity];
  const Contingency& contingency = settings_.contingencies.at(planned.contingency);
  const ContingencyRun& current = runs_[activity].contingency;
  if (current.command == contingency.commands.size()) {
    const std::string unmet = contingency.retries ? explain(planned.pre, lookup()) : "";
    if (!unmet.empty() && now < current.command_since + settings_.settle_time) return false;
    end_contingency(activity, now, unmet.empty() ? "" : "then the activity lacks " + unmet);
    return true;
  }
  if (now < contingency_timer(activity)) return false;
  send_contingency(activity, CommandAction::cancel);
  end_contingency(activity, now,
                  current.accepted ? "not done within " + to_text(contingency.within)
                                       : "not answered within " + to_text(settings_.ack_timeout));
  return true;
}

/// reason: why it did not help; empty if all is done.
void PlanRun::end_contingency(Index activity, Time now, const std::string& reason) {
  const Contingency& contingency = settings_.contingencies.at(plan_.activities[activity].contingency);
  const std::string failure = runs_[activity].contingency.failure;
  const std::string what = "contingency " + contingency.name;
  if (reason.empty() && contingency.retries && starting() && now <= deadline(activity)) {
    recover(RecoveryAction::contingency, activity,
            contingency.name + " is done, the activity is tried again");
    try_again(activity, now, "tried again after " + what);
    return;
  }
  runs_[activity].contingencies_used = contingency.times;
  fail(activity, now, Breakage::activity_failed,
       failure + "; " + what + (reason.empty() ? " is done" : " did not help: " + reason), false);
}

Time PlanRun::contingency_timer(Index activity) const {
  const Contingency& contingency = settings_.contingencies.at(plan_.activities[activity].contingency);
  const ContingencyRun& current = runs_[activity].contingency;
  if (current.command == contingency.commands.size())
    return current.command_since + settings_.settle_time;
  const Time end = plus(current.since, contingency.within);
  return current.accepted ? end : std::min(end, current.command_since + settings_.ack_timeout);
}

}  // namespace roci::exec::executive
