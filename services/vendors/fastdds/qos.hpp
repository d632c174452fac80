// Our settings in the terms of Fast DDS.
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "services/transport/transport.hpp"

namespace roci::services::vendors::fastdds {

/// UDP unicast on options.address alone. With vendor_xml: the default participant profile of that file
/// instead.
eprosima::fastdds::dds::DomainParticipantQos participant_qos(const transport::TransportOptions&);

eprosima::fastrtps::Duration_t blocking_time(const transport::QosSettings&);
eprosima::fastdds::dds::DataWriterQos writer_qos(const transport::QosSettings&);
eprosima::fastdds::dds::DataReaderQos reader_qos(const transport::QosSettings&);

}  // namespace roci::services::vendors::fastdds
