// These types say what a timeline is, and what a task does to timelines and asks of them (MEXEC, section IV.A,
// R67, R71, R72).
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"

namespace roci::temporal::timelines {

/// Says how a timeline's values change (R71).
enum class Kind {
  atomic,           ///< 0 or 1: used by one task at a time, by a delta of 1 `during` it
  state,            ///< one of named states, assigned
  claimable,        ///< a share is taken `during` a task and given back, as power is
  cumulative,       ///< goes up and down by amounts, as stored bytes do
  cumulative_rate,  ///< moreover runs up or down at a rate, as a battery's energy does
};

/// Defines one timeline. Values are numbers in the timeline's unit; a state is its index in `states`.
struct Definition {
  std::string name;
  Kind kind = Kind::cumulative;
  std::vector<std::string> states{};  ///< of kind state: its range
  double initial = 0;
  double lowest = -std::numeric_limits<double>::infinity();  ///< range of possible values, bounds included
  double highest = std::numeric_limits<double>::infinity();
  bool reported = true;  ///< by the spacecraft; otherwise an internal state, which only tasks change (R73)
  /// Returns whether its value follows from the tasks that run, and from nothing else.
  bool is_claim() const { return !reported && (kind == Kind::atomic || kind == Kind::claimable); }
  /// Returns whether its value is what tasks have left it at, so that somebody must remember it.
  bool is_remembered() const { return !reported && !is_claim(); }
  friend bool operator==(const Definition&, const Definition&) = default;
};

/// Numbers a timeline by its place in the list of definitions.
using Index = std::uint32_t;

/// Says what a task does to a timeline (R72). A delta `during` the task is taken back at its end; a rate `during` it
/// runs from its start to its end, one at its start or end runs on. An assignment holds until the next.
struct Impact {
  Index timeline = 0;
  ImpactKind kind = ImpactKind::delta;
  ImpactWhen moment = ImpactWhen::at_start;
  double amount = 0;  ///< of a rate: per second
  friend bool operator==(const Impact&, const Impact&) = default;
};

/// Says when a constraint is to hold (R67).
enum class Phase {
  pre,          ///< at the start: after what ends there, before what starts there
  maintenance,  ///< from after the start to before the end
  post,         ///< at the end: after what ends there, before what starts there
};

/// Asks that a timeline's value lies within bounds, both included; of a state, that its bit is set in `states`.
struct Constraint {
  Index timeline = 0;
  Phase phase = Phase::pre;
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  std::uint64_t states = 0;  ///< of kind state: bit i permits state i
  /// Returns whether the constraint holds with a value, which of a state is its number.
  bool admits(double value) const {
    if (states == 0) return value >= lowest && value <= highest;
    return value >= 0 && value < 64 && (states >> static_cast<unsigned>(value) & 1U) != 0;
  }
  friend bool operator==(const Constraint&, const Constraint&) = default;
};

/// Holds all of a task that timelines see.
struct Footprint {
  Duration duration{0};
  std::vector<Impact> impacts{};
  std::vector<Constraint> constraints{};
  friend bool operator==(const Footprint&, const Footprint&) = default;
};

}  // namespace roci::temporal::timelines
