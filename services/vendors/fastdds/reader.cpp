#include "services/vendors/fastdds/reader.hpp"

#include <algorithm>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <map>
#include <vector>

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

struct Taken {
  Bytes bytes;
  dds::SampleInfo info;
};

// Fast DDS gives what has come meanwhile instance by instance. Here it is in the order in which it came, and what one
// writer wrote, where a part was lost and came again, in the order in which it was written.
void put_in_order(std::vector<Taken>& taken) {
  std::ranges::stable_sort(taken, {}, [](const Taken& one) { return one.info.reception_timestamp.to_ns(); });
  std::map<transport::Guid, std::vector<std::size_t>> places;  // of each writer's samples
  for (std::size_t i = 0; i < taken.size(); ++i)
    places[to_guid(taken[i].info.sample_identity.writer_guid())].push_back(i);
  std::vector<Taken> ordered(taken.size());
  for (const auto& [writer, of_writer] : places) {
    auto written = of_writer;
    std::ranges::sort(written, {},
                      [&](std::size_t i) { return taken[i].info.sample_identity.sequence_number(); });
    for (std::size_t i = 0; i < written.size(); ++i) ordered[of_writer[i]] = std::move(taken[written[i]]);
  }
  taken = std::move(ordered);
}

}  // namespace

FastReader::FastReader(dds::Subscriber& subscriber, dds::Topic& topic,
                       const transport::EndpointDescription& endpoint, transport::ReaderEvents events,
                       std::shared_ptr<KeySlots> slots)
    : subscriber_(subscriber),
      type_(endpoint.type),
      events_(std::move(events)),
      slots_(std::move(slots)),
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
  for (const auto& key : instances_.keys()) release(key);
}

void FastReader::on_data_available(dds::DataReader* reader) {
  std::vector<Taken> taken(1);
  while (reader->take_next_sample(&taken.back().bytes, &taken.back().info) == ReturnCode_t::RETCODE_OK)
    taken.emplace_back();
  taken.pop_back();
  if (taken.size() > 1) put_in_order(taken);
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  for (Taken& one : taken) {
    if (one.info.valid_data) {
      take_value(std::move(one.bytes), one.info);
    } else {
      take_end(one.info);
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
      follow(key, writer, key_only_payload(serialized));
    }
  }
  if (events_.on_sample) events_.on_sample({transport::SampleKind::data, std::move(bytes.owned), writer});
}

void FastReader::follow(const InstanceTable::Key& key, const transport::Guid& writer,
                        transport::Payload key_payload) {
  if (slots_ && !slots_->hold(key)) return;
  if (!instances_.introduce(key, writer, std::move(key_payload))) release(key);
}

void FastReader::release(const InstanceTable::Key& key) {
  if (slots_) slots_->release(key);
}

void FastReader::take_end(const dds::SampleInfo& info) {
  const auto key = key_of(info.instance_handle);
  auto key_payload = instances_.ended(key);
  if (!key_payload) return;
  release(key);
  if (!events_.on_sample) return;
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
    for (auto& [key, key_payload] : instances_.writer_left(writer)) {
      release(key);
      if (events_.on_sample)
        events_.on_sample({transport::SampleKind::no_writers, std::move(key_payload), writer});
    }
  }
  if (events_.on_matched) events_.on_matched(status.current_count);
}

}  // namespace roci::services::vendors::fastdds
