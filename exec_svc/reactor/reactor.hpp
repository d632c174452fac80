// The task-planning reactor (Stellar, section 5): goals and observations in; planner calls, commands and
// reports out. A functional core: the same inputs at the same times give the same outputs. It owns pause →
// inactive → plan → execute, and decides which goal goes when not all fit.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/plan_delta.hpp"
#include "core/temporal/verdict.hpp"
#include "exec_svc/beliefs/beliefs.hpp"
#include "exec_svc/executive/executive.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/problem/problem_writer.hpp"
#include "exec_svc/reactor/conflict_monitor.hpp"
#include "exec_svc/reactor/failure_backoff.hpp"
#include "exec_svc/reactor/recovery_policy.hpp"
#include "exec_svc/reactor/remaining_plan.hpp"
#include "exec_svc/reactor/resource_monitor.hpp"

namespace roci::exec::reactor {

struct PeerLoss {
  std::string service;
  std::string reason;
};

// A call to the planner; the answer comes back with the same id.
struct PlanRequest {
  std::uint64_t id = 0;
  std::string problem_name;
  problem::Problem problem;
  temporal::Time origin{0};              // mission time of the problem's 0
  std::vector<PlannedAction> remaining;  // of the plan before
};

struct PlanReply {
  std::uint64_t call = 0;
  temporal::Verdict verdict = temporal::Verdict::no_reply;
  std::string reason;
  temporal::FlexiblePlan plan;  // with solved; activities not yet bound to owners
};

// The model behind an owner's functions: a map, an arm. Versions rise.
struct ModelVersion {
  std::string owner;
  std::uint64_t version = 0;
};

// What the engine that plans all the time is told of its versions.
struct PlanReceipt {
  std::uint32_t version = 0;  // that is executed; 0: none, the next one is to come whole
  std::uint32_t refused = 0;  // the last one, if it was not taken, for this reason
  std::string reason;
  bool open = false;  // a plan would be taken now
  bool operator==(const PlanReceipt&) const = default;
};

struct ReactorInputs {
  bool restarted = false;  // the executive was started anew and stands as before; its owners may not
  std::vector<goals::GoalRequest> goals;
  std::vector<executive::Observation> observations;
  std::vector<executive::CommandAck> acks;
  std::vector<PeerLoss> losses;
  std::vector<std::string> arrivals;  // services that came (back)
  std::vector<ModelVersion> models;
  std::optional<PlanReply> reply;
  std::vector<temporal::PlanDelta> deltas;  // of an engine that plans all the time
};

enum class MissionPhase { idle, pausing, planning, executing, safe, finished };
const char* to_string(MissionPhase phase);

enum class Severity { info, warning, error };

// For operators: a stable code and plain words.
struct Event {
  Severity level = Severity::info;
  std::string code;  // e.g. "goal.dropped"
  std::string text;
};

struct ReactorOutputs {
  std::vector<executive::Command> commands;
  std::vector<goals::GoalRecord> goal_changes;
  std::vector<executive::StepStatus> steps;
  std::vector<Event> events;
  std::optional<std::uint64_t> cancelled_call;  // its answer is wanted no more; it is still awaited
  std::optional<PlanRequest> call;
  std::optional<temporal::FlexiblePlan> adopted;  // a plan that now runs
  std::optional<PlanReceipt> receipt;
  std::optional<temporal::Time> wake;  // call step() again then, if nothing comes before
};

struct ReactorCounts {
  std::uint32_t planner_calls = 0;
  std::uint32_t replans = 0;  // times it went back to planning after a first plan was adopted
  std::uint32_t achieved = 0, dropped = 0, failed = 0, rejected = 0, open = 0;
};

class Reactor {
 public:
  explicit Reactor(const mission::MissionModel& mission);

  // Before the first step, after a restart: goals as the journal has them, the last plan version used.
  void restore(const std::vector<goals::GoalRecord>& goals, std::uint32_t last_plan_version);

  ReactorOutputs step(temporal::Time now, const ReactorInputs& inputs);

  // Nothing is commanded and no end of a command awaited: snapshot() is all there is to know.
  bool at_rest() const;
  std::string snapshot() const;
  // Before the first step: goes on as the reactor of which the snapshot was taken. Throws ArchiveError.
  void restore(std::string_view snapshot);

  const temporal::FlexiblePlan& plan() const { return executive_.plan(); }
  std::vector<executive::StepStatus> steps() const { return executive_.steps(); }

  MissionPhase phase() const { return phase_; }
  std::uint32_t plan_version() const { return plan_version_; }
  ReactorCounts counts() const;
  const goals::GoalSet& goals() const { return goals_; }
  bool follows_engine() const;  // that plans all the time
  const PlanReceipt& receipt() const { return receipt_; }
  // "achieved": every hard goal, and there was one (a console's goals that were rejected do not count:
  // whoever sent them was told); "partial": some hard goal was not, robot safe; "failed": robot not safe;
  // empty while open.
  std::string outcome() const;

 private:
  void take_goals(temporal::Time now, const std::vector<goals::GoalRequest>& requests);
  void take_peers(const ReactorInputs& inputs);
  void assume_unobserved(const goals::GoalRequest& goal);
  void note_achieved();
  void advance(temporal::Time now, const ReactorInputs& inputs);
  void resume(temporal::Time now);
  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self);
  void take_models(const std::vector<ModelVersion>& models);
  void monitor_plan(temporal::Time now);
  void check_ahead(temporal::Time now);
  void break_plan(temporal::Time now, const std::string& reason);
  void count_failure(temporal::Time now, const executive::Outcome& outcome);
  void give_up(const std::vector<goals::GoalKey>& goals, const std::string& reason);
  bool count_replan(temporal::Time now);
  void begin_pause(temporal::Time now);
  void continue_pause(temporal::Time now);
  void send_fallbacks();
  void begin_planning(temporal::Time now);
  void call_planner(temporal::Time now, temporal::Time origin, const problem::Forecast& forecast);
  void cancel_stale_call();
  bool is_end_of_cancelled_call(const PlanReply& reply) const;
  bool count_as_stale(const PlanReply& reply);
  bool can_replan_in_background() const;
  void begin_background_replan(temporal::Time now);
  void request_background_plan(temporal::Time now);
  void continue_background_replan(temporal::Time now);
  void keep_plan(temporal::Time now);
  void change_plans(temporal::Time now);
  std::vector<PlannedAction> remaining() const;
  std::string forecast_mismatch(const problem::Forecast& forecast) const;
  bool is_stale(const PlanReply& reply) const;
  void step_continuous(temporal::Time now, const ReactorInputs& inputs);
  void take_delta(temporal::Time now, const temporal::PlanDelta& delta);
  std::string fault_of(temporal::Time now, const temporal::PlanDelta& delta,
                       temporal::FlexiblePlan& next) const;
  void adopt_version(temporal::Time now, temporal::FlexiblePlan plan);
  void note_planned(const temporal::FlexiblePlan& plan);
  void monitor_version(temporal::Time now);
  void forget_ended_plan(temporal::Time now);
  bool takes_plans() const;
  void report_receipt();
  void begin_plan(temporal::Time now, temporal::FlexiblePlan plan);
  void take_answer(temporal::Time now, const PlanReply& reply);
  void adopt(temporal::Time now, const PlanReply& reply);
  // False: no goal has gone, the next call is to leave out the soft ones.
  bool give_way(const PlanReply& reply);
  goals::GoalKey newest_hard() const;
  goals::GoalSet hard_goals() const;
  bool spend_reserves(const std::vector<goals::GoalKey>& leaving, const std::string& reason);
  std::vector<goals::GoalKey> goals_to_blame(const PlanReply& reply) const;
  std::optional<goals::GoalKey> soft_goal_to_leave(const PlanReply& reply) const;
  std::vector<goals::GoalKey> named_goals(const std::string& reason) const;
  void try_again_later(temporal::Time now, const PlanReply& reply);
  void run_executive(temporal::Time now, const ReactorInputs& inputs);
  void forward(executive::Outputs done);
  void make_safe(temporal::Time now, const std::string& reason);
  void finish_if_done();
  void want_plan(const std::string& reason);
  void change_goal(const goals::GoalKey& key, goals::GoalState state, const std::string& reason);
  void wake_at(temporal::Time time);
  void report(Severity level, std::string code, std::string text);
  void report_windows();
  std::vector<executive::Observation> changed_conditions();

  // A planner call during which what runs goes on.
  struct BackgroundReplan {
    problem::Forecast forecast;  // of the state that the running activities leave
    std::optional<PlanReply> reply;
    std::optional<temporal::Time> observed_by;  // for that state to be observed
  };

  const mission::MissionModel* mission_;
  beliefs::Beliefs beliefs_;
  goals::GoalSet goals_;
  executive::Executive executive_;
  RecoveryPolicy recovery_policy_;
  FailureBackoff failure_backoff_;
  ResourceMonitor resource_monitor_;  // of the running plan
  ConflictMonitor conflict_monitor_;  // of the running plan
  ReactorOutputs out_;

  MissionPhase phase_ = MissionPhase::idle;
  bool replan_wanted_ = false;  // a plan is wanted, for the reason below
  std::string replan_reason_;
  bool first_plan_ = true;
  std::uint32_t plan_version_ = 0;
  std::uint64_t call_id_ = 0;
  PlanRequest call_;
  bool call_open_ = false;       // made, not answered: there is never more than one
  bool call_cancelled_ = false;  // the one made last
  std::optional<BackgroundReplan> background_replan_;
  bool plan_invalid_ = false;           // the running plan must not go on
  std::vector<PlannedAction> planned_;  // of the last plan; after a restart what remained of it
  ReactorCounts counts_;
  std::map<std::string, std::uint64_t> models_;  // newest version by owner
  bool models_changed_ = false;                  // since the call
  std::uint32_t stale_calls_ = 0;                // in a row

  PlanReceipt receipt_;
  std::optional<PlanReceipt> reported_receipt_;
  temporal::Time repair_deadline_{0};  // a plan that broke, by another version
  std::vector<std::string> ended_;     // activities of the engine's plan that ended last, sorted

  temporal::Time pause_deadline_{0};
  std::uint32_t fallback_round_ = 0;
  bool fallbacks_sent_ = false;
  std::uint32_t failed_calls_ = 0;
  std::string
      soft_goals_left_out_;  // why soft goals are left out of the call under way; empty: they are in it
  problem::Reserves reserves_ = problem::Reserves::kept;   // spent: for hard goals, until one fails or comes
  temporal::Time next_call_at_{0};                         // next planner call
  std::map<std::string, temporal::Time> reported_starts_;  // earliest starts last reported
  std::map<std::string, temporal::Value>
      condition_values_;  // timelines of the plan's conditions, as last told to the executive
};

}  // namespace roci::exec::reactor
