#include "exec_svc/executive/contingency_runs.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace roci::exec::executive {

using temporal::PlanActivity;
using temporal::Time;
using temporal::to_text;

namespace {

std::vector<temporal::Property> filled(std::vector<temporal::Property> arguments,
                                       const std::vector<temporal::Property>& of_failed) {
  for (temporal::Property& argument : arguments)
    for (const temporal::Property& known : of_failed)
      if (argument.value == "{" + known.name + "}") argument.value = known.value;
  return arguments;
}

}  // namespace

const Contingency* ContingencyRuns::usable(Index activity) const {
  const PlanActivity& planned = state_->plan.activities[activity];
  const auto found = state_->settings.contingencies.find(planned.contingency);
  if (!state_->starting() || !state_->permissions.recovers || !state_->runs[activity].started ||
      planned.owner.empty() || found == state_->settings.contingencies.end())
    return nullptr;
  const bool left = records_[activity].used < found->second.times && !found->second.commands.empty();
  return left ? &found->second : nullptr;
}

const Contingency& ContingencyRuns::contingency(Index activity) const {
  return state_->settings.contingencies.at(state_->plan.activities[activity].contingency);
}

bool ContingencyRuns::begin(Index activity, Time now, const std::string& failure) {
  const Contingency* contingency = usable(activity);
  if (contingency == nullptr) return false;
  Record& record = records_[activity];
  record = {0, "", 0, now, now, false, failure, record.used + 1, record.commands};
  state_->enter(activity, ActivityPhase::contingency, now);
  send(activity, CommandAction::execute);
  state_->change(activity, temporal::ActivityState::running,
                 "contingency " + contingency->name + " after: " + failure);
  state_->report_recovery(RecoveryAction::contingency, activity,
                          contingency->name + ", " + std::to_string(record.used) + " of " +
                              std::to_string(contingency->times) + ", after: " + failure);
  return true;
}

void ContingencyRuns::exhaust(Index activity) {
  records_[activity].used = std::numeric_limits<std::uint32_t>::max();
}

void ContingencyRuns::send(Index activity, CommandAction action) {
  const PlanActivity& planned = state_->plan.activities[activity];
  Record& record = records_[activity];
  if (record.command >= contingency(activity).commands.size()) return;
  const ContingencyCommand& command = contingency(activity).commands[record.command];
  if (record.command_id.empty()) {
    record.command_id = planned.id + ".c" + std::to_string(++record.commands) + "-" + command.command_name;
    record.epoch = state_->epoch;
    activity_of_[record.command_id] = activity;
  }
  state_->outputs.commands.push_back(
      {action, record.command_id, 1, command.owner, command.subsystem, command.command_name,
       filled(command.arguments, state_->with_bound(activity, planned.arguments)), temporal::Duration{0},
       record.epoch, temporal::no_bound, command.robot, state_->plan.version});
}

bool ContingencyRuns::expects(const CommandAck& ack) const {
  const auto found = activity_of_.find(ack.activity);
  return found != activity_of_.end() && state_->runs[found->second].phase == ActivityPhase::contingency &&
         records_[found->second].command_id == ack.activity &&
         (ack.epoch == 0 || ack.epoch == records_[found->second].epoch);
}

std::optional<ContingencyEnd> ContingencyRuns::take(const CommandAck& ack, Time now) {
  const Index activity = activity_of_.at(ack.activity);
  Record& record = records_[activity];
  const bool asked = std::exchange(record.asked, false);
  if (ack.refused_epoch && record.queries < state_->settings.queries) {
    ++record.queries;
    if (asked) {
      query(activity, now);
    } else {
      record.command_since = now;
      record.epoch = state_->epoch;
      send(activity, CommandAction::execute);
    }
  } else if (ack.stage == CommandStage::unknown && !record.accepted) {
    record.command_since = now;
    send(activity, CommandAction::execute);  // the key is the same: it is done once
  } else if (ack.stage == CommandStage::accepted) {
    record.accepted = true;
  } else if (ack.stage == CommandStage::completed) {
    ++record.command;
    record.queries = 0;
    record.command_id.clear();
    record.command_since = now;
    record.accepted = false;
    send(activity, CommandAction::execute);
  } else {
    return ended(activity, "one of its commands failed" + (ack.reason.empty() ? "" : ": " + ack.reason));
  }
  return std::nullopt;
}

std::optional<ContingencyEnd> ContingencyRuns::check(Index activity, Time now) {
  const Contingency& running = contingency(activity);
  Record& record = records_[activity];
  if (record.command == running.commands.size()) {
    const std::string unmet =
        running.retries ? explain(state_->plan.activities[activity].pre, state_->lookup_to_retry(activity))
                        : "";
    if (!unmet.empty() && now < record.command_since + state_->settings.settle_time) return std::nullopt;
    return ended(activity, unmet.empty() ? "" : "then the activity lacks " + unmet);
  }
  if (now < timer(activity)) return std::nullopt;
  const bool may_be_lost = !record.accepted && state_->settings.linked(owner(activity)) &&
                           now < temporal::plus(record.since, running.within);
  if (may_be_lost && record.queries < state_->settings.queries) {
    ++record.queries;
    query(activity, now);
    return std::nullopt;
  }
  send(activity, CommandAction::cancel);
  return ended(activity, record.accepted ? "not done within " + to_text(running.within)
                                         : "not answered within " + to_text(state_->settings.ack_timeout));
}

std::optional<ContingencyEnd> ContingencyRuns::lose_owner(Index activity, const std::string& owner,
                                                          const std::string& reason) {
  const auto& commands = contingency(activity).commands;
  const std::size_t command = records_[activity].command;
  if (command >= commands.size() || commands[command].owner != owner) return std::nullopt;
  return ended(activity, reason);
}

void ContingencyRuns::query(Index activity, Time now) {
  records_[activity].command_since = now;
  records_[activity].asked = true;
  send(activity, CommandAction::query);
}

Time ContingencyRuns::timer(Index activity) const {
  const Record& record = records_[activity];
  if (record.command == contingency(activity).commands.size())
    return record.command_since + state_->settings.settle_time;
  const Time end = temporal::plus(record.since, contingency(activity).within);
  const ExecutiveSettings& settings = state_->settings;
  const Time answered = record.command_since + settings.ack_timeout + settings.round_trip(owner(activity));
  return record.accepted ? end : std::min(end, answered);
}

const std::string& ContingencyRuns::owner(Index activity) const {
  return contingency(activity).commands[records_[activity].command].owner;
}

ContingencyEnd ContingencyRuns::ended(Index activity, const std::string& reason) const {
  return {activity, records_[activity].failure, reason};
}

void ContingencyRuns::inherit(Index activity, const ContingencyRuns& before, Index activity_before,
                              bool goes_on) {
  const Record& record = before.records_[activity_before];
  if (goes_on) {
    records_[activity] = record;
  } else {
    records_[activity].commands = record.commands;
  }
}

}  // namespace roci::exec::executive
