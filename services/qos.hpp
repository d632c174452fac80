// The four QoS resolved for a kind of clock. Nobody sets a raw policy elsewhere.
#pragma once

#include "services/node.hpp"
#include "services/topics.hpp"

namespace roci::services {

// Under the simulated clock a service may write this many samples of one instance in one micro-step. Writers
// keep twice as many: a receiver has taken the samples of micro-step k before those of k + 2 can be written.
inline constexpr int kMicroStepLimit = 256;

QosSettings writer_qos(Qos, Clocking, ClockMode);
QosSettings reader_qos(Qos, Clocking, ClockMode);

}  // namespace roci::services
