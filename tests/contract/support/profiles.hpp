// The QoS and the topics that the contract is tested with.
#pragma once

#include "roci_idl/goal.h"
#include "services/transport/type_support.hpp"

namespace roci::services::contract {

inline transport::QosSettings latched(int depth) { return {.transient_local = true, .history_depth = depth}; }
inline transport::QosSettings request() { return {.history_depth = 0, .max_samples = 4096}; }
inline transport::QosSettings stream() { return {.reliable = false, .history_depth = 5}; }

template <class T>
transport::EndpointDescription endpoint(const std::string& topic, const char* type_name,
                                        const transport::QosSettings& qos) {
  return {topic, transport::describe_type<T>(type_name), qos};
}

inline transport::EndpointDescription goal_endpoint(const transport::QosSettings& qos) {
  return endpoint<v1::Goal>("roci/goal", "roci::v1::Goal", qos);
}

inline transport::Payload goal(const std::string& id, int priority, const std::string& issuer = "ground",
                               const std::string& run = {}) {
  v1::Goal value;
  value.header().run(run);
  value.header().sender(issuer);
  value.issuer(issuer);
  value.id(id);
  value.priority(priority);
  return transport::serialize(value);
}

}  // namespace roci::services::contract
