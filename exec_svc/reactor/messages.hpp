// These plain values go into the reactor and come out of it, without DDS. Their names are those of idl/.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/plan_delta.hpp"
#include "core/temporal/verdict.hpp"
#include "exec_svc/executive/messages.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/orders/order.hpp"
#include "exec_svc/problem/problem.hpp"
#include "exec_svc/reactor/executed_plan.hpp"
#include "exec_svc/reactor/remaining_plan.hpp"

namespace roci::exec::reactor {

/// Says that a service was lost: it is dead, hangs or is cut off.
struct PeerLoss {
  std::string service;
  std::string reason;
  bool observes = false;  ///< it is a source of observations: beliefs may be stale until it is back
};

/// Holds a call to the planner; its reply comes back with the same id.
struct PlanRequest {
  std::uint64_t id = 0;
  std::string problem_name;
  problem::Problem problem;
  temporal::Time origin{0};              ///< mission time that the problem calls 0
  std::vector<PlannedAction> remaining;  ///< rest of the plan before, with which the planner begins
};

/// Names a goal that the planner proved to be out of reach.
struct BlockingGoal {
  goals::GoalKey key;
  std::string timeline;  ///< that nothing brings about, or that runs out; empty: not known
  std::string reason;    ///< empty: no plan brings it about, and nobody says why
};

/// Says how a planner call ended.
struct PlanReply {
  std::uint64_t call = 0;
  temporal::Verdict verdict = temporal::Verdict::no_reply;
  std::string reason;                  ///< of the verdict, in plain words; may be empty
  std::vector<BlockingGoal> blocking;  ///< with unsolvable, or timeout; none: not known, or all together
  temporal::FlexiblePlan plan;  ///< with solved; of an engine that reads PDDL it names actions, not commands
};

/// Gives the version of the model behind an owner's functions, e.g. a map or an arm. Versions rise.
struct ModelVersion {
  std::string owner;
  std::uint64_t version = 0;
};

/// Tells an engine that plans all the time what became of its versions.
struct PlanReceipt {
  std::uint32_t version = 0;  ///< version that is executed; 0: none is, and the next one is to come whole
  std::uint32_t refused = 0;  ///< the newest one, if it was not taken, for this reason
  std::string reason;
  std::string conflict;  ///< conflict seen ahead in the executed version (R81); empty: none is
  bool open = false;     ///< a plan would be taken now
  bool operator==(const PlanReceipt&) const = default;
};

/// Holds an answer to a decision, as it came in.
struct GivenAnswer {
  orders::IssuedKey key;
  goals::SampleId sample;
  std::string decision;
  std::string choice;  ///< one of its choices; or
  std::string value;   ///< for the arguments that it binds
};

/// Holds a decision that some plan has asked for.
struct DecisionRecord {
  executive::DecisionStatus status;
  std::uint32_t plan_version = 0;  ///< version that asked for it
};

/// Says what became of an answer.
struct AnswerReceipt {
  orders::IssuedKey key;
  goals::SampleId answers;  ///< the sample that brought it
  std::string decision;
  executive::AnswerResult result;
};

/// Holds what happened since the last step. Each list is in the order of events.
struct ReactorInputs {
  bool restarted = false;   ///< the executive was restarted and its state is back; owners' may not be
  std::uint64_t epoch = 0;  ///< executive's epoch from this step on; 0: as before
  std::vector<goals::GoalRequest> goals;
  std::vector<executive::Observation> observations;
  std::vector<executive::CommandAck> acks;
  std::vector<PeerLoss> losses;
  std::vector<std::string> arrivals;  ///< services that came (back)
  std::vector<ModelVersion> models;
  std::optional<PlanReply> reply;
  std::vector<temporal::PlanDelta> deltas;     ///< of an engine that plans all the time
  std::vector<GivenAnswer> answers;            ///< to decisions of the running plan
  std::vector<orders::Order> ground_orders;    ///< of the ground
  std::vector<goals::GoalRecord> handed_over;  ///< records of another executive, which led apart
};

/// Says what the reactor is doing, in the order of MissionPhase in idl/plan.idl.
enum class MissionPhase {
  idle,       ///< no plan runs and none is wanted
  pausing,    ///< what runs is cancelled, components fall back
  planning,   ///< the planner works, nothing runs
  executing,  ///< a plan runs
  safe,       ///< the robot was made safe; goals wait for the ground or for a service
  finished,   ///< every goal has its end
};
/// Returns "idle", "pausing", …: the name above.
const char* to_string(MissionPhase phase);

/// Says how serious an event is.
enum class Severity { info, warning, error };

/// Holds what operators are told: a stable code and plain words.
struct Event {
  Severity level = Severity::info;
  std::string code;  ///< e.g. "goal.dropped"
  std::string text;
};

/// Holds what one step decided. Each list is in the order of decisions.
struct ReactorOutputs {
  std::vector<executive::Command> commands;
  std::vector<goals::GoalRecord> goal_changes;
  std::vector<executive::StepStatus> steps;
  std::vector<Event> events;
  std::optional<std::uint64_t> cancelled_call;  ///< its reply is no longer wanted, but its end is awaited
  std::optional<PlanRequest> call;
  std::optional<temporal::FlexiblePlan> adopted;  ///< a plan that now runs
  std::optional<ExecutedPlan> executed;           ///< one that has ended
  std::optional<PlanReceipt> receipt;
  std::vector<DecisionRecord> decisions;            ///< those of which the state has changed
  std::vector<AnswerReceipt> answer_receipts;       ///< one for each answer that was not known
  std::vector<orders::OrderStatus> order_statuses;  ///< each stage of an order that was reached
  std::vector<executive::Observation> values;       ///< values that the ground has set
  /// Lists what the plan has made of timelines that nobody observes, and which subsystems the executive does
  /// not trust (`trust.SUBSYSTEM`). One without a value is no longer known.
  std::vector<executive::Observation> concluded;
  std::optional<temporal::Time> wake;  ///< step() is to be called then, if nothing comes before
};

/// Counts planner calls, replans, and goals by their state.
struct ReactorCounts {
  std::uint32_t planner_calls = 0;
  std::uint32_t replans = 0;  ///< wishes for a plan that were granted after a first plan was adopted
  std::uint32_t achieved = 0, dropped = 0, failed = 0, rejected = 0, open = 0;  ///< goals
};

}  // namespace roci::exec::reactor
