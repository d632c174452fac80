// This is a UDP transport of Fast DDS whose datagrams pass a guard before its parser.
#pragma once

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <memory>

#include "services/vendors/guard/guard.hpp"
#include "services/vendors/key_slots.hpp"

namespace roci::services::vendors::fastdds {

/// Returns `udp` with `guard` in front of it, as one of a participant's user transports. With `slots`, which a guard of
/// plain text alone can fill, received samples have the handles of these in the place of their key hashes.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> guarded(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> udp,
    std::shared_ptr<guard::Guard> guard, std::shared_ptr<KeySlots> slots);

}  // namespace roci::services::vendors::fastdds
