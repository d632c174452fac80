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

/// Is one command of an activity's sequence; it refers to the plan. Without an owner there is none.
struct CommandOf {
  const std::string& owner;
  const std::string& robot;
  const std::string& subsystem;
  const std::string& command_name;
  const std::vector<temporal::Property>& arguments;
  temporal::Duration answer_within;  ///< runs from sending it to its first answer
  bool last;                         ///< says whether it ends the sequence
};

/// Is shared by the parts of one run, which know it by its address.
struct RunState {
  /// Takes a plan that has passed check(); settings and store outlive the run.
  RunState(temporal::FlexiblePlan flexible_plan, const ExecutiveSettings& executive_settings,
           TimelineStore& timelines, std::uint64_t current_epoch);
  RunState(const RunState&) = delete;  // parts know it by address
  RunState& operator=(const RunState&) = delete;

  temporal::FlexiblePlan plan;
  const ExecutiveSettings& settings;
  TimelineStore& store;
  std::uint64_t epoch;  ///< is the executive's: keys that it issues carry it for good
  PointDispatcher points;
  std::vector<ActivityRun> runs;
  std::unordered_map<std::string, Index> index_of;
  std::set<Index> active;   ///< started and not ended
  std::size_t unfinished;   ///< activities that are not done
  Index first_waiting = 0;  ///< none before it waits any more
  Outcome outcome;
  Outputs outputs;  ///< since they were taken last

  /// Returns whether activities may start and fail; else what runs is only followed to its end.
  bool starting() const { return outcome.kind == OutcomeKind::running; }
  temporal::Lookup lookup() const;
  StepStatus status(Index activity) const;

  /// Changes the activity's state as everybody sees it. Every change is told.
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
};

}  // namespace roci::exec::executive
