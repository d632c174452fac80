// This file bounds how many samples a writer may have under way under the simulated clock, by topic.
#pragma once

#include "services/transport/payload_limit.hpp"
#include "services/transport/qos.hpp"

namespace roci::services::transport {

/// Bounds the samples of one instance that a service may write in one micro-step. Large ones come seldom, a call or an
/// answer at a time, and of a state only the newest counts; the bound is kMicroStepLimit at most. Calls beyond it go
/// out in the next micro-step (services/rpc.hpp).
constexpr int micro_step_limit(Qos qos, PayloadLimit limit) {
  if (bytes(limit) >= bytes(PayloadLimit::batch)) return 16;
  return qos == Qos::state ? 32 : kMicroStepLimit;
}

/// Return the settings of writer_qos() and reader_qos() in qos.hpp; under the simulated clock these keep what two
/// micro-steps of such a topic may hold, and no more of what nobody asks for again.
QosSettings writer_qos(Qos, PayloadLimit, Clocking, clock::ClockMode);
QosSettings reader_qos(Qos, PayloadLimit, Clocking, clock::ClockMode);

}  // namespace roci::services::transport
