/// What leaves an executive: commands, plans, statuses and events, in one order and with its epoch.
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

class OutputPublisher {
 public:
  /// `crash`: passes `during-send` after each sample of a step.
  OutputPublisher(services::Node&, const mission::MissionModel&, std::uint64_t epoch,
                  journal::CrashPoints& crash);

  /// Who holds what is acknowledged from now on.
  void acknowledge_as(goals::AckStage stage) { ack_stage_ = stage; }
  /// Commands that begin something wait while this says false; what ends something, and what asks, does not. One that
  /// is cancelled meanwhile, or whose owner is lost, is not sent at all.
  void let_commands_wait(std::function<bool()> may_command) { may_command_ = std::move(may_command); }
  /// Sends what waits, if it may go now.
  void send_waiting();

  /// Goals, plan and steps as they stand, for who joins after a restart.
  void send_goals(const reactor::Reactor&) const;
  void send_plan(const reactor::Reactor&);
  /// What a step decided, but for its planner call.
  /// `actions`: what the planner wrote for the plan that it adopts.
  void send(const reactor::ReactorOutputs&, std::uint32_t plan_version,
            const std::vector<reactor::PlannedAction>& actions);
  void report(const reactor::Event&) const;
  /// True if it is news: a status that equals the last one is not sent again.
  bool publish(v1::MissionStatus, const std::string& trace_sha256);

  /// Commands go out in this epoch from now on.
  void begin_epoch(std::uint64_t epoch) { epoch_ = epoch; }
  /// Leads all owners in this epoch, so that they refuse what an earlier leader may still send. Does nothing until
  /// somebody hears commands, and for an owner that was told. (The simulated clock drops an earlier leader.)
  void announce_epoch();
  /// An owner that was started anew may know no epoch: it is to be told again.
  void forget_told(const std::string& owner) { told_epoch_.erase(owner); }
  /// The executive has closed what it commanded there.
  void tell(const reactor::ExecutedPlan& executed);
  void end_steps_outside(const temporal::FlexiblePlan& plan);
  void lose_owner(const std::string& owner);
  /// Leads the owner, which holds `held`, in later and later epochs up to this one: it takes no wider step
  /// (services/owner/command.hpp). False: the way is too long.
  bool climb(const std::string& owner, std::uint64_t held);
  /// Whether the acknowledgement answers announce_epoch() or climb().
  static bool answers_epoch(const v1::CommandAck&);
  /// Whether it answers one of the commands that went out last.
  bool answers_command(const v1::CommandAck&) const;

 private:
  void sent(bool) const { crash_->pass("during-send"); }

  void send(v1::Command);
  void lead(const std::string& owner, std::uint64_t epoch) const;
  v1::Plan plan_sample(const temporal::FlexiblePlan&, const std::vector<reactor::PlannedAction>&) const;

  const mission::MissionModel* mission_;
  std::string executive_;  // logical name
  std::uint64_t epoch_;
  journal::CrashPoints* crash_;
  std::set<std::string> told_epoch_;  // owners
  /// Keys of the newest commands: epoch of issue, activity, attempt.
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
