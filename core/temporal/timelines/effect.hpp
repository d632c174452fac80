// What a task does to one timeline, and where a straight course leaves bounds.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/temporal/timelines/event.hpp"

namespace roci::temporal::timelines {

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

/// Returns the parts of the stretch from `first` to `last`, in order, in which a value that runs straight from
/// `at_first` with `rate` is outside of the bounds.
struct Outside {
  std::array<Stretch, 2> parts{};
  std::size_t count = 0;
};
Outside outside(const Bounds& bounds, Exact at_first, Exact rate, Stretch stretch);

}  // namespace roci::temporal::timelines
