#include "exec_svc/journal/decisions.hpp"

#include <algorithm>
#include <array>
#include <sstream>

namespace roci::exec::journal {

using executive::Command;
using executive::StepStatus;
using goals::GoalRecord;
using reactor::AnswerReceipt;
using reactor::DecisionRecord;
using reactor::Event;
using reactor::PlannedAction;
using reactor::PlanReceipt;
using reactor::PlanRequest;
using reactor::ReactorOutputs;

namespace {

std::string properties_text(const std::vector<temporal::Property>& properties) {
  std::string out;
  for (const temporal::Property& property : properties) out += " " + property.name + "=" + property.value;
  return out;
}

std::int64_t number(temporal::Duration bound) { return bound == temporal::no_bound ? -1 : bound.count(); }

std::string line_of(const GoalRecord& goal) {
  return goal.request.key.text() + " " + std::to_string(static_cast<int>(goal.state)) + " " + goal.reason;
}

// Writes activity, state, window of its start in microseconds of mission time (-1: no bound), and cause.
std::string line_of(const StepStatus& step) {
  return step.activity + " " + std::to_string(static_cast<int>(step.state)) + " [" +
         std::to_string(step.earliest_start.count()) + "," + std::to_string(number(step.latest_start)) +
         "] " + step.reason;
}

std::string line_of(const temporal::FlexiblePlan& plan) {
  std::ostringstream out;
  out << "plan " << plan.id << " " << plan.version << " origin " << plan.origin.count();
  for (const temporal::PlanActivity& activity : plan.activities) {
    out << "; " << activity.id << " [" << activity.duration_lower.count() << ","
        << number(activity.duration_upper) << "]" << properties_text(activity.arguments);
  }
  for (const temporal::TemporalConstraint& constraint : plan.constraints) {
    out << "; " << constraint.from_point << "-" << constraint.to_point << " [" << constraint.lower.count()
        << "," << number(constraint.upper) << "]";
  }
  return out.str();
}

std::string line_of(const PlanReceipt& receipt) {
  return "receipt " + std::to_string(receipt.version) + " refused " + std::to_string(receipt.refused) + " " +
         receipt.reason + (receipt.conflict.empty() ? "" : " conflict: " + receipt.conflict) +
         (receipt.open ? "" : " (no plan would be taken)");
}

std::string line_of(const DecisionRecord& decision) {
  const executive::DecisionStatus& status = decision.status;
  std::string out = "decision " + status.decision + " " + std::to_string(decision.plan_version) +
                    " state=" + std::to_string(static_cast<int>(status.state)) + " of " + status.resolver +
                    " before " + std::to_string(number(status.answer_before));
  for (const std::string& choice : status.choices) out += " (" + choice + ")";
  return status.answered_by.empty() ? out : out + " = " + status.chosen + " by " + status.answered_by;
}

std::string line_of(const AnswerReceipt& receipt) {
  return "answered " + receipt.key.text() + " " + receipt.decision +
         " outcome=" + std::to_string(static_cast<int>(receipt.result.outcome)) + " " + receipt.result.reason;
}

std::string line_of(const orders::OrderStatus& order) {
  return "ordered " + order.key.text() + " stage=" + std::to_string(static_cast<int>(order.stage)) + " " +
         std::to_string(order.plan_version) + " " + order.reason;
}

std::string line_of(const Command& command) {
  return "command " + command.activity + " " + std::to_string(command.attempt) +
         " action=" + std::to_string(static_cast<int>(command.action)) + " " + command.owner + " " +
         command.subsystem + " " + command.command_name + properties_text(command.arguments);
}

// Writes a PDDL problem as it is; else the goals, the state at the origin and what is predicted.
std::string line_of(const PlanRequest& call) {
  const problem::Problem& problem = call.problem;
  if (!problem.text.empty()) return problem.text;
  std::string out = call.problem_name + " origin " + std::to_string(call.origin.count());
  for (const problem::ProblemGoal& goal : problem.goals)
    out += "; goal " + goal.key.text() + ": " + temporal::describe(goal.achieved);
  for (const auto& [timeline, value] : problem.state)
    out += "; " + timeline + " = " + temporal::to_text(value);
  for (const problem::PredictedValue& value : problem.predictions)
    out += "; at " + std::to_string(value.at.count()) + " " + value.timeline + " = " +
           temporal::to_text(value.value);
  return out;
}

std::string line_of(const std::vector<PlannedAction>& remaining) {
  std::string out = "remaining";
  for (const PlannedAction& action : remaining) {
    out += " (" + action.name;
    for (const std::string& argument : action.arguments) out += " " + argument;
    out += ")";
  }
  return out;
}

}  // namespace

std::vector<DecisionLine> decisions(temporal::Time now, const ReactorOutputs& out) {
  const std::string stamp = std::to_string(now.count()) + " ";
  std::vector<DecisionLine> lines;
  for (const GoalRecord& goal : out.goal_changes) lines.push_back({"goal", line_of(goal)});
  for (const Event& event : out.events) lines.push_back({"event", event.code + " " + event.text});
  for (const StepStatus& step : out.steps) lines.push_back({"step", line_of(step)});
  if (out.adopted) lines.push_back({"trace", stamp + line_of(*out.adopted)});
  for (const Command& command : out.commands) lines.push_back({"trace", stamp + line_of(command)});
  for (const DecisionRecord& decision : out.decisions) lines.push_back({"trace", stamp + line_of(decision)});
  for (const AnswerReceipt& receipt : out.answer_receipts)
    lines.push_back({"trace", stamp + line_of(receipt)});
  for (const orders::OrderStatus& order : out.order_statuses)
    lines.push_back({"trace", stamp + line_of(order)});
  if (out.cancelled_call) lines.push_back({"call", "cancel " + std::to_string(*out.cancelled_call)});
  if (out.call) {
    lines.push_back({"call", line_of(*out.call)});
    if (!out.call->remaining.empty()) lines.push_back({"call", line_of(out.call->remaining)});
  }
  if (out.receipt) lines.push_back({"call", line_of(*out.receipt)});
  return lines;
}

bool is_decision(std::string_view kind, std::string_view text) {
  if (kind == "trace") {
    text.remove_prefix(std::min(text.find(' '), text.size()));
    constexpr std::array<std::string_view, 5> kDecided{" plan ", " command ", " decision ", " answered ",
                                                       " ordered "};
    return std::ranges::any_of(kDecided, [&](std::string_view word) { return text.starts_with(word); });
  }
  return kind == "goal" || kind == "event" || kind == "step" || kind == "call";
}

}  // namespace roci::exec::journal
