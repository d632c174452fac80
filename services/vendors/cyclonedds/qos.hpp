// This file has our settings in the terms of Cyclone DDS, and owners for its handles.
#pragma once

extern "C" {
#include <dds/dds.h>
}

#include <memory>

#include "services/transport/transport.hpp"

namespace roci::services::vendors::cyclonedds {

/// Lets a std::unique_ptr delete a QoS.
struct DeleteQos {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using QosPtr = std::unique_ptr<dds_qos_t, DeleteQos>;

/// Lets a std::unique_ptr delete a listener.
struct DeleteListener {
  void operator()(dds_listener_t* listener) const { dds_delete_listener(listener); }
};
using ListenerPtr = std::unique_ptr<dds_listener_t, DeleteListener>;

/// Makes the QoS of an endpoint, for writers and readers alike.
QosPtr endpoint_qos(const transport::QosSettings&);

/// Returns `entity` if it is a handle; throws TransportError "Cyclone DDS refused <what>: <why>" if it is an
/// error code.
dds_entity_t checked(dds_entity_t entity, const std::string& what);

/// Returns the vendor's GUID as our boundary has it.
transport::Guid to_guid(const dds_guid_t&);

}  // namespace roci::services::vendors::cyclonedds
