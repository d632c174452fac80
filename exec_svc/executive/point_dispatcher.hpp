// The point dispatcher decides which time points of a plan may happen now, by the plan's network alone.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "core/temporal/execution_windows.hpp"
#include "exec_svc/executive/agenda.hpp"
#include "exec_svc/executive/precedence.hpp"

namespace roci::exec::executive {

/// Keeps for each time point what it still waits for; an event costs what it moves.
class PointDispatcher {
 public:
  /// Takes a plan that has passed check(). A start with a preferred time is due at that, or as near to it as
  /// the window allows (R67); with latest_starts, every other one at the end of its window, where that has one
  /// (R144). With only_committed, what is not committed never starts, and is never late (R78).
  explicit PointDispatcher(const temporal::FlexiblePlan& plan, bool latest_starts = false,
                           bool only_committed = false);

  temporal::Window window(temporal::TimePoint point) const { return windows_.window(point); }
  /// Makes window() cheap for every point.
  void settle() const { windows_.settle(); }
  /// Returns what the windows have cost so far, as of temporal::LazyShortestPaths.
  std::uint64_t work() const { return windows_.work(); }
  const PointOwner& owner(temporal::TimePoint point) const { return owners_[point]; }
  /// Returns the bounds of the duration as planned.
  temporal::Window duration(std::size_t activity) const {
    return {constraints_[activity].lower, constraints_[activity].upper};
  }
  const Precedence& precedence() const { return precedence_; }
  std::optional<temporal::Time> happened_at(temporal::TimePoint point) const;
  bool dropped(temporal::TimePoint point) const { return points_[point].dropped; }

  /// Makes a point wait for something outside the network; each hold() needs one release().
  void hold(temporal::TimePoint point);
  void release(temporal::TimePoint point);
  /// only_held() returns whether the predecessors have happened: only holds, if any, are in its way then.
  bool held(temporal::TimePoint point) const { return points_[point].holds > 0; }
  bool only_held(temporal::TimePoint point) const { return points_[point].pending == points_[point].holds; }

  /// Returns points whose predecessors have all begun (an end has begun when its activity has started) and
  /// which have become due since the last call. They may still wait for predecessors to end.
  std::vector<temporal::TimePoint> advance(temporal::Time now);
  bool due(temporal::TimePoint point) const { return points_[point].due; }

  /// Returns the points other than observed ends that wait for nothing any more, in order of index.
  const std::set<temporal::TimePoint>& ready() const { return ready_; }

  /// Lets a ready point happen. Returns false if some other point had to come before it by constraints that
  /// lead around several points: it then waits for that one. (So dispatch is exact on networks that are not
  /// minimal.)
  bool try_happen(temporal::TimePoint point, temporal::Time now);
  /// Takes in an event that nobody can refuse.
  void happen(temporal::TimePoint point, temporal::Time at);
  /// Takes a point out that will never happen. What waited for it waits for its predecessors instead.
  void drop(temporal::TimePoint point);
  /// Sets new duration bounds of a started activity.
  void set_duration(std::size_t activity, temporal::Duration lower, temporal::Duration upper);

  /// Returns the earliest start that has to happen before its latest time, which lies before now. (A start
  /// whose time has passed has a predecessor whose time has passed, so those next to the front suffice.)
  std::optional<temporal::TimePoint> late_start(temporal::Time now);
  /// Returns when, after now, advance() or late_start() will next have something new, or no_bound.
  temporal::Time next_time(temporal::Time now);

 private:
  struct PointState {
    std::optional<temporal::Time> happened;
    std::uint32_t pending = 0;  ///< predecessors that have not happened, and holds
    std::uint32_t holds = 0;
    std::uint32_t unbegun = 0;    ///< predecessors that have not begun
    std::uint32_t unreached = 0;  ///< predecessors that would be late before it
    bool begun = false;
    bool reached_on = false;  ///< its successors count it no more
    bool due = false;
    bool dropped = false;
    bool passed = false;                            ///< successors have been told
    bool may_be_late = false;                       ///< its latest time does not matter
    temporal::Time preferred = temporal::no_bound;  ///< mission time; of starts alone
  };

  bool open(temporal::TimePoint point) const { return !points_[point].happened && !points_[point].dropped; }
  bool commanded(temporal::TimePoint point) const { return owners_[point].role != PointRole::observed_end; }
  void enter_times(temporal::TimePoint point);
  void note_changes();
  void take_back(temporal::TimePoint point);
  temporal::Time due_time(temporal::TimePoint point) const;
  /// Returns whether the point is due later than it may happen, and not after its latest time.
  bool waits(temporal::TimePoint point) const;
  bool near(temporal::TimePoint point) const { return points_[point].unbegun == 0; }
  bool watched(temporal::TimePoint point) const;
  void begin(temporal::TimePoint point);
  void reach(temporal::TimePoint point);
  void satisfied(temporal::TimePoint point);
  void pass(temporal::TimePoint point);
  std::optional<Agenda::Entry> first_earliest();
  std::optional<Agenda::Entry> first_latest();

  bool latest_starts_;
  std::vector<PointOwner> owners_;
  std::vector<temporal::TemporalConstraint> constraints_;
  Precedence precedence_;
  temporal::ExecutionWindows windows_;
  std::vector<PointState> points_;
  std::vector<temporal::TimePoint> ends_;  ///< are indexed by activity
  std::set<temporal::TimePoint> ready_;
  Agenda earliest_, latest_;
};

}  // namespace roci::exec::executive
