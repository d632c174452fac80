#include "services/vendors/fastdds/writer.hpp"

#include "services/vendors/fastdds/bytes_type.hpp"
#include "services/vendors/fastdds/guid.hpp"
#include "services/vendors/fastdds/qos.hpp"
#include "services/vendors/history_limits.hpp"

namespace roci::services::vendors::fastdds {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::Duration_t;

FastWriter::FastWriter(dds::Publisher& publisher, dds::Topic& topic,
                       const transport::EndpointDescription& endpoint, transport::WriterEvents events)
    : publisher_(publisher),
      type_(endpoint.type),
      qos_(endpoint.qos),
      events_(std::move(events)),
      writer_(publisher.create_datawriter(&topic, writer_qos(endpoint.qos), this,
                                          dds::StatusMask::publication_matched())) {
  if (!writer_) throw transport::TransportError("Fast DDS refused a writer on " + endpoint.topic);
}

FastWriter::~FastWriter() {
  if (qos_.reliable && matched_ > 0) writer_->wait_for_acknowledgments(Duration_t(0, 100'000'000));
  writer_->set_listener(nullptr);
  publisher_.delete_datawriter(writer_);
}

bool FastWriter::write(std::span<const std::uint8_t> payload) {
  Bytes bytes{payload, {}, {}};
  if (payload.size() < 4) return false;
  if (type_.keyed && !(bytes.key_hash = key_hash_of(type_, payload, false))) return false;
  return has_space(payload.size()) && writer_->write(&bytes);
}

bool FastWriter::dispose(std::span<const std::uint8_t> payload) {
  Bytes bytes{payload, {}, {}};
  if (!type_.keyed || !(bytes.key_hash = key_hash_of(type_, payload, false))) return false;
  return has_space(payload.size()) && writer_->dispose(&bytes, dds::HANDLE_NIL) == ReturnCode_t::RETCODE_OK;
}

// Bounds a keep-all history itself, because Fast DDS cannot limit samples without limiting instances, and knows no
// bytes. From half of a bound on it looks whether all is acknowledged; at the bound it waits for that.
bool FastWriter::has_space(std::size_t bytes) {
  if (!qos_.reliable || qos_.history_depth > 0 || qos_.max_samples <= 0) return true;
  const int samples = ++unconfirmed_;
  const std::size_t together = unconfirmed_bytes_ += bytes;
  if (samples <= qos_.max_samples / 2 && together <= kUnconfirmedBytes / 2) return true;
  const bool full = samples > qos_.max_samples || (samples > 1 && together > kUnconfirmedBytes);
  const auto patience = full ? blocking_time(qos_) : Duration_t(0, 0);
  if (writer_->wait_for_acknowledgments(patience) == ReturnCode_t::RETCODE_OK) {
    unconfirmed_ = 1;
    unconfirmed_bytes_ = bytes;
    return true;
  }
  if (!full) return true;
  --unconfirmed_;
  unconfirmed_bytes_ -= bytes;
  return false;
}

transport::Guid FastWriter::guid() const { return to_guid(writer_->guid()); }

void FastWriter::on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) {
  matched_ = status.current_count;
  if (status.current_count_change > 0 && events_.on_reader) {
    eprosima::fastrtps::rtps::GUID_t theirs;
    eprosima::fastrtps::rtps::iHandle2GUID(theirs, status.last_subscription_handle);
    events_.on_reader(to_guid(theirs));
  }
  if (events_.on_matched) events_.on_matched(status.current_count);
}

}  // namespace roci::services::vendors::fastdds
