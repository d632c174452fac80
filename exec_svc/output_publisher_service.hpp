// The output publisher sends what leaves an executive: commands, plans, statuses and events, in one order and
// with its epoch.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "exec_svc/journal/crash_points.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/reactor/reactor.hpp"
#include "services/node.hpp"
#include "services/publisher.hpp"
#include "services/topics/topics.hpp"

namespace roci::exec {

/// Publishes what a step has decided, and holds commands back where they may not go out yet.
class OutputPublisher {
 public:
  /// Passes the point `during-send` of `crash` after each sample of a step.
  OutputPublisher(services::Node&, const mission::MissionModel&, std::uint64_t epoch,
                  journal::CrashPoints& crash);

  /// Says who holds what is acknowledged from now on.
  void acknowledge_as(goals::AckStage stage) { ack_stage_ = stage; }
  /// Lets commands that begin something wait while `may_command` returns false; cancels and queries do not wait. A
  /// command that is cancelled meanwhile, or whose owner is lost, is not sent at all.
  void let_commands_wait(std::function<bool()> may_command) { may_command_ = std::move(may_command); }
  /// Sends what waits, if it may go now.
  void send_waiting();

  /// Publish goals, plan and steps as they stand, for late joiners after a restart.
  void send_goals(const reactor::Reactor&) const;
  void send_plan(const reactor::Reactor&);
  /// Sends what a step decided, but for its planner call. `actions` is what the planner wrote for the plan
  /// that the step adopts.
  void send(const reactor::ReactorOutputs&, std::uint32_t plan_version,
            const std::vector<reactor::PlannedAction>& actions);
  void report(const reactor::Event&) const;
  /// Sends the status unless it equals the last one. Returns whether it was sent.
  bool publish(v1::MissionStatus, const std::string& trace_sha256);

  /// Lets commands go out in this epoch from now on.
  void begin_epoch(std::uint64_t epoch) { epoch_ = epoch; }
  /// Announces this epoch to all owners, so that they refuse what an earlier leader may still send. Does nothing
  /// until somebody hears commands, and for an owner that was told. (The simulated clock drops an earlier leader.)
  void announce_epoch();
  /// Notes that an owner that was started anew may know no epoch, and is to be told again.
  void forget_told(const std::string& owner) { told_epoch_.erase(owner); }
  /// Publishes a plan that has ended; a late joiner gets the newest ones.
  void tell(const reactor::ExecutedPlan& executed);
  void end_steps_outside(const temporal::FlexiblePlan& plan);
  /// Drops what waits for a lost owner: the executive has closed what it commanded there.
  void lose_owner(const std::string& owner);
  /// Raises the epoch of the owner, which holds `held`, in bounded steps up to this one: it takes no wider
  /// step (services/owner/command.hpp). Returns false if the way is too long.
  bool climb(const std::string& owner, std::uint64_t held);
  /// Returns whether the acknowledgement answers announce_epoch() or climb().
  static bool answers_epoch(const v1::CommandAck&);
  /// Returns whether it answers one of the commands that went out last.
  bool answers_command(const v1::CommandAck&) const;

 private:
  void sent(bool) const { crash_->pass("during-send"); }

  bool tell(const goals::GoalRecord&) const;
  void send(v1::Command);
  void withdraw_what_is_cancelled(const std::vector<executive::Command>&);
  void lead(const std::string& owner, std::uint64_t epoch) const;
  v1::Plan plan_sample(const temporal::FlexiblePlan&, const std::vector<reactor::PlannedAction>&) const;

  const mission::MissionModel* mission_;
  std::string executive_;  // logical name
  std::uint64_t epoch_;
  journal::CrashPoints* crash_;
  std::set<std::string> told_epoch_;  // owners
  /// Holds the keys of the newest commands: epoch of issue, activity, attempt.
  std::deque<std::tuple<std::uint64_t, std::string, std::uint32_t>> sent_keys_;
  goals::AckStage ack_stage_ = goals::AckStage::journaled;
  std::function<bool()> may_command_;
  std::deque<v1::Command> waiting_;
  v1::MissionStatus last_status_;
  services::Publisher<v1::Command> commands_;
  services::Publisher<v1::GoalStatus> goal_statuses_;
  services::Publisher<v1::Plan> plans_;
  services::Publisher<v1::ExecutedPlan> executed_;
  std::set<std::string> told_steps_;            // activities that may still be in the plan
  std::deque<v1::ExecutedPlan> told_executed_;  // keys of those that a late joiner gets
  services::Publisher<v1::StepStatus> steps_;
  services::Publisher<v1::MissionStatus> missions_;
  services::Publisher<v1::Event> events_;
};

}  // namespace roci::exec
