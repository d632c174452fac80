// The clock mode says how a node learns the mission time; these errors say how that can fail.
#pragma once

#include <stdexcept>

namespace roci::services::clock {

/// Says where a node's mission time comes from.
enum class ClockMode {
  live,       ///< the system clock, scaled by `live_scale`
  simulated,  ///< the ClockStep samples of the run's master
  master,     ///< simulated, and this node is the master (sim_svc)
  observer,   ///< no part in the barrier (consoles): now() is the newest stamp seen, timers run in wall time
};

/// Returns whether a node with this clock takes part in the barrier of the simulated clock.
constexpr bool is_simulated(ClockMode mode) {
  return mode == ClockMode::simulated || mode == ClockMode::master;
}

/// Reports that the node cannot go on: the clock's master dropped this service, or it met a livelock.
class ClockError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reports that the master is gone, and with it the run.
class ClockGone : public ClockError {
 public:
  using ClockError::ClockError;
};

}  // namespace roci::services::clock
