/// The task-planning reactor (Stellar, section 5): goals and observations in; planner calls, commands and
/// reports out. A functional core: the same inputs at the same times give the same outputs. It decides when a
/// plan is wanted, which goal leaves when not all fit, and when the robot is made safe.
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

class Reactor {
 public:
  /// The mission outlives the reactor.
  explicit Reactor(const mission::MissionModel& mission);
  ~Reactor();
  Reactor(Reactor&&) noexcept;
  Reactor& operator=(Reactor&&) noexcept;

  /// Before the first step, after a restart: goals as the journal has them, the last plan version used.
  void restore(const std::vector<goals::GoalRecord>& goals, std::uint32_t last_plan_version);

  /// The same for what the ground leaves to the executive.
  void restore_authority(mission::AutonomyLevel level, bool held);

  /// The same for what plans have made of timelines that nobody observes.
  void restore_concluded(const std::map<std::string, temporal::Value>& concluded);

  ReactorOutputs step(temporal::Time now, const ReactorInputs& inputs);

  /// Nothing is commanded and no end of a command awaited: snapshot() is all there is to know.
  bool at_rest() const;
  std::string snapshot() const;
  /// Before the first step: goes on as the reactor of which the snapshot was taken. Throws ArchiveError.
  void restore(std::string_view snapshot);

  const temporal::FlexiblePlan& plan() const;
  /// What the planner wrote for it; after a restart what nobody had begun.
  const std::vector<PlannedAction>& planned_actions() const;
  std::vector<executive::StepStatus> steps() const;
  /// RunningPlan::last_executed().
  const std::optional<ExecutedPlan>& last_executed() const;

  MissionPhase phase() const;
  std::uint32_t plan_version() const;
  ReactorCounts counts() const;
  const goals::GoalSet& goals() const;
  /// Whether its engine plans all the time; what that was told last (of nothing, if it does not).
  bool plans_continuously() const;
  const PlanReceipt& receipt() const;
  /// The decisions that plans have asked for, and the newest receipt of each answer.
  const std::map<std::string, DecisionRecord>& decisions() const;
  std::vector<AnswerReceipt> answer_receipts() const;
  /// Where every order of the ground stands, and the timelines that it has set, as they are now:
  /// tasks may have changed them since.
  std::vector<orders::OrderStatus> order_statuses() const;
  std::map<std::string, temporal::Value> ground_values() const;
  /// The newest value of every timeline that was observed.
  const std::map<std::string, temporal::Value>& observed() const;
  /// What plans have made of timelines that nobody observes.
  const std::map<std::string, temporal::Value>& concluded() const;
  mission::AutonomyLevel autonomy() const;
  /// Returns whether nothing new starts, by order.
  bool held() const;
  /// "achieved": every hard goal, and there was one (a console's goals that were rejected do not count:
  /// whoever sent them was told); "partial": some hard goal was not, robot safe; "failed": robot not safe;
  /// empty while open.
  std::string outcome() const;

 private:
  struct Parts;  ///< on the heap: they know each other by address
  void take_services(const ReactorInputs& inputs);
  void resume(temporal::Time now);
  void finish_if_done();

  std::unique_ptr<Parts> parts_;
};

}  // namespace roci::exec::reactor
