// These plain values go into the executive and come out of it, without DDS.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/value.hpp"

namespace roci::exec::executive {

/// Begins the activity name of every fall-back; owners accept a fall-back even where they hold another epoch
/// or none (services/owner/command.hpp).
inline constexpr char kFallbackPrefix[] = "fallback.";

/// Says what a command asks its owner to do with a key.
enum class CommandAction { execute, cancel, query };

/// Says what an owner reports of a command.
enum class CommandStage { accepted, rejected, completed, failed, cancelled, cancel_failed, unknown };

/// Holds one timeline's newest value.
struct Observation {
  std::string timeline;
  temporal::Value value;
};

/// Holds what a command took and brought, as its owner said with its end; absent where it said nothing.
/// Energies are in joules.
struct CommandResults {
  std::optional<temporal::Duration> duration{};
  std::optional<double> energy_j{};
  std::map<std::string, temporal::Value> values{};
  friend bool operator==(const CommandResults&, const CommandResults&) = default;
};

/// Holds an owner's answer to the command (activity, attempt).
struct CommandAck {
  std::string activity;
  std::uint32_t attempt = 0;
  CommandStage stage = CommandStage::accepted;
  std::string code;
  std::string reason;
  std::uint64_t epoch = 0;  ///< epoch in which the command was issued; 0: not told, any fits
  /// Says that the owner took nothing, as it knows a later epoch; the executive's is later still by now.
  bool refused_epoch = false;
  CommandResults results{};
};

/// Holds an answer to an open decision of the plan.
struct DecisionAnswer {
  std::string decision;
  std::string choice;    ///< one of the decision's choices; or
  std::string value{};   ///< for the arguments that the decision binds
  std::string issuer{};  ///< who gave it
};

/// Says what became of an answer, in the order of AnswerOutcome in idl/order.idl.
enum class AnswerOutcome {
  taken,
  late,              ///< its time has passed, or the plan no longer asks
  repeated,          ///< the decision was answered before, or this very answer was given before
  unknown_decision,  ///< nobody asks for it
  unknown_choice,    ///< it has no such choice, or does not admit the value
  not_entitled,      ///< somebody else is asked
};

/// Says what became of an answer, and why.
struct AnswerResult {
  AnswerOutcome outcome = AnswerOutcome::taken;
  std::string reason{};  ///< in plain words; empty: it was taken
};

/// Holds what happened since the last step. Each list is in the order of events.
struct Inputs {
  std::vector<Observation> observations{};
  /// Lists values that the ground has set; impacts of activities may change them later.
  std::vector<Observation> settings{};
  std::vector<CommandAck> acks{};
  std::vector<std::string> lost_owners{};   ///< services found dead, hung or cut off
  std::vector<std::string> found_owners{};  ///< services that came (back)
  std::vector<DecisionAnswer> answers{};
  std::uint64_t epoch = 0;  ///< executive's epoch from this step on; 0: as before
};

/// Holds what the executive asks of an owner.
struct Command {
  CommandAction action = CommandAction::execute;
  std::string activity;
  std::uint32_t attempt = 1;
  std::string owner;
  std::string subsystem;
  std::string command_name;
  std::vector<temporal::Property> arguments;
  temporal::Duration expected{0};  ///< shortest duration of the activity
  std::uint64_t epoch = 0;         ///< epoch in which the key was issued; 0: the commander's own
  temporal::Time latest_end = temporal::no_bound;  ///< time by which its step must have ended
  std::string robot{};     ///< robot that has the subsystem; empty: the owner's only one
  std::uint32_t plan = 0;  ///< version of the plan that issued the key; 0: of the one that runs
};

/// Holds the state of one activity; times are mission times.
struct StepStatus {
  std::string activity;
  std::string name;
  std::uint32_t attempt = 0;  ///< 0: no command sent yet
  temporal::ActivityState state = temporal::ActivityState::waiting;
  temporal::Time earliest_start{0};
  temporal::Time latest_start = temporal::no_bound;
  std::optional<temporal::Time> started;
  std::optional<temporal::Time> ended;
  std::string reason;  ///< says why it is in this state, where that is not obvious
};

/// Says how far a decision that was asked for has come, in the order of DecisionState in idl/order.idl.
enum class DecisionState {
  open,
  answered,
  missed,  ///< no answer came in time, and the plan is broken
  void_,   ///< the plan ended, or another one took its place, before it was answered
};

/// Holds a decision that was asked for. It is reported when it is asked for and when its state changes.
struct DecisionStatus {
  std::string decision;
  /// Says who is asked: a service, an engine, an issuer; "rule": the choices' own conditions.
  std::string resolver;
  std::vector<std::string> choices;
  std::vector<std::string> admissible;                ///< values that may be bound; empty: any
  temporal::Time answer_before = temporal::no_bound;  ///< a later answer is late
  DecisionState state = DecisionState::open;
  std::string chosen{};       ///< the choice or the value
  std::string answered_by{};  ///< who gave the answer that was taken
  friend bool operator==(const DecisionStatus&, const DecisionStatus&) = default;
};

/// Says what is done about a step that cannot start or fails, and needs no planner; the cheapest comes first.
enum class RecoveryAction {
  push,         ///< a start waits for its preconditions, until its wait timeout (R98)
  retry,        ///< sends the same command again (R99)
  contingency,  ///< commands of a template, then the same command again or a broken plan (R69, R70)
};

/// Returns "push", "retry" or "contingency".
const char* to_string(RecoveryAction action);

/// Says that a recovery action was taken, or a contingency ended.
struct RecoveryStep {
  RecoveryAction action = RecoveryAction::push;
  std::string activity;
  std::string reason;  ///< says why, and what is done
};

/// Says how a plan's run stands.
enum class OutcomeKind {
  idle,  ///< no plan loaded
  running,
  finished,    ///< every activity succeeded or was skipped
  broken,      ///< nothing new is started; running activities are followed until they end or cancel_all()
  cancelling,  ///< cancel_all(): answers are awaited, for a bounded time
  cancelled,   ///< nothing of the plan runs any more, or its owner did not answer the cancel in time
};

/// Says how a plan broke.
enum class Breakage {
  none,
  late_start,         ///< an activity's latest start has passed (R49)
  activity_failed,    ///< its command, a condition, a wait or its owner failed; the retries are used up
  refused_for_good,   ///< its owner has no such command or component: no other try will be taken either
  deadline_passed,    ///< LatenessPolicy::deadline: still running at the latest next change of its timeline
  ordering_violated,  ///< an end was observed before an event that the plan orders before it
  decision_missing,   ///< no answer in time
};

/// Says how the plan's run stands, and who broke it.
struct Outcome {
  OutcomeKind kind = OutcomeKind::idle;
  Breakage breakage = Breakage::none;  ///< says how a broken plan broke
  std::string activity;                ///< the one that broke it; for decision_missing the decision
  std::string reason;                  ///< in plain words
  std::string contingency;             ///< named by the activity; used up, or not known here
};

/// Holds what one step says and asks for.
struct Outputs {
  std::vector<Command> commands{};          ///< in the order of sending
  std::vector<StepStatus> changes{};        ///< every change of state, in the order of events
  std::vector<DecisionStatus> decisions{};  ///< every change of state, in the order of events
  std::vector<AnswerResult> answers{};      ///< of the step's answers, in their order
  std::vector<RecoveryStep> recoveries{};
  Outcome outcome{};                          ///< as it stands after this step
  std::optional<temporal::Time> next_wake{};  ///< step again then, if nothing happens before
};

}  // namespace roci::exec::executive
