// The task-planning reactor (Stellar, section 5) takes goals and observations in; planner calls, commands and
// reports go out.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/reactor/messages.hpp"

namespace roci::exec::reactor {

/// Decides when a plan is wanted, which goal leaves when not all fit, and when the robot is made safe. It is
/// a functional core: the same inputs at the same times give the same outputs.
class Reactor {
 public:
  /// The mission must outlive the reactor.
  explicit Reactor(const mission::MissionModel& mission);
  ~Reactor();
  Reactor(Reactor&&) noexcept;
  Reactor& operator=(Reactor&&) noexcept;

  /// Restores, before the first step after a restart, the goals as the journal has them and the last plan
  /// version used.
  void restore(const std::vector<goals::GoalRecord>& goals, std::uint32_t last_plan_version);

  /// The same for what the ground leaves to the executive.
  void restore_authority(mission::AutonomyLevel level, bool held);

  /// Restores likewise what plans have made of timelines that nobody observes.
  void restore_concluded(const std::map<std::string, temporal::Value>& concluded);

  ReactorOutputs step(temporal::Time now, const ReactorInputs& inputs);

  /// Returns whether nothing is commanded and no end of a command is awaited, so that snapshot() holds the
  /// whole state.
  bool at_rest() const;
  std::string snapshot() const;
  /// Goes on, before the first step, as the reactor of which the snapshot was taken. Throws ArchiveError.
  void restore(std::string_view snapshot);

  const temporal::FlexiblePlan& plan() const;
  /// Returns what the planner wrote for the plan; after a restart, the part that had not begun.
  const std::vector<PlannedAction>& planned_actions() const;
  std::vector<executive::StepStatus> steps() const;
  /// Returns RunningPlan::last_executed().
  const std::optional<ExecutedPlan>& last_executed() const;

  MissionPhase phase() const;
  std::uint32_t plan_version() const;
  ReactorCounts counts() const;
  const goals::GoalSet& goals() const;
  /// Return whether the engine plans all the time, and what it was told last (an empty receipt if it does
  /// not).
  bool plans_continuously() const;
  const PlanReceipt& receipt() const;
  /// Return the decisions that plans have asked for, and the newest receipt of each answer.
  const std::map<std::string, DecisionRecord>& decisions() const;
  std::vector<AnswerReceipt> answer_receipts() const;
  /// Return where every order of the ground stands, and the present values of the timelines that it has set,
  /// which tasks may have changed since.
  std::vector<orders::OrderStatus> order_statuses() const;
  std::map<std::string, temporal::Value> ground_values() const;
  /// Returns the newest value of every timeline that was observed.
  const std::map<std::string, temporal::Value>& observed() const;
  /// Returns what plans have made of timelines that nobody observes.
  const std::map<std::string, temporal::Value>& concluded() const;
  /// Returns what of it is told to others (MissionState::tells_conclusion()).
  std::map<std::string, temporal::Value> told_conclusions() const;
  mission::AutonomyLevel autonomy() const;
  /// Returns whether nothing new starts, by order.
  bool held() const;
  /// Returns "achieved" if there was a hard goal and every one was achieved (rejected goals of a console do
  /// not count, since their sender was told); "partial" if some hard goal was not and the robot is safe;
  /// "failed" if the robot is not safe; an empty text while goals are open.
  std::string outcome() const;

 private:
  struct Parts;  ///< on the heap, since the parts know each other by address
  void take_services(const ReactorInputs& inputs);
  void resume(temporal::Time now);
  void finish_if_done();

  std::unique_ptr<Parts> parts_;
};

}  // namespace roci::exec::reactor
