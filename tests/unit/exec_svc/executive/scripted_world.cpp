#include "tests/unit/exec_svc/executive/scripted_world.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "core/temporal/activity_timeline.hpp"

namespace roci::exec::testing {

using executive::Breakage;
using executive::Command;
using executive::CommandAction;
using executive::CommandStage;
using executive::DecisionState;
using executive::DecisionStatus;
using executive::ExecutiveSettings;
using executive::Inputs;
using executive::OutcomeKind;
using executive::Outputs;
using executive::RecoveryStep;
using executive::StepStatus;

namespace {

using temporal::seconds;
using temporal::Time;
using temporal::to_text;

std::string clock_text(Time time) {
  std::string text = to_text(time);
  return text.substr(0, text.size() - 2);
}

std::string name_of(OutcomeKind kind) {
  static constexpr std::array names{"idle", "running", "finished", "broken", "cancelling", "cancelled"};
  return names.at(static_cast<std::size_t>(kind));
}

std::string name_of(Breakage breakage) {
  static constexpr std::array names{"none",
                                    "late_start",
                                    "activity_failed",
                                    "refused_for_good",
                                    "deadline_passed",
                                    "ordering_violated",
                                    "decision_missing"};
  return names.at(static_cast<std::size_t>(breakage));
}

}  // namespace

ScriptedWorld::ScriptedWorld(temporal::FlexiblePlan plan, ExecutiveSettings settings) : executive(settings) {
  const auto faults = executive.load(std::move(plan), Time{0});
  if (!faults.empty()) throw std::invalid_argument(faults.front());
}

void ScriptedWorld::at(double time, Inputs inputs) {
  events_.emplace(seconds(time), Event{std::move(inputs)});
}

void ScriptedWorld::observe(double time, const std::string& timeline, temporal::Value value) {
  at(time, {.observations = {{timeline, std::move(value)}}});
}

void ScriptedWorld::cancel_at(double time) {
  events_.emplace(seconds(time), Event{{}, [this](Time now) { return executive.cancel_all(now); }});
}

void ScriptedWorld::load_at(double time, temporal::FlexiblePlan plan) {
  events_.emplace(seconds(time), Event{{}, [this, plan = std::move(plan)](Time now) {
                                         const auto faults = executive.load(plan, now);
                                         if (!faults.empty()) throw std::invalid_argument(faults.front());
                                         return Outputs{.outcome = executive.outcome(), .next_wake = now};
                                       }});
}

const std::vector<std::string>& ScriptedWorld::run(double until) {
  std::optional<Time> wake = now_;
  while (true) {
    const Time event = events_.empty() ? temporal::no_bound : events_.begin()->first;
    const Time next = std::min(wake.value_or(temporal::no_bound), event);
    if (next > seconds(until)) break;
    now_ = std::max(now_, next);
    Outputs outputs;
    if (event == next) {
      Event due = std::move(events_.begin()->second);
      std::erase_if(ends_, [&](const auto& end) { return end.second == events_.begin(); });
      events_.erase(events_.begin());
      outputs = due.act ? due.act(now_) : executive.step(now_, due.inputs);
    } else {
      outputs = executive.step(now_, {});
    }
    note(outputs);
    wake = outputs.next_wake;
  }
  return trace;
}

void ScriptedWorld::note(const Outputs& outputs) {
  const std::string at = clock_text(now_) + " ";
  for (const StepStatus& change : outputs.changes)
    if (change.state != temporal::ActivityState::dispatched)
      trace.push_back(at + change.activity + " " + to_string(change.state) +
                      (change.reason.empty() ? "" : " (" + change.reason + ")"));
  for (const Command& command : outputs.commands) {
    const bool execute = command.action == CommandAction::execute;
    trace.push_back(at +
                    (execute                                  ? "execute "
                     : command.action == CommandAction::query ? "query "
                                                              : "cancel ") +
                    command.activity + "#" + std::to_string(command.attempt));
    if (!command.arguments.empty()) arguments[command.activity] = command.arguments.front().value;
    answer(command);
  }
  for (const RecoveryStep& recovery : outputs.recoveries)
    recoveries.push_back(at + std::string(to_string(recovery.action)) + " " + recovery.activity + ": " +
                         recovery.reason);
  for (const DecisionStatus& request : outputs.decisions) {
    if (request.state != DecisionState::open) continue;
    std::string line = at + "ask " + request.resolver + ": " + request.decision + "?";
    for (const std::string& choice : request.choices) line += " " + choice;
    trace.push_back(line);
  }
  if (outputs.outcome.kind == outcome_) return;
  outcome_ = outputs.outcome.kind;
  std::string line = at + "plan " + name_of(outcome_);
  if (outcome_ == OutcomeKind::broken)
    line += ": " + name_of(outputs.outcome.breakage) + ", " + outputs.outcome.activity + ", " +
            outputs.outcome.reason;
  trace.push_back(line);
}

void ScriptedWorld::answer(const Command& command) {
  const auto found = answers_.find(command.activity);
  Answer answer;
  if (found != answers_.end())
    answer = found->second.at(std::min<std::size_t>(command.attempt, found->second.size()) - 1);
  const auto ack = [&](Time at, CommandStage stage, const std::string& reason) {
    return events_.emplace(at, Event{{.acks = {{command.activity, command.attempt, stage, "", reason}}}});
  };
  if (command.action == CommandAction::cancel) {
    if (const auto end = ends_.find(command.activity); answer.answers_cancel && end != ends_.end()) {
      events_.erase(end->second);
      ends_.erase(end);
    }
    if (answer.answers_cancel) ack(now_, CommandStage::cancelled, "");
    return;
  }
  if (!answer.accepts) return;
  ack(now_, CommandStage::accepted, "");
  const Time end = now_ + (answer.lasts < 0 ? command.expected : seconds(answer.lasts));
  ends_[command.activity] = ack(end, answer.ends_with, answer.reason);
}

}  // namespace roci::exec::testing
