// One plan under execution: what the executive's step does, part by part.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "exec_svc/executive/activity_run.hpp"
#include "exec_svc/executive/executive.hpp"
#include "exec_svc/executive/messages.hpp"
#include "exec_svc/executive/point_dispatcher.hpp"
#include "exec_svc/executive/timeline_store.hpp"

namespace roci::exec::executive {

class PlanRun {
 public:
  /// The plan has passed check(); the store outlives the run.
  PlanRun(temporal::FlexiblePlan plan, const ExecutiveSettings& settings, TimelineStore& store);

  /// Takes over from the run before what was started and stands in this plan too; the rest of it is
  /// cancelled.
  void adopt(PlanRun& before);

  /// False: nothing that matches is awaited.
  bool take_ack(const CommandAck& ack, temporal::Time now);
  bool take_answer(const DecisionAnswer& answer, temporal::Time now);
  void lose_owner(const std::string& owner, temporal::Time now);
  /// Acts on everything that holds at `now`, until nothing more happens.
  void advance(temporal::Time now);
  void cancel_all(temporal::Time now);
  void hold_starts(bool hold) { held_ = hold; }
  /// Asks what became of all that runs.
  void resume(temporal::Time now);

  /// What was said and asked for since the last call, with the outcome as it is now.
  Outputs take_outputs(temporal::Time now);
  const Outcome& outcome() const { return outcome_; }
  const temporal::FlexiblePlan& plan() const { return plan_; }
  const temporal::PlanActivity* find(const std::string& activity) const;
  StepStatus status(std::size_t activity) const;
  /// Of all activities, in plan order.
  std::vector<StepStatus> statuses() const;
  std::vector<StepStatus> upcoming(std::size_t most) const;
  std::vector<StepStatus> running() const;
  std::uint64_t window_work() const { return points_.work(); }
  std::vector<Executive::TokenStatus> tokens() const;

 private:
  using Index = std::size_t;  // of an activity

  // plan_run.cpp: the run as a whole
  void break_plan(Breakage breakage, const std::string& who, const std::string& reason,
                  const std::string& contingency);
  void update_outcome();
  std::optional<temporal::Time> next_wake(temporal::Time now);
  void change(Index activity, temporal::ActivityState state, std::string reason);
  void enter(Index activity, ActivityPhase phase, temporal::Time now);
  void send(Index activity, CommandAction action);
  temporal::Lookup lookup() const;
  bool starting() const { return outcome_.kind == OutcomeKind::running; }

  // resuming.cpp: after a restart
  bool take_query_answer(Index activity, const CommandAck& ack, temporal::Time now);

  // dispatching.cpp: points that may happen now
  bool dispatch(temporal::Time now);
  bool attempt(temporal::TimePoint point, temporal::Time now);
  void note_overruns(temporal::Time now);
  bool try_start(Index activity, temporal::Time now);
  bool try_internal_end(Index activity, temporal::Time now);
  void start(Index activity, temporal::Time now);
  void skip(Index activity, const std::string& reason);
  void consider_wait(Index activity, temporal::Time now);
  void begin_wait(Index activity, temporal::Time now, temporal::Duration bound);
  void recover(RecoveryAction action, Index activity, std::string reason);

  bool expire_waits(temporal::Time now);
  void break_if_late(temporal::Time now);
  void break_if_disordered();

  // monitoring.cpp: activities under way
  bool monitor(temporal::Time now);
  bool monitor_activity(Index activity, temporal::Time now);
  bool check_maintenance(Index activity, temporal::Time now);
  bool try_finish(Index activity, temporal::Time now);
  void succeed(Index activity, temporal::Time now);
  void fail(Index activity, temporal::Time now, Breakage breakage, const std::string& reason,
            bool still_commanded);
  void fail_or_retry(Index activity, temporal::Time now, const std::string& reason);
  bool retry(Index activity, temporal::Time now, const std::string& reason);
  void try_again(Index activity, temporal::Time now, const std::string& reason);
  void close(Index activity, temporal::Time now, temporal::ActivityState state, const std::string& reason);
  void cancel(Index activity, temporal::Time now, AfterCancel after, const std::string& reason);
  void take_cancel_answer(Index activity, const CommandAck& ack, temporal::Time now);
  void cancel_is_over(Index activity, temporal::Time now, const std::string& answer);
  temporal::Time deadline(Index activity) const;
  temporal::Time hung_after(Index activity) const;
  temporal::Time settled_from(Index activity) const;
  temporal::Time next_timer(Index activity, temporal::Time now) const;

  // contingency.cpp: commands from a template after a failure
  const Contingency* contingency_of(Index activity) const;
  std::string contingency_owner(Index activity) const;
  bool begin_contingency(Index activity, temporal::Time now, const std::string& reason);
  void send_contingency(Index activity, CommandAction action);
  bool take_contingency_ack(const CommandAck& ack, temporal::Time now);
  bool monitor_contingency(Index activity, temporal::Time now);
  void end_contingency(Index activity, temporal::Time now, const std::string& reason);
  temporal::Time contingency_timer(Index activity) const;

  // deciding.cpp: open choices
  bool decide(temporal::Time now);
  temporal::Time answer_before(Index decision) const;

  temporal::FlexiblePlan plan_;
  const ExecutiveSettings& settings_;
  TimelineStore& store_;
  PointDispatcher points_;
  std::vector<ActivityRun> runs_;
  std::vector<std::optional<temporal::Time>> decisions_;    // when their resolver was asked
  std::vector<std::vector<temporal::TimePoint>> held_by_;   // by decision
  std::vector<std::vector<temporal::TimePoint>> asked_by_;  // of these, those that make it be asked for
  std::unordered_map<std::string, Index> index_of_;
  std::vector<std::vector<std::size_t>> tokens_from_;      // by activity: tokens that begin with it
  std::unordered_map<std::string, Index> contingency_of_;  // by id of its command
  std::set<Index> active_;
  std::set<Index> open_decisions_;
  std::set<std::pair<temporal::Time, Index>> waits_;  // by end of the wait
  std::vector<Index> ended_now_;                      // observed ends since the last look at their order
  std::size_t unfinished_ = 0;
  Index first_waiting_ = 0;  // none before it waits any more
  bool held_ = false;        // nothing starts
  Outcome outcome_;
  Outputs outputs_;
};

}  // namespace roci::exec::executive
