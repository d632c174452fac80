#include "services/vendors/fastdds/reader.hpp"

#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include "services/vendors/fastdds/guid.hpp"
#include "services/vendors/fastdds/qos.hpp"

namespace roci::services::vendors::fastdds {

namespace dds = eprosima::fastdds::dds;

namespace {

InstanceTable::Key key_of(const dds::InstanceHandle_t& handle) {
  InstanceTable::Key key;
  for (std::size_t i = 0; i < 16; ++i) key.push_back(static_cast<char>(handle.value[i]));
  return key;
}

}  // namespace

FastReader::FastReader(dds::Subscriber& subscriber, dds::Topic& topic,
                       const transport::EndpointDescription& endpoint, transport::ReaderEvents events)
    : subscriber_(subscriber),
      type_(endpoint.type),
      events_(std::move(events)),
      reader_(subscriber.create_datareader(&topic, reader_qos(endpoint.qos), this,
                                           dds::StatusMask::data_available()
                                               << dds::StatusMask::subscription_matched())) {
  if (!reader_) throw transport::TransportError("Fast DDS refused a reader on " + endpoint.topic);
}

FastReader::~FastReader() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  reader_->set_listener(nullptr);
  subscriber_.delete_datareader(reader_);
}

void FastReader::on_data_available(dds::DataReader* reader) {
  for (;;) {
    Bytes bytes;
    dds::SampleInfo info;
    if (reader->take_next_sample(&bytes, &info) != ReturnCode_t::RETCODE_OK) return;
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    if (info.valid_data) {
      take_value(std::move(bytes), info);
    } else {
      take_end(info);
    }
  }
}

void FastReader::take_value(Bytes&& bytes, const dds::SampleInfo& info) {
  const transport::Guid writer = to_guid(info.sample_identity.writer_guid());
  if (type_.keyed) {
    const auto key = key_of(info.instance_handle);
    if (!instances_.wrote(key, writer)) {
      transport::Payload serialized;
      if (!type_.serialized_key(bytes.owned, false, serialized)) return;
      instances_.introduce(key, writer, key_only_payload(serialized));
    }
  }
  if (events_.on_sample) events_.on_sample({transport::SampleKind::data, std::move(bytes.owned), writer});
}

void FastReader::take_end(const dds::SampleInfo& info) {
  auto key_payload = instances_.ended(key_of(info.instance_handle));
  if (!key_payload || !events_.on_sample) return;
  const bool disposed = info.instance_state == dds::NOT_ALIVE_DISPOSED_INSTANCE_STATE;
  events_.on_sample({disposed ? transport::SampleKind::disposed : transport::SampleKind::no_writers,
                     std::move(*key_payload), to_guid(info.sample_identity.writer_guid())});
}

void FastReader::on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) {
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  matched_ = status.current_count;
  eprosima::fastrtps::rtps::GUID_t theirs;
  eprosima::fastrtps::rtps::iHandle2GUID(theirs, status.last_publication_handle);
  const transport::Guid writer = to_guid(theirs);
  if (status.current_count_change > 0 && events_.on_writer) events_.on_writer(writer);
  if (status.current_count_change < 0) {
    // Fast DDS marks the instances of a writer that left, but reports no sample for it.
    for (auto& key_payload : instances_.writer_left(writer)) {
      if (events_.on_sample)
        events_.on_sample({transport::SampleKind::no_writers, std::move(key_payload), writer});
    }
  }
  if (events_.on_matched) events_.on_matched(status.current_count);
}

}  // namespace roci::services::vendors::fastdds
