// These types say what happens on a timeline, what is asked of it, and its values at an instant.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

#include "core/temporal/timelines/definition.hpp"
#include "core/temporal/timelines/exact.hpp"

namespace roci::temporal::timelines {

/// Numbers a task; the caller chooses it.
using TaskId = std::uint64_t;

/// Says which of the values at one instant is meant: tasks that end there act before those that start there.
enum class Side { before, between, after };

using Micros = std::int64_t;

/// Holds a closed interval of times in microseconds.
struct Stretch {
  Micros first = 0;
  Micros last = 0;
};

/// Says in what order things act at one instant.
enum class Turn { ends, starts, observed };

/// Holds a change of a timeline at an instant. Within one turn assignments act before deltas, in the order of
/// task and `order`.
struct Event {
  Micros time = 0;
  Turn turn = Turn::ends;
  ImpactKind kind = ImpactKind::delta;
  TaskId task = 0;
  std::uint32_t order = 0;  ///< among the changes of one task
  Exact amount = 0;         ///< of a rate: per microsecond
};

/// Returns the state that a value of a state timeline stands for; any number of 64 and more for other values.
constexpr int state_of(Exact value) {
  // 64 states fit into 64 bits, whose division is a hundred times as fast.
  return value >= 0 && value < 64 * kUnit
             ? static_cast<int>(static_cast<std::int64_t>(value) / static_cast<std::int64_t>(kUnit))
             : 64;
}

/// Says which values are asked for: between two numbers, or one of the states whose bits are set.
struct Bounds {
  Exact lowest = -kBeyond;
  Exact highest = kBeyond;
  std::uint64_t states = 0;
  bool admits(Exact value) const {
    if (states == 0) return lowest <= value && value <= highest;
    const int state = state_of(value);
    return state < 64 && (states >> state & 1) != 0;
  }
};

/// Names a place in the order of time.
struct Position {
  Micros time = 0;
  Side side = Side::before;
  friend auto operator<=>(const Position&, const Position&) = default;
};

/// Asks for bounds over a stretch of a timeline, both ends included.
struct Ask {
  TaskId task = 0;
  std::uint32_t constraint = 0;
  Position from{};
  Position to{};
  Bounds bounds{};
};

/// Marks an assignment or an observation, after which earlier changes no longer count.
struct Reset {
  Micros time = std::numeric_limits<Micros>::min() / 2;
  Turn turn = Turn::ends;
};

/// Holds what a timeline has come to right before an instant.
struct Course {
  Exact value = 0;
  Exact rate = 0;
  Reset reset{};
};

/// Holds the values at an instant at which something happens, or at which an ask begins or ends. Until the next knot
/// the value runs straight.
struct Knot {
  Micros time = 0;
  Exact before = 0;
  Exact ends_assigned = 0;  ///< after the assignments of what ends, before its deltas
  Exact between = 0;
  Exact starts_assigned = 0;  ///< after the assignments of what starts, before its deltas
  Exact after = 0;
  Exact rate = 0;        ///< from here on
  Reset reset_before{};  ///< newest reset that acts on `before`, and so on
  Reset reset_between{};
  Reset reset_after{};

  Exact at(Side side) const {
    return side == Side::before ? before : side == Side::between ? between : after;
  }
  const Reset& reset(Side side) const {
    return side == Side::before ? reset_before : side == Side::between ? reset_between : reset_after;
  }
};

}  // namespace roci::temporal::timelines
