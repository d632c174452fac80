/// The open choices of sufficient plans (R131): asked for when the information may exist, bound by the answer
/// of their resolver.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "exec_svc/executive/run_state.hpp"
#include "exec_svc/executive/start_waits.hpp"

namespace roci::exec::executive {

class DecisionPoints {
 public:
  /// Holds the starts of all activities among which is to be chosen. Both outlive this.
  DecisionPoints(RunState& state, StartWaits& waits);

  /// Binds a choice: the activities of the others are skipped. False: it is not asked for, has no such
  /// choice, or the answer is late.
  bool take_answer(const DecisionAnswer& answer, temporal::Time now);
  /// Asks as soon as every predecessor of some activity of the choices has happened; an answer that is
  /// missing at its time breaks the plan. True: something was asked.
  bool ask(temporal::Time now);
  /// When, after now, an answer that was asked for will be missing; no bound: never.
  temporal::Time next_timer(temporal::Time now) const;

 private:
  temporal::Time answer_before(std::size_t decision) const;

  RunState* state_;
  StartWaits* waits_;
  std::set<std::size_t> open_;                              ///< decisions not taken, in plan order
  std::vector<std::optional<temporal::Time>> asked_at_;     ///< by decision
  std::vector<std::vector<temporal::TimePoint>> held_by_;   ///< by decision
  std::vector<std::vector<temporal::TimePoint>> asked_by_;  ///< of these, those that make it be asked for
};

}  // namespace roci::exec::executive
