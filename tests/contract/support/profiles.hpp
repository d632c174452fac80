// The QoS and the topics that the contract is tested with.
#pragma once

#include "roci_idl/goal.h"
#include "services/type_support.hpp"

namespace roci::services::contract {

inline QosSettings latched(int depth) { return {.transient_local = true, .history_depth = depth}; }
inline QosSettings request() { return {.history_depth = 0, .max_samples = 4096}; }
inline QosSettings stream() { return {.reliable = false, .history_depth = 5}; }

template <class T>
EndpointDescription endpoint(const std::string& topic, const char* type_name, const QosSettings& qos) {
  return {topic, describe_type<T>(type_name), qos};
}

inline EndpointDescription goal_endpoint(const QosSettings& qos) {
  return endpoint<v1::Goal>("roci/goal", "roci::v1::Goal", qos);
}

inline Payload goal(const std::string& id, int priority, const std::string& issuer = "ground") {
  v1::Goal value;
  value.issuer(issuer);
  value.id(id);
  value.priority(priority);
  return serialize(value);
}

}  // namespace roci::services::contract
