// The timeline library (MEXEC, section IV.A.2, R71–R76, R82): projects impacts of placed tasks into the future, finds conflicts, and
// says when a task can be placed without one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/timelines/definition.hpp"

namespace roci::temporal::timelines {

/// Is a task's number, chosen by the caller.
using TaskId = std::uint64_t;

/// Says which of the values at one instant is meant: tasks that end there act before those that start there.
enum class Side { before, between, after };

/// Is a stretch of time in which a value is out of range or breaks a constraint (R74).
struct Conflict {
  Index timeline = 0;
  std::optional<TaskId> task{};  ///< whose constraint is broken; none: the value leaves the timeline's range
  std::size_t constraint = 0;    ///< index in that task's footprint
  Time from{0};
  Time to{0};
  friend bool operator==(const Conflict&, const Conflict&) = default;
};

/// Is a closed interval of start times (R75).
struct Interval {
  Time earliest{0};
  Time latest{0};
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// Holds the timelines of one plan. The same calls in any order of placements give the same values: at one instant ends act before
/// starts, assignments before deltas before rates, and among equals the smaller task id first.
class Timelines {
 public:
  /// Takes each timeline at its initial value from time `origin` on. Throws std::invalid_argument for an initial value out of range.
  explicit Timelines(std::vector<Definition> definitions, Time origin = Time{0});

  const std::vector<Definition>& definitions() const;

  /// Places a task whether or not conflicts follow. Throws std::invalid_argument for an id that is placed or a timeline that is not
  /// there.
  void place(TaskId task, const Footprint& footprint, Time start);
  /// Moves a placed task to the times that it really has (R76); `end` may be later or earlier than planned.
  void move(TaskId task, Time start, Time end);
  void remove(TaskId task);

  /// Anchors a timeline on an observed value: impacts up to `sampled` no longer count, rates of tasks that run then go on (R76).
  void observe(Index timeline, Time sampled, double value);
  /// Folds everything before `now` into one value for each timeline and forgets tasks that ended before (R82).
  void consolidate(Time now);

  /// Returns the projected value. O(log n) in the impacts on the timeline.
  double value(Index timeline, Time at, Side side = Side::after) const;
  /// Returns all conflicts that touch [from, to], by timeline and time.
  std::vector<Conflict> conflicts(Time from, Time to) const;

  /// Returns the start times within `window` at which the task causes no conflict that is not there without it, neither of its own
  /// constraints nor of other tasks' nor of a range; sorted, disjoint, exact to a microsecond.
  std::vector<Interval> valid_starts(const Footprint& footprint, Interval window) const;
  /// Returns the first of them, which is cheaper than all.
  std::optional<Time> first_valid_start(const Footprint& footprint, Interval window) const;

  /// Marks a state to which undo() goes back: a search places and takes back many tasks. Marks nest.
  std::size_t mark() const;
  /// Takes back every place, move and remove since the mark. What is not a placement (observe, consolidate) must not lie between.
  void undo(std::size_t mark);
};

}  // namespace roci::temporal::timelines
