// This is a UDP transport of Fast DDS whose datagrams pass a guard before its parser.
#pragma once

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <memory>

#include "services/vendors/guard/guard.hpp"

namespace roci::services::vendors::fastdds {

/// Returns `udp` with `guard` in front of it, as one of a participant's user transports.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> guarded(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> udp,
    std::shared_ptr<guard::Guard> guard);

}  // namespace roci::services::vendors::fastdds
