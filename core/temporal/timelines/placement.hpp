// At which starts a task would break bounds on one timeline (R75), exactly: what the task does to the value at any place is, between few
// starts at which it changes its form, a straight function of the start, so that bad starts are unions of intervals.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/temporal/timelines/line.hpp"

namespace roci::temporal::timelines {

/// Is a closed interval of times in microseconds.
struct Stretch {
  Micros first = 0;
  Micros last = 0;
};

/// Is all that a task does to one timeline. Without a duration everything acts at the start, and `end` is empty.
struct Effect {
  struct Step {
    std::optional<Exact> assign{};
    Exact delta = 0;
    Exact rate = 0;
  };
  Micros duration = 0;
  Step start{};
  Step end{};
  bool none() const;
};
Effect effect_on(Index timeline, const Footprint& footprint);
Bounds bounds_of(const Constraint& constraint);

/// Appends to `bad` the starts within `window` at which the task would break bounds of the timeline's range or of other tasks where they
/// hold without it, or one of its own constraints (`own`: those on this timeline).
void find_bad_starts(const Line& line, const Effect& effect, std::span<const Constraint* const> own,
                     Stretch window, std::vector<Stretch>& bad);

/// Returns the parts of the stretch from `first` to `last`, in order, in which a value that runs straight from `at_first` with `rate` is
/// outside of the bounds.
struct Outside {
  std::array<Stretch, 2> parts{};
  std::size_t count = 0;
};
Outside outside(const Bounds& bounds, Exact at_first, Exact rate, Stretch stretch);

}  // namespace roci::temporal::timelines
