// This file says what a task does to one timeline, and where a straight course leaves bounds.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/temporal/timelines/event.hpp"

namespace roci::temporal::timelines {

/// Holds all that a task does to one timeline. Without a duration everything acts at the start, and `end` is
/// empty.
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

/// Holds the parts of a stretch, in order, in which a value is out of bounds: at most two, since the value
/// runs straight.
struct Outside {
  std::array<Stretch, 2> parts{};
  std::size_t count = 0;
};
/// Returns the parts of the stretch in which a value that runs straight from `at_first` with `rate` is out of bounds.
Outside outside(const Bounds& bounds, Exact at_first, Exact rate, Stretch stretch);

}  // namespace roci::temporal::timelines
