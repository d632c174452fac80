// The credentials of a participant become properties of its QoS in Cyclone DDS, so that a secure run keeps the
// configuration of its domain as it is.
#pragma once

#include "services/vendors/cyclonedds/qos.hpp"

namespace roci::services::vendors::cyclonedds {

/// Adds the credentials to a QoS. Throws TransportError if the vendor's plug-ins for DDS Security are not
/// installed.
void add_credentials(const transport::Credentials&, dds_qos_t*);

}  // namespace roci::services::vendors::cyclonedds
