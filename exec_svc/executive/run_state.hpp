// The run state is what all parts of a plan's run share: the plan, its network, how far its activities have
// come, and what is said and asked for. Each part owns what else it needs.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "exec_svc/executive/activity_run.hpp"
#include "exec_svc/executive/executive.hpp"
#include "exec_svc/executive/messages.hpp"
#include "exec_svc/executive/point_dispatcher.hpp"
#include "exec_svc/executive/timeline_store.hpp"

namespace roci::exec::executive {

using Index = std::size_t;  ///< counts activities in plan order

/// Refers to one command of an activity's sequence in the plan; an empty owner says that there is no command.
struct CommandOf {
  const std::string& owner;
  const std::string& robot;
  const std::string& subsystem;
  const std::string& command_name;
  const std::vector<temporal::Property>& arguments;
  temporal::Duration answer_within;  ///< from sending it to its first answer, the way over a link included
  bool last;                         ///< of the sequence
};

/// Holds the state that the parts of one run share; they know it by its address.
struct RunState {
  /// The plan has passed check(); settings, permissions and store outlive the run.
  RunState(temporal::FlexiblePlan flexible_plan, const ExecutiveSettings& executive_settings,
           const Permissions& permitted, TimelineStore& timelines, std::uint64_t current_epoch);
  RunState(const RunState&) = delete;  // parts know it by address
  RunState& operator=(const RunState&) = delete;

  temporal::FlexiblePlan plan;
  const ExecutiveSettings& settings;
  const Permissions& permissions;  ///< of the ground, as they are now
  TimelineStore& store;
  std::uint64_t epoch;  ///< executive's epoch: keys that it issues carry it for good
  PointDispatcher points;
  std::vector<ActivityRun> runs;
  std::unordered_map<std::string, Index> index_of;
  std::unordered_map<Index, std::vector<temporal::Property>> bound;  ///< arguments that decisions have bound
  std::set<Index> active;                                            ///< started and not ended
  std::size_t unfinished;                                            ///< activities that are not done
  Index first_waiting = 0;                                           ///< none before it waits any more
  Outcome outcome;
  Outputs outputs;  ///< since they were taken last

  /// Returns whether activities may start and fail; else what runs is only followed to its end.
  bool starting() const { return outcome.kind == OutcomeKind::running; }
  temporal::Lookup lookup() const;
  /// Returns the lookup as a running activity will find it when it is tried again: what it has taken is given
  /// back.
  temporal::Lookup lookup_to_retry(Index activity) const;
  StepStatus status(Index activity) const;

  /// Returns the arguments `planned` of a command of the activity with those that decisions have bound: in
  /// each command that has an argument of that name, else in the first one.
  std::vector<temporal::Property> with_bound(Index activity, std::vector<temporal::Property> planned) const;

  /// Changes the activity's public state, and reports every change.
  void change(Index activity, temporal::ActivityState state, std::string reason);
  /// Changes the activity's phase, which is the run's own.
  void enter(Index activity, ActivityPhase phase, temporal::Time now);
  void send(Index activity, CommandAction action);
  /// Returns the command of the activity's sequence that is under way, or comes first.
  CommandOf command(Index activity) const;
  /// Returns the points that may happen now: starts of higher priority first, then in order of index.
  std::vector<temporal::TimePoint> ready_points() const;
  /// Ends the activity, with its impacts on timelines that nobody observes.
  void close(Index activity, temporal::Time now, temporal::ActivityState state, const std::string& reason);
  /// Takes the activity out, as it will not start; its neighbours keep their order.
  void skip(Index activity, const std::string& reason);
  void report_recovery(RecoveryAction action, Index activity, std::string reason);
  /// Breaks the plan; the first reason stands.
  void break_plan(Breakage breakage, const std::string& who, const std::string& reason,
                  const std::string& contingency);
  void update_outcome();

 private:
  std::optional<temporal::Value> progress_named(const std::string& timeline) const;
};

}  // namespace roci::exec::executive
