// This is a writer of Fast DDS.
#pragma once

#include <atomic>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <mutex>

#include "services/transport/forgets_instances.hpp"
#include "services/transport/transport.hpp"
#include "services/vendors/due_instances.hpp"

namespace roci::services::vendors::fastdds {

/// Writes the samples of one topic, as bytes that were encoded before.
class FastWriter : public transport::Writer,
                   public transport::ForgetsInstances,
                   private eprosima::fastdds::dds::DataWriterListener {
 public:
  FastWriter(eprosima::fastdds::dds::Publisher&, eprosima::fastdds::dds::Topic&,
             const transport::EndpointDescription&, transport::WriterEvents);
  /// Waits a moment for what the readers have not acknowledged yet.
  ~FastWriter() override;

  bool write(std::span<const std::uint8_t> payload) override;
  bool dispose(std::span<const std::uint8_t> payload) override;
  /// Takes effect once every reader has confirmed all that was written, in a later call at the latest.
  bool forget(std::span<const std::uint8_t> payload) override;
  transport::Guid guid() const override;
  int matched_readers() const override { return matched_; }

 private:
  bool has_space(std::size_t bytes);
  void forget_due(const eprosima::fastrtps::Duration_t& patience);
  void dispose_kept(const DueInstances::Instance&);
  void on_publication_matched(eprosima::fastdds::dds::DataWriter*,
                              const eprosima::fastdds::dds::PublicationMatchedStatus&) override;

  eprosima::fastdds::dds::Publisher& publisher_;
  const transport::TypeDescription type_;
  const transport::QosSettings qos_;
  const transport::WriterEvents events_;
  std::atomic<int> matched_ = 0;
  std::atomic<int> unconfirmed_ = 0;                // samples written since all were known to be acknowledged
  std::atomic<std::size_t> unconfirmed_bytes_ = 0;  // of these
  std::mutex mutex_;                                // one change of the history at a time
  DueInstances due_;
  eprosima::fastdds::dds::DataWriter* writer_;
};

}  // namespace roci::services::vendors::fastdds
