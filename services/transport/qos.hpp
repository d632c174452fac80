// There are four QoS, resolved here for each kind of clock. Nobody sets a raw policy elsewhere.
#pragma once

#include "services/clock/clock_mode.hpp"

namespace roci::services::transport {

/// Names the only four QoS (architecture, "The wire"). `clocked` variants of a run under the simulated clock
/// keep enough history that no sample of a micro-step is ever overwritten; the transport gets the resolved
/// settings.
enum class Qos {
  state,    ///< reliable, transient local, keep last 1: a late joiner sees the newest value of each key
  event,    ///< reliable, volatile, bounded history
  stream,   ///< best effort, keep last 5
  request,  ///< reliable, volatile, keep all with limits
};

/// Holds a QoS as a transport is told it.
struct QosSettings {
  bool reliable = true;
  bool transient_local = false;
  int history_depth = 1;      ///< 0: keep all, up to max_samples
  int max_samples = 0;        ///< 0: no limit
  int max_blocking_ms = 100;  ///< how long a write may wait for a slow reader before it fails
};

/// Tells whether the samples of a topic pass the barrier of the simulated clock.
enum class Clocking { clocked, wall };

/// Bounds the samples of one instance that a service may write in one micro-step under the simulated clock.
/// Writers keep twice as many: a receiver has taken the samples of micro-step k before those of k + 2 can be
/// written.
inline constexpr int kMicroStepLimit = 256;

QosSettings writer_qos(Qos, Clocking, clock::ClockMode);
QosSettings reader_qos(Qos, Clocking, clock::ClockMode);

}  // namespace roci::services::transport
