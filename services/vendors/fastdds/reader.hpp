// This is a reader of Fast DDS.
#pragma once

#include <atomic>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <memory>
#include <mutex>

#include "services/transport/transport.hpp"
#include "services/vendors/fastdds/bytes_type.hpp"
#include "services/vendors/instance_table.hpp"
#include "services/vendors/key_slots.hpp"

namespace roci::services::vendors::fastdds {

/// Takes samples in as bytes, which are decoded later, and ends of instances with their keys.
class FastReader : public transport::Reader, private eprosima::fastdds::dds::DataReaderListener {
 public:
  FastReader(eprosima::fastdds::dds::Subscriber&, eprosima::fastdds::dds::Topic&,
             const transport::EndpointDescription&, transport::ReaderEvents, std::shared_ptr<KeySlots>);
  ~FastReader() override;

  int matched_writers() const override { return matched_; }

 private:
  void on_data_available(eprosima::fastdds::dds::DataReader*) override;
  void on_subscription_matched(eprosima::fastdds::dds::DataReader*,
                               const eprosima::fastdds::dds::SubscriptionMatchedStatus&) override;

  void take_value(Bytes&&, const eprosima::fastdds::dds::SampleInfo&);
  void take_end(const eprosima::fastdds::dds::SampleInfo&);
  void follow(const InstanceTable::Key&, const transport::Guid& writer, transport::Payload key_payload);
  void release(const InstanceTable::Key&);

  eprosima::fastdds::dds::Subscriber& subscriber_;
  const transport::TypeDescription type_;
  const transport::ReaderEvents events_;
  std::atomic<int> matched_ = 0;
  std::mutex mutex_;  // one callback at a time
  bool closed_ = false;
  InstanceTable instances_;                 // by the vendor's instance handle
  const std::shared_ptr<KeySlots> slots_;  // of these handles, or none
  eprosima::fastdds::dds::DataReader* reader_;
};

}  // namespace roci::services::vendors::fastdds
