// An engine that plans all the time (R66, R77–R81): it is stepped when something was heard and when it wishes,
// and changes its plan version by version.
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
#include "planner_svc/engine/outlook.hpp"
#include "planner_svc/engine/request.hpp"

namespace roci::planner::engine {

/// What an engine that plans all the time is made with.
struct Setup {
  std::string engine;  ///< its name in the table, to be given in FlexiblePlan::engine
  std::string robot;   ///< whose plan it is; empty: the only one
  std::string model;   ///< of the mission, in the engine's own language; empty: it needs none
  /// Is the file from which that was read, or the newest of the ground; what the model includes lies beside it.
  std::filesystem::path model_file{};
  /// Ways to plan that the mission names for it, of those in the table.
  std::vector<std::string> resolvers{};
};

/// The newest value of a timeline, as its owner measured it.
struct Observation {
  std::string timeline;
  temporal::Value value;
  temporal::Time sampled{0};
};

/// How an activity of the executed version stands.
struct StepStatus {
  std::uint32_t plan_version = 0;
  std::string activity;
  temporal::ActivityProgress progress;
  std::string cause;          ///< of a failure
  std::uint32_t attempt = 0;  ///< counts from 1; 0: no command was sent
};

/// What a command took and brought, as its owner said when it was completed. The command of an activity's second try,
/// and the second of a sequence, have attempt 2.
struct CommandResult {
  std::string activity;
  std::uint32_t attempt = 0;
  std::optional<double> energy_j{};        ///< drawn by it alone; nothing: not measured
  std::map<std::string, double> values{};  ///< numbers that it brought, all finite
  friend bool operator==(const CommandResult&, const CommandResult&) = default;
};

/// What became of a goal in the end: in the order of GoalState in idl/goal.idl.
enum class GoalState { rejected, pending, planned, achieved, dropped, failed, recalled };

struct EndedGoal {
  std::string issuer;
  std::string id;
  GoalState state = GoalState::achieved;
};

/// What became of the engine's versions.
struct Receipt {
  std::uint32_t version = 0;  ///< that is executed; 0: none is, and the next one is to come whole
  std::uint32_t refused = 0;  ///< the newest one, if it was not taken, by executive or checker; 0: none
  std::string reason;         ///< for that
  std::string conflict;       ///< that the executive sees ahead in its version; empty: none
  bool open = false;          ///< a plan would be taken now
  friend bool operator==(const Receipt&, const Receipt&) = default;
};

/// What the ground changes of the engine's model, under its key (R83, R118).
/// It is obeyed whole or not at all, between two cycles.
struct ModelChange {
  std::string issuer;
  std::string id;
  /// Is the whole new one, in the engine's own binary form; nothing: a parameter gets a value.
  std::optional<std::string> model;
  std::string parameter;
  double value = 0;
};

/// What has become of a change.
struct ModelAnswer {
  std::string issuer;
  std::string id;
  /// Tells all that is wrong, each with place and remedy, and nothing has changed; empty: it is taken.
  std::vector<std::string> refused;
};

/// Names a model: of its versions the greater is the newer.
struct ModelName {
  std::string name;
  std::uint64_t version = 0;
  friend bool operator==(const ModelName&, const ModelName&) = default;
};

/// All that was heard since the step before, each list in the order in which it was heard. After a restart
/// of the process everything that still counts is heard again.
struct StepInputs {
  temporal::Time now{0};
  /// New and changed goals that the executive has taken, each until it ends.
  std::vector<Goal> goals;
  std::vector<EndedGoal> ended_goals;
  std::vector<Observation> observations;
  std::vector<StepStatus> steps;
  /// May come before or after the step's own end.
  std::vector<CommandResult> results;
  std::vector<DataProduct> products;
  std::vector<ModelChange> model_changes;
  std::optional<Receipt> receipt;  ///< the newest
  /// The version that is executed if this engine did not send it: it was made before a restart, and an engine
  /// whose memory is gone goes on with it.
  std::optional<temporal::FlexiblePlan> executed;
  /// The highest version number that was ever used: the next one is above.
  std::uint32_t last_version = 0;
};

/// Says what a step did, in the engine's own words; who reads the events of a run sees it.
struct StepAccount {
  std::vector<std::string> parts;  ///< of the step that had something to do, in their order
  std::uint64_t explored = 0;      ///< possibilities that searches looked at
  std::vector<std::string> notes;  ///< what was given up, and why
  bool empty() const { return parts.empty() && explored == 0 && notes.empty(); }
};

struct StepOutput {
  /// Holds at most one change of the plan; it is checked before it is sent.
  std::optional<temporal::PlanDelta> delta;
  /// Goals that cannot be planned as things stand; told to operators when they change.
  std::vector<BlockingGoal> blocking;
  /// One for each change of the model that was heard; a change without an answer is told to be none of the engine's.
  std::vector<ModelAnswer> model_answers;
  ModelName model;  ///< with which it plans; empty: it has none
  /// What was measured and is not believed, with the reason; told to operators.
  std::vector<std::string> doubted;
  /// Told as the event planner.cycle where it is not empty.
  StepAccount account;
  /// Each whole, and only where it is another one than was told before; at most once a cycle.
  std::optional<DownlinkSchedule> schedule;
  std::optional<MissionOutlook> outlook;
  /// Mission time of the next step if nothing is heard before; a past one counts as none.
  std::optional<temporal::Time> wake;
};

class SteppedEngine {
 public:
  virtual ~SteppedEngine() = default;

  /// Takes in what was heard and perhaps changes the plan. What it puts out is a function of all inputs since
  /// it was made. Runs beside the event loop, one step at a time, and should end within some hundred
  /// milliseconds. What it throws is told, and the engine is made anew.
  virtual StepOutput step(const StepInputs& inputs) = 0;
  /// Returns the model with which it plans, whole and in the engine's own binary form, as in ModelChange; empty: it has
  /// none.
  virtual std::string packed_model() const { return {}; }
};

}  // namespace roci::planner::engine
