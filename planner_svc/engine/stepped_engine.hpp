// A stepped engine plans all the time (R66, R77–R81): it is stepped when something was heard and when it
// wishes, and changes its plan version by version.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/temporal/plan_delta.hpp"
#include "core/temporal/projection.hpp"
#include "planner_svc/engine/answer.hpp"
#include "planner_svc/engine/data_product.hpp"
#include "planner_svc/engine/mission_outlook.hpp"
#include "planner_svc/engine/request.hpp"

namespace roci::planner::engine {

/// Holds what an engine that plans all the time is made with.
struct Setup {
  std::string engine;  ///< its name in the table, to be given in FlexiblePlan::engine
  std::string robot;   ///< whose plan it is; empty: the only one
  std::string model;   ///< of the mission, in the engine's own language; empty: it needs none
  /// Names the file from which the model was read, or the newest of the ground; what the model includes lies
  /// beside it.
  std::filesystem::path model_file{};
  /// Lists the ways to plan that the mission names for it, of those in the table.
  std::vector<std::string> resolvers{};
};

/// Holds the newest value of a timeline, as its owner measured it.
struct Observation {
  std::string timeline;
  temporal::Value value;
  temporal::Time sampled{0};
};

/// Says how an activity of the executed version stands.
struct StepStatus {
  std::uint32_t plan_version = 0;
  std::string activity;
  temporal::ActivityProgress progress;
  std::string cause;          ///< of a failure
  std::uint32_t attempt = 0;  ///< counts from 1; 0: no command was sent
};

/// Holds what a command took and brought, as its owner said when it was completed. The command of an activity's
/// second try, and the second of a sequence, have attempt 2.
struct CommandResult {
  std::string activity;
  std::uint32_t attempt = 0;
  std::optional<double> energy_j{};        ///< drawn by it alone; nothing: not measured
  std::map<std::string, double> values{};  ///< numbers that it brought, all finite
  friend bool operator==(const CommandResult&, const CommandResult&) = default;
};

/// Says what became of a goal in the end, in the order of GoalState in idl/goal.idl.
enum class GoalState { rejected, pending, planned, achieved, dropped, failed, recalled };

/// Names a goal that has ended, and how.
struct EndedGoal {
  std::string issuer;
  std::string id;
  GoalState state = GoalState::achieved;
};

/// Says what became of the engine's versions.
struct Receipt {
  std::uint32_t version = 0;  ///< version that is executed; 0: none is, and the next one is to come whole
  std::uint32_t refused = 0;  ///< newest one, if executive or checker refused it; 0: none
  std::string reason;         ///< why it was refused
  std::string conflict;       ///< seen ahead by the executive in its version; empty: none
  bool open = false;          ///< a plan would be taken now
  friend bool operator==(const Receipt&, const Receipt&) = default;
};

/// Holds what the ground changes of the engine's model, under its key (R83, R118). It is obeyed whole or not
/// at all, between two cycles.
struct ModelChange {
  std::string issuer;
  std::string id;
  /// Holds the whole new model, in the engine's own binary form; nothing: a parameter gets a value.
  std::optional<std::string> model;
  std::string parameter;
  double value = 0;
};

/// Says what has become of a change.
struct ModelAnswer {
  std::string issuer;
  std::string id;
  /// Lists all that is wrong, each with place and remedy; nothing has changed then. It is empty if the change
  /// is taken.
  std::vector<std::string> refused;
};

/// Names a model; the greater version is the newer one.
struct ModelName {
  std::string name;
  std::uint64_t version = 0;
  friend bool operator==(const ModelName&, const ModelName&) = default;
};

/// Holds all that was heard since the step before, each list in the order in which it was heard. After a
/// restart of the process everything that still counts is heard again.
struct StepInputs {
  temporal::Time now{0};
  /// Lists new and changed goals that the executive has taken.
  std::vector<Goal> goals;
  std::vector<EndedGoal> ended_goals;
  std::vector<Observation> observations;
  std::vector<StepStatus> steps;
  /// Lists results, which may come before or after their step's own end.
  std::vector<CommandResult> results;
  std::vector<DataProduct> products;
  std::vector<ModelChange> model_changes;
  std::optional<Receipt> receipt;  ///< the newest
  /// Holds the version that is executed if this engine did not send it: it was made before a restart, and an
  /// engine without memory of it goes on with it.
  std::optional<temporal::FlexiblePlan> executed;
  /// Holds the highest version number that was ever used; the next one must be above it.
  std::uint32_t last_version = 0;
};

/// Says what a step did, in the engine's own words; it appears among the events of a run.
struct StepAccount {
  std::vector<std::string> parts;  ///< of the step that had something to do, in their order
  std::uint64_t explored = 0;      ///< possibilities that searches looked at
  std::vector<std::string> notes;  ///< what was given up, and why
  bool empty() const { return parts.empty() && explored == 0 && notes.empty(); }
};

/// Holds what one step puts out.
struct StepOutput {
  /// Holds at most one change of the plan; it is checked before it is sent.
  std::optional<temporal::PlanDelta> delta;
  /// Lists the goals that cannot be planned as things stand; operators are told when they change.
  std::vector<BlockingGoal> blocking;
  /// Holds one answer for each change of the model that was heard; a change without an answer is reported as unknown
  /// to the engine.
  std::vector<ModelAnswer> model_answers;
  ModelName model;  ///< model with which it plans; empty: it has none
  /// Lists measurements that are not believed, with the reason; operators are told.
  std::vector<std::string> doubted;
  /// Says what the step did; it becomes the event planner.cycle where it is not empty.
  StepAccount account;
  /// Hold schedule and outlook, each whole, where it differs from the one before; at most once a cycle.
  std::optional<DownlinkSchedule> schedule;
  std::optional<MissionOutlook> outlook;
  /// Holds the mission time of the next step if nothing is heard before; a past one counts as none.
  std::optional<temporal::Time> wake;
};

/// Serves as the base of engines that plan all the time.
class SteppedEngine {
 public:
  virtual ~SteppedEngine() = default;

  /// Takes in what was heard and perhaps changes the plan. What it puts out is a function of all inputs since
  /// it was made. It runs beside the event loop, one step at a time, and should end within some hundred
  /// milliseconds. What it throws is reported, and the engine is made anew.
  virtual StepOutput step(const StepInputs& inputs) = 0;
  /// Returns the model with which it plans, whole and in the engine's own binary form, as in ModelChange; empty: it has
  /// none.
  virtual std::string packed_model() const { return {}; }
};

}  // namespace roci::planner::engine
