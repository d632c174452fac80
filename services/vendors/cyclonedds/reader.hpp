// This is a reader of Cyclone DDS.
#pragma once

#include <atomic>
#include <mutex>

#include "services/transport/transport.hpp"
#include "services/vendors/cyclonedds/writer.hpp"
#include "services/vendors/instance_table.hpp"
#include "services/vendors/writer_guids.hpp"

namespace roci::services::vendors::cyclonedds {

/// Takes serialized samples in, and ends of instances with their keys.
class CycloneReader : public transport::Reader {
 public:
  CycloneReader(dds_entity_t subscriber, const TopicHandle&, const transport::EndpointDescription&,
                transport::ReaderEvents);
  ~CycloneReader() override;

  int matched_writers() const override { return matched_; }

 private:
  static void on_data(dds_entity_t, void* self);
  static void on_matched(dds_entity_t, dds_subscription_matched_status_t, void* self);

  void take_all(dds_entity_t reader);
  void take(const Serdata&, const dds_sample_info_t&, const transport::Guid& writer);
  transport::Guid writer_of(dds_entity_t reader, dds_instance_handle_t publication);
  void begin_with(dds_entity_t reader, dds_instance_handle_t publication);
  void look_up_early_matches();

  const Sertype& type_;
  const bool reliable_volatile_;
  const transport::ReaderEvents events_;
  std::atomic<int> matched_ = 0;
  std::mutex mutex_;  // one callback at a time
  InstanceTable instances_;
  WriterGuids writers_;
  dds_entity_t reader_;
};

}  // namespace roci::services::vendors::cyclonedds
