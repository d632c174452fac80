#include "services/vendors/cyclonedds/qos.hpp"

#include <algorithm>

namespace roci::services::vendors::cyclonedds {

QosPtr endpoint_qos(const transport::QosSettings& settings) {
  QosPtr qos(dds_create_qos());
  const auto history = settings.history_depth > 0 ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL;
  const int depth = std::max(settings.history_depth, 1);
  const int samples = settings.max_samples > 0 ? settings.max_samples : DDS_LENGTH_UNLIMITED;
  dds_qset_reliability(qos.get(), settings.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_MSECS(settings.max_blocking_ms));
  dds_qset_durability(qos.get(),
                      settings.transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), history, depth);
  dds_qset_resource_limits(qos.get(), samples, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  // What late joiners get is a setting of its own here.
  dds_qset_durability_service(qos.get(), 0, history, depth, samples, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  return qos;
}

dds_entity_t checked(dds_entity_t entity, const std::string& what) {
  if (entity < 0)
    throw transport::TransportError("Cyclone DDS refused " + what + ": " + dds_strretcode(entity));
  return entity;
}

transport::Guid to_guid(const dds_guid_t& theirs) {
  transport::Guid guid;
  std::copy(std::begin(theirs.v), std::end(theirs.v), guid.begin());
  return guid;
}

}  // namespace roci::services::vendors::cyclonedds
