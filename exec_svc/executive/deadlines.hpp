// Deadlines say until when an activity under way may do what. They are derived from the network as it is
// now; nothing is kept.
#pragma once

#include <vector>

#include "exec_svc/executive/run_state.hpp"

namespace roci::exec::executive {

/// Answers from the network as it is when it is asked.
class Deadlines {
 public:
  /// The state must outlive this object.
  explicit Deadlines(const RunState& state);

  /// Returns the latest end under LatenessPolicy::deadline: the latest next change of the timelines that
  /// begin a token with the activity (R144). It is no_bound under the other policies.
  temporal::Time end(Index activity) const;
  /// Returns whether an attempt that begins now may end in time: under LatenessPolicy::deadline one of the
  /// shortest duration, since no repair moves the times of the plan (R129); under the others always.
  bool leaves_room(Index activity, temporal::Time now) const;
  /// Returns by when a command must have ended to be of use: when it counts as hung, or a microsecond before its
  /// deadline, so that an owner's report of a repair that took too long still leaves time for the activity's
  /// contingency. Its owner is told, and repairs no longer than that (R146).
  temporal::Time latest_end(Index activity) const;
  /// Returns when a command counts as hung. An activity without a longest duration is followed as long as its
  /// owner lives.
  temporal::Time hung_after(Index activity) const;
  /// Returns from when on a completed command counts as a success, if its post condition holds (R86).
  temporal::Time settled_from(Index activity) const;
  /// Returns how long observations may take to follow a start or an end of the activity.
  temporal::Duration settle_time(Index activity) const;
  /// Returns when the activity, which runs no contingency, is to be looked at next.
  temporal::Time next_timer(Index activity, temporal::Time now) const;

 private:
  const RunState* state_;
  std::vector<std::vector<std::size_t>> tokens_from_;  ///< lists by activity the tokens that begin with it
};

}  // namespace roci::exec::executive
