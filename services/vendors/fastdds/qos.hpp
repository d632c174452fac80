// This file has our settings in the terms of Fast DDS.
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <memory>

#include "services/transport/transport.hpp"
#include "services/vendors/guard/guard.hpp"
#include "services/vendors/key_slots.hpp"

namespace roci::services::vendors::fastdds {

/// Returns UDP unicast on options.address alone, sent from `port`, after which the participant is named, or, with
/// vendor_xml, the default participant profile of that file with its built-in transports replaced by UDPv4. Datagrams
/// pass `guard` in either case; `slots`: guarded_transport.hpp.
eprosima::fastdds::dds::DomainParticipantQos participant_qos(const transport::TransportOptions&,
                                                             const std::shared_ptr<guard::Guard>& guard,
                                                             const std::shared_ptr<KeySlots>& slots,
                                                             std::uint16_t port);

eprosima::fastrtps::Duration_t blocking_time(const transport::QosSettings&);
eprosima::fastdds::dds::DataWriterQos writer_qos(const transport::QosSettings&);
eprosima::fastdds::dds::DataReaderQos reader_qos(const transport::QosSettings&);

}  // namespace roci::services::vendors::fastdds
