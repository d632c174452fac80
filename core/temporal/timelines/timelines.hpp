// The timeline library (MEXEC, section IV.A.2, R71–R76, R82) projects impacts of placed tasks into the future, finds
// conflicts, and says when a task can be placed without one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/timelines/definition.hpp"
#include "core/temporal/timelines/line.hpp"
#include "core/temporal/timelines/start_search.hpp"

namespace roci::temporal::timelines {

/// Describes a stretch of time in which a value is out of range or breaks a constraint (R74). Times are whole
/// microseconds: each in the stretch has a side on which the value is wrong.
struct Conflict {
  Index timeline = 0;
  std::optional<TaskId> task{};  ///< whose constraint is broken; none: the value leaves the timeline's range
  std::size_t constraint = 0;    ///< index in that task's footprint
  Time from{0};
  Time to{0};
  friend bool operator==(const Conflict&, const Conflict&) = default;
};

/// Holds a closed interval of start times (R75).
struct Interval {
  Time earliest{0};
  Time latest{0};
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// Holds a corner of a timeline's course (figure 7). Between two corners the value runs straight; where it
/// jumps, two have the same time.
struct Vertex {
  Time time{0};
  double value = 0;
  bool observed = false;  ///< the value was reported
  friend bool operator==(const Vertex&, const Vertex&) = default;
};

/// Bounds what is kept (R82).
struct Extent {
  Time origin{0};        ///< timelines have their initial values from here on
  Time end = kLastTime;  ///< nothing is looked at behind it, and no task is placed beyond
  std::size_t most_impacts = std::size_t{1} << 20;  ///< of all placed tasks together, constraints counted too
  /// Sizes blocks in changes: larger blocks make changes dearer, and questions over all of time cheaper.
  std::size_t block = 64;
};

/// Says how much is kept.
struct Kept {
  std::size_t tasks = 0;
  std::size_t events = 0;    ///< starts and ends of impacts, and observations
  std::size_t asks = 0;      ///< constraints
  std::size_t undoable = 0;  ///< changes that undo() could take back
  friend bool operator==(const Kept&, const Kept&) = default;
};

/// Holds the timelines of one plan; a copy stands for itself. The same calls in any order of placements give the same
/// values: at one instant ends act before starts, assignments before deltas before rates, and among equals the smaller
/// task id first. A task without a duration acts wholly among the starts: its constraints of phase post are asked
/// behind them, those of maintenance never. Numbers count to a billionth, and all sums are exact (exact.hpp). What lies
/// before the consolidated past counts as at its edge. Observations and consolidation forget all marks, and so keep the
/// memory for undo() bounded.
class Timelines {
 public:
  /// Takes each timeline at its initial value from time `origin` on. Throws std::invalid_argument with the sentences of
  /// check() for definitions with faults, as an initial value out of range.
  explicit Timelines(std::vector<Definition> definitions, Time origin = Time{0});
  Timelines(std::vector<Definition> definitions, const Extent& extent);

  const std::vector<Definition>& definitions() const { return definitions_; }
  /// Returns the time up to which everything is consolidated; the origin at first.
  Time past() const { return Time{past_}; }
  Kept kept() const;

  /// Places a task whether or not conflicts follow. Throws std::invalid_argument for an id that is placed, for what
  /// check() finds in the footprint, and for an end beyond that of the timelines; std::length_error for more impacts
  /// than the extent permits.
  void place(TaskId task, const Footprint& footprint, Time start);
  bool placed(TaskId task) const { return tasks_.contains(task); }
  /// Moves a placed task to the times that it really has (R76); `end` may be later or earlier than planned. A start
  /// that is consolidated stays. Throws std::invalid_argument for a task that is not placed and for
  /// an end before the start.
  void move(TaskId task, Time start, Time end);
  /// Takes a task away as if it had never been placed. Of one whose start is consolidated stays what it did there at
  /// its start, while what it does `during` itself ends at the edge of the past; to end a task early, move it. Throws
  /// std::invalid_argument for a task that is not placed.
  void remove(TaskId task);

  /// Anchors a timeline on an observed value: impacts up to `sampled` no longer count, rates of tasks that run then go
  /// on (R76). A value out of range is a conflict and no error. Returns whether it counts: what was sampled before the
  /// consolidated past does not. Throws std::invalid_argument for a timeline that is not there, for a value that is no
  /// number of at most 1e15 or no state, and for a time beyond the end.
  bool observe(Index timeline, Time sampled, double value);
  /// Folds everything before `now` into one value for each timeline and forgets tasks that ended before (R82). O(n) in
  /// what is kept. An earlier `now` than past() changes nothing.
  void consolidate(Time now);

  /// Returns the projected value; before past() the one that the past has left.
  /// Throws std::out_of_range for a timeline that is not there.
  double value(Index timeline, Time at, Side side = Side::after) const;
  /// Returns all conflicts that touch [from, to], by timeline and time.
  std::vector<Conflict> conflicts(Time from, Time to) const;
  /// Returns the course of a timeline between two times, both included (figure 7).
  std::vector<Vertex> trajectory(Index timeline, Time from, Time to) const;

  /// Returns the start times within `window` at which the task causes no conflict that is not there without it, neither
  /// of its own constraints nor of other tasks' nor of a range; sorted, disjoint, exact to a microsecond. That is: no
  /// microsecond and side at which bounds that hold without it are broken with it. The task lies between past() and the
  /// end of the timelines, and counts as the one with the greatest id.
  /// Throws std::invalid_argument for what check() finds in the footprint.
  std::vector<Interval> valid_starts(const Footprint& footprint, Interval window) const;
  /// Returns the first of them, which is cheaper than all.
  std::optional<Time> first_valid_start(const Footprint& footprint, Interval window) const;

  /// Marks a state to which undo() goes back: a search places and takes back many tasks. Marks nest.
  std::size_t mark() const { return forgotten_ + log_.size(); }
  /// Takes back every place, move and remove since the mark, exactly. Throws std::logic_error when an observation or a
  /// consolidation lies between.
  void undo(std::size_t mark);

 private:
  struct Task {
    Footprint footprint{};
    Micros start = 0;
    Micros end = 0;
    bool started = false;  ///< before the past, with what it does at its start
    std::size_t size() const { return footprint.impacts.size() + footprint.constraints.size(); }
  };
  struct Change {
    enum class Kind { placed, moved, removed } kind = Kind::placed;
    TaskId id = 0;
    Task before{};  ///< of a move: times alone
  };

  void put(TaskId id, const Task& task);
  void take(TaskId id, const Task& task);
  void amend_for_removed(const Task& task, int sign);
  template <class Do>
  void each_event(TaskId id, const Task& task, Do change) const;
  template <class Do>
  void each_ask(TaskId id, const Task& task, Do change) const;
  Stretch possible_starts(const Footprint& footprint, Interval window) const;
  void forget_log();
  Task& find(TaskId id);

  std::vector<Definition> definitions_;
  std::vector<Line> lines_;
  Micros past_;
  Micros end_;
  std::size_t most_impacts_;
  std::size_t impacts_ = 0;
  std::unordered_map<TaskId, Task> tasks_;
  std::vector<Change> log_;
  std::size_t forgotten_ = 0;
  mutable Scratch scratch_;
};

}  // namespace roci::temporal::timelines
