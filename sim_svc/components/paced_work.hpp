// Paced work takes its time, and more of it while its component is slowed.
#pragma once

#include "core/temporal/duration.hpp"

namespace roci::sim::components {

/// Says how much of a piece of work is done at any time. A pace below the usual one, until a time, holds for the work
/// under way and for what is started after it.
class PacedWork {
 public:
  /// Starts a piece that takes `work` at the usual pace, in place of the one before.
  void start(temporal::Duration work, temporal::Time now);
  /// Slows work to this share (0 … 1) of the usual pace until then; what is done stays done.
  void slow_down(double pace, temporal::Time until, temporal::Time now);

  /// Returns what the piece takes at the usual pace.
  temporal::Duration work() const { return work_; }
  /// Returns when it will be done, as things stand.
  temporal::Time end() const { return end_; }
  /// Returns how much of work() is done by then.
  temporal::Duration done_by(temporal::Time) const;
  /// Returns the same as a share, 0 … 1; of no work all is done.
  double share_by(temporal::Time) const;

 private:
  temporal::Time end_of() const;

  temporal::Duration work_{};
  temporal::Duration done_{};  // at since_
  temporal::Time since_{};
  temporal::Time end_{};
  double pace_ = 1;
  temporal::Time slow_until_{};
};

}  // namespace roci::sim::components
