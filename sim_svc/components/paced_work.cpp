#include "sim_svc/components/paced_work.hpp"

#include <algorithm>

namespace roci::sim::components {

using temporal::Duration;
using temporal::Time;

void PacedWork::start(Duration work, Time now) {
  work_ = work;
  done_ = {};
  since_ = now;
  end_ = end_of();
}

void PacedWork::slow_down(double pace, Time until, Time now) {
  done_ = done_by(now);
  since_ = now;
  pace_ = pace;
  slow_until_ = until;
  end_ = end_of();
}

Duration PacedWork::done_by(Time now) const {
  const Time slow_end = std::clamp(slow_until_, since_, std::max(since_, now));
  const Duration slow = temporal::seconds(pace_ * temporal::to_seconds(slow_end - since_));
  return std::min(work_, done_ + slow + (std::max(now, slow_end) - slow_end));
}

double PacedWork::share_by(Time now) const {
  if (work_.count() <= 0) return 1;
  return std::clamp(temporal::to_seconds(done_by(now)) / temporal::to_seconds(work_), 0.0, 1.0);
}

Time PacedWork::end_of() const {
  const Duration left = work_ - done_;
  if (since_ >= slow_until_ || left.count() <= 0) return since_ + left;
  const Duration slow = temporal::seconds(pace_ * temporal::to_seconds(slow_until_ - since_));
  if (slow < left) return slow_until_ + (left - slow);
  return since_ + temporal::seconds(temporal::to_seconds(left) / pace_);
}

}  // namespace roci::sim::components
