// How many samples a writer may have under way under the simulated clock, by topic.
#pragma once

#include "services/transport/payload_limit.hpp"
#include "services/transport/qos.hpp"

namespace roci::services::transport {

/// Samples of one instance that a service may write in one micro-step. What is large comes seldom, a call or an answer
/// at a time, and of a state only the newest counts; nothing has more than kMicroStepLimit. Calls beyond it go out in
/// the next micro-step (services/rpc.hpp).
constexpr int micro_step_limit(Qos qos, PayloadLimit limit) {
  if (bytes(limit) >= bytes(PayloadLimit::batch)) return 16;
  return qos == Qos::state ? 32 : kMicroStepLimit;
}

/// As writer_qos() and reader_qos() of qos.hpp; under the simulated clock they keep what two micro-steps of such a
/// topic may hold, and no more of what nobody asks for again.
QosSettings writer_qos(Qos, PayloadLimit, Clocking, clock::ClockMode);
QosSettings reader_qos(Qos, PayloadLimit, Clocking, clock::ClockMode);

}  // namespace roci::services::transport
