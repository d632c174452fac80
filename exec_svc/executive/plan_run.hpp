// A plan run is one plan under execution: it is composed of parts that each own one concern, over one shared
// state.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exec_svc/executive/activity_monitor.hpp"
#include "exec_svc/executive/attempts.hpp"
#include "exec_svc/executive/contingency_runs.hpp"
#include "exec_svc/executive/deadlines.hpp"
#include "exec_svc/executive/decision_points.hpp"
#include "exec_svc/executive/dispatch.hpp"
#include "exec_svc/executive/executive.hpp"
#include "exec_svc/executive/owner_exchange.hpp"
#include "exec_svc/executive/run_state.hpp"
#include "exec_svc/executive/start_waits.hpp"

namespace roci::exec::executive {

/// Says what becomes of an activity without a command that had begun when the plan before was stopped.
enum class AfterStop { starts_anew, goes_on };

/// Runs one plan to its outcome; it is replaced as a whole by the run of the next plan.
class PlanRun {
 public:
  /// The plan has passed check(); settings, permissions and store outlive the run.
  PlanRun(temporal::FlexiblePlan plan, const ExecutiveSettings& settings, const Permissions& permissions,
          TimelineStore& store, std::uint64_t epoch);
  PlanRun(const PlanRun&) = delete;
  PlanRun& operator=(const PlanRun&) = delete;

  /// Takes over from the run before what was started and stands in this plan too; the rest of it is
  /// cancelled.
  void adopt(PlanRun& before, temporal::Time now, AfterStop stopped);

  /// Returns false if nothing that matches is awaited.
  bool take_ack(const CommandAck& ack, temporal::Time now) { return exchange_.take_ack(ack, now); }
  AnswerResult take_answer(const DecisionAnswer& answer, temporal::Time now) {
    return decisions_.take_answer(answer, now);
  }
  void lose_owner(const std::string& owner, temporal::Time now) { exchange_.lose_owner(owner, now); }
  /// Asks an owner that came back before it counted as lost what became of all that it runs.
  void find_owner(const std::string& owner, temporal::Time now) { exchange_.query_all(now, owner); }
  /// Acts on everything that holds at `now`, until nothing more happens.
  void advance(temporal::Time now);
  void cancel_all(temporal::Time now);
  /// Begins an epoch: keys that are issued from now on carry it, and those that were issued keep theirs.
  void begin_epoch(std::uint64_t epoch) { state_.epoch = epoch; }
  /// Leaves the activity out. Returns false if the plan has no such waiting activity.
  bool drop(const std::string& activity, const std::string& reason);
  bool contingency_under_way(const std::string& name) const;
  void hold_starts(bool hold) { dispatch_.hold_starts(hold); }
  /// Asks what became of all that runs.
  void resume(temporal::Time now) { exchange_.query_all(now); }

  /// Returns what was said and asked for since the last call, with the outcome as it is now.
  Outputs take_outputs(temporal::Time now);
  const Outcome& outcome() const { return state_.outcome; }
  const temporal::FlexiblePlan& plan() const { return state_.plan; }
  const temporal::PlanActivity* find(const std::string& activity) const;
  /// Returns the status of all activities, in plan order.
  std::vector<StepStatus> statuses() const;
  std::vector<StepStatus> upcoming(std::size_t most) const;
  std::vector<StepStatus> running() const;
  std::uint64_t window_work() const { return state_.points.work(); }
  std::vector<Executive::TokenStatus> tokens() const;

 private:
  void withdraw_what_is_gone(PlanRun& before);
  void go_on(Index activity, temporal::Time started, temporal::Time now);
  std::optional<temporal::Time> next_wake(temporal::Time now);

  RunState state_;
  StartWaits waits_{state_};
  ContingencyRuns contingencies_{state_};
  Deadlines deadlines_{state_};
  Attempts attempts_{state_, contingencies_, deadlines_};
  OwnerExchange exchange_{state_, contingencies_, deadlines_, attempts_};
  ActivityMonitor monitor_{state_, contingencies_, deadlines_, attempts_, exchange_};
  DecisionPoints decisions_{state_, waits_};
  Dispatch dispatch_{state_, waits_, attempts_};
};

}  // namespace roci::exec::executive
