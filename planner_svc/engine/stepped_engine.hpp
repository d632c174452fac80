// An engine that plans all the time (R66, R77–R81): it is stepped when something was heard and when it wishes,
// and changes its plan version by version.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/temporal/plan_delta.hpp"
#include "core/temporal/projection.hpp"
#include "planner_svc/engine/answer.hpp"
#include "planner_svc/engine/request.hpp"

namespace roci::planner::engine {

/// What an engine that plans all the time is made with.
struct Setup {
  std::string engine;                  ///< its name in the table, to be given in FlexiblePlan::engine
  std::string robot;                   ///< whose plan it is; empty: the only one
  std::string model;                   ///< of the mission, in the engine's own language; empty: it needs none
  std::filesystem::path model_file{};  ///< from which that was read; what the model includes lies beside it
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

/// How soon data must reach the ground, in the order of DataTier in idl/command.idl.
enum class DataTier { critical, decisional, mandatory, residual };
/// What has become of data, in the order of ProductFate in idl/command.idl.
enum class DataFate { stored, sent, received, discarded, left_behind, lost };

/// Data that were generated, as they stand now.
struct DataProduct {
  std::string id;
  std::string source;  ///< activity that made it
  DataTier tier = DataTier::mandatory;
  std::uint64_t bytes = 0;
  temporal::Time created{0};
  temporal::RankVector utility;  ///< as computed from the data; none: it was not
  DataFate fate = DataFate::stored;
  friend bool operator==(const DataProduct&, const DataProduct&) = default;
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
  std::vector<DataProduct> products;
  std::optional<Receipt> receipt;  ///< the newest
  /// The version that is executed if this engine did not send it: it was made before a restart, and an engine
  /// whose memory is gone goes on with it.
  std::optional<temporal::FlexiblePlan> executed;
  /// The highest version number that was ever used: the next one is above.
  std::uint32_t last_version = 0;
};

struct StepOutput {
  /// At most one change of the plan; it is checked before it is sent.
  std::optional<temporal::PlanDelta> delta;
  /// Goals that cannot be planned as things stand; told to operators when they change.
  std::vector<BlockingGoal> blocking;
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
};

}  // namespace roci::planner::engine
