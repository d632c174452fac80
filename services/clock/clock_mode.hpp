// How a node learns what mission time it is, and how that can fail.
#pragma once

#include <stdexcept>

namespace roci::services::clock {

enum class ClockMode {
  live,       ///< The system clock, scaled by `live_scale`.
  simulated,  ///< The ClockStep samples of the run's master.
  master,     ///< Simulated, and this node is the master (sim_svc).
  observer,   ///< No part in the barrier (consoles): now() is the newest stamp seen, timers run in wall time.
};

/// Whether a node with this clock takes part in the barrier of the simulated clock.
constexpr bool is_simulated(ClockMode mode) {
  return mode == ClockMode::simulated || mode == ClockMode::master;
}

/// The node cannot go on: the clock's master dropped this service, or it met a livelock.
class ClockError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The master is gone, and with it the run.
class ClockGone : public ClockError {
 public:
  using ClockError::ClockError;
};

}  // namespace roci::services::clock
