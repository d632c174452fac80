// Crash points let exec_svc die on request, as by kill -9: ROCI_CRASH=POINT:N,POINT:N,… kills its first
// incarnation when that passes the point for the Nth time, its second one likewise, and so on. They serve
// tests and bench/kill; without the variable nothing happens.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace roci::exec::journal {

/// Names the points, in the order of one turn.
inline constexpr std::array<std::string_view, 11> kCrashPoints{
    "after-goal",       ///< a goal came in
    "after-hand-over",  ///< the other one of a pair handed over a goal (exec_svc/standby), nothing is decided
    "after-order",      ///< an order came in, nothing is decided
    "after-ack",        ///< the owner answered a command: it has been carried out, or is
    "after-answer",     ///< the planner answered
    "before-write-ahead",  ///< all inputs of a turn are there, nothing is journaled
    "after-write-ahead",   ///< inputs and decisions are durable, nothing was sent
    "after-copy",          ///< the follower has them too (exec_svc/standby), nothing was sent
    "during-send",         ///< between two samples sent
    "after-question",      ///< a decision was asked for, nobody has answered it
    "after-send",          ///< everything was sent, no effect seen
};

/// Counts how often a point is passed, and ends the process at the one that the setting names.
class CrashPoints {
 public:
  /// Takes a `setting` as above, or an empty one; `incarnation` counts from 1. Throws std::invalid_argument,
  /// which lists the points. `die` must not return.
  CrashPoints(std::string_view setting, std::uint32_t incarnation, std::function<void()> die);

  void pass(std::string_view point);

 private:
  std::string point_;
  std::uint64_t left_ = 0;
  std::function<void()> die_;
};

}  // namespace roci::exec::journal
