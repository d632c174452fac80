// This is a writer of Cyclone DDS.
#pragma once

#include <atomic>

#include "services/transport/forgets_instances.hpp"
#include "services/transport/transport.hpp"
#include "services/vendors/cyclonedds/sertype.hpp"

namespace roci::services::vendors::cyclonedds {

/// Holds a topic of the vendor with its type.
struct TopicHandle {
  dds_entity_t topic = 0;
  const Sertype* type = nullptr;  ///< owned by the vendor as long as the topic lives
};

/// Sends serialized samples, and forgets finished instances.
class CycloneWriter : public transport::Writer, public transport::ForgetsInstances {
 public:
  CycloneWriter(dds_entity_t publisher, const TopicHandle&, const transport::EndpointDescription&,
                transport::WriterEvents);
  /// Waits a moment for what the readers have not acknowledged yet.
  ~CycloneWriter() override;

  bool write(std::span<const std::uint8_t> payload) override;
  bool dispose(std::span<const std::uint8_t> payload) override;
  bool forget(std::span<const std::uint8_t> payload) override;
  transport::Guid guid() const override { return guid_; }
  int matched_readers() const override { return matched_; }

 private:
  bool end(std::span<const std::uint8_t> payload, std::uint32_t how);
  static void on_matched(dds_entity_t, dds_publication_matched_status_t, void* self);

  void meet(dds_entity_t writer, dds_instance_handle_t subscription) const;
  void look_up_early_matches() const;

  const Sertype& type_;
  const bool reliable_;
  const transport::WriterEvents events_;
  std::atomic<int> matched_ = 0;
  dds_entity_t writer_;
  transport::Guid guid_{};
};

}  // namespace roci::services::vendors::cyclonedds
