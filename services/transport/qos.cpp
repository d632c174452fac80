#include "services/transport/qos.hpp"

#include <stdexcept>

#include "services/transport/micro_step.hpp"

namespace roci::services::transport {
namespace {

QosSettings table(Qos qos) {
  switch (qos) {
    case Qos::state:
      return {.reliable = true, .transient_local = true, .history_depth = 1};
    case Qos::event:
      return {.reliable = true, .transient_local = false, .history_depth = 256};
    case Qos::stream:
      return {.reliable = false, .transient_local = false, .history_depth = 5};
    case Qos::request:
      return {.reliable = true, .transient_local = false, .history_depth = 0, .max_samples = 1024};
  }
  throw std::logic_error("unknown QoS");
}

bool barriered(Clocking clocking, clock::ClockMode mode) {
  return clocking == Clocking::clocked && clock::is_simulated(mode);
}

// No sample may be lost or overwritten before the barrier has seen it, and none waits for a slow reader
// outside.
QosSettings barrier_qos(int micro_step_limit) {
  return {.reliable = true, .transient_local = true, .history_depth = 2 * micro_step_limit};
}

}  // namespace

QosSettings writer_qos(Qos qos, Clocking clocking, clock::ClockMode mode) {
  if (barriered(clocking, mode)) return barrier_qos(kMicroStepLimit);
  QosSettings settings = table(qos);
  if (mode == clock::ClockMode::observer && clocking == Clocking::clocked) {
    // An observer does not know the run's clock: it offers what readers of either kind ask for.
    settings.reliable = true;
    settings.transient_local = true;
    if (settings.history_depth == 0) settings.history_depth = kMicroStepLimit;
  }
  return settings;
}

QosSettings reader_qos(Qos qos, Clocking clocking, clock::ClockMode mode) {
  return barriered(clocking, mode) ? barrier_qos(kMicroStepLimit) : table(qos);
}

QosSettings writer_qos(Qos qos, PayloadLimit limit, Clocking clocking, clock::ClockMode mode) {
  return barriered(clocking, mode) ? barrier_qos(micro_step_limit(qos, limit))
                                   : writer_qos(qos, clocking, mode);
}

QosSettings reader_qos(Qos qos, PayloadLimit limit, Clocking clocking, clock::ClockMode mode) {
  return barriered(clocking, mode) ? barrier_qos(micro_step_limit(qos, limit))
                                   : reader_qos(qos, clocking, mode);
}

}  // namespace roci::services::transport
