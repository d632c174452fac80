#include "services/vendors/fastdds/writer.hpp"

#include <algorithm>

#include "services/vendors/fastdds/bytes_type.hpp"
#include "services/vendors/fastdds/guid.hpp"
#include "services/vendors/fastdds/qos.hpp"
#include "services/vendors/history_limits.hpp"
#include "services/vendors/instance_table.hpp"

namespace roci::services::vendors::fastdds {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::Duration_t;

namespace {

const Duration_t kNoPatience(0, 0);
// So many instances that are to be forgotten wait without holding up their writer, and then until each reader must have
// confirmed what it has: twice the period of heartbeats (qos.cpp).
constexpr std::size_t kWaiting = 48;
const Duration_t kPatience(0, 200'000'000);
// A writer that ends waits so long for its readers.
const Duration_t kParting(0, 100'000'000);

int depth_of(const transport::QosSettings& qos) { return qos.transient_local ? qos.history_depth : 0; }

DueInstances::Key key_of(const KeyHash& hash) { return {hash.begin(), hash.end()}; }

Bytes key_only(const DueInstances::Instance& instance) {
  Bytes bytes{instance.payload, {}, KeyHash{}};
  std::copy(instance.key.begin(), instance.key.end(), bytes.key_hash->begin());
  return bytes;
}

}  // namespace

FastWriter::FastWriter(dds::Publisher& publisher, dds::Topic& topic,
                       const transport::EndpointDescription& endpoint, transport::WriterEvents events)
    : publisher_(publisher),
      type_(endpoint.type),
      qos_(endpoint.qos),
      events_(std::move(events)),
      due_(depth_of(endpoint.qos)),
      writer_(publisher.create_datawriter(&topic, writer_qos(endpoint.qos), this,
                                          dds::StatusMask::publication_matched())) {
  if (!writer_) throw transport::TransportError("Fast DDS refused a writer on " + endpoint.topic);
}

FastWriter::~FastWriter() {
  if (qos_.reliable && matched_ > 0) writer_->wait_for_acknowledgments(kParting);
  writer_->set_listener(nullptr);
  publisher_.delete_datawriter(writer_);
}

bool FastWriter::write(std::span<const std::uint8_t> payload) {
  Bytes bytes{payload, {}, {}};
  if (payload.size() < 4) return false;
  if (type_.keyed && !(bytes.key_hash = key_hash_of(type_, payload, false))) return false;
  if (!has_space(payload.size())) return false;
  if (!type_.keyed) return writer_->write(&bytes);
  const std::lock_guard lock(mutex_);
  due_.changed(key_of(*bytes.key_hash));
  forget_due(kNoPatience);
  return writer_->write(&bytes);
}

bool FastWriter::dispose(std::span<const std::uint8_t> payload) {
  Bytes bytes{payload, {}, {}};
  if (!type_.keyed || !(bytes.key_hash = key_hash_of(type_, payload, false))) return false;
  if (!has_space(payload.size())) return false;
  const std::lock_guard lock(mutex_);
  due_.changed(key_of(*bytes.key_hash));
  return writer_->dispose(&bytes, dds::HANDLE_NIL) == ReturnCode_t::RETCODE_OK;
}

bool FastWriter::forget(std::span<const std::uint8_t> payload) {
  transport::Payload key;
  const auto hash = type_.keyed ? key_hash_of(type_, payload, false) : std::nullopt;
  if (!hash || !type_.serialized_key(payload, true, key)) return false;
  const DueInstances::Instance instance{key_of(*hash), key_only_payload(key)};
  const std::lock_guard lock(mutex_);
  if (!due_.forget(instance)) {
    dispose_kept(instance);
  } else {
    const bool patient = due_.waiting() % kWaiting == 0;
    forget_due(patient ? kPatience : kNoPatience);
  }
  return true;
}

// An acknowledgement that overtakes the end of a group leaves the rest of it in the history; nothing else is lost.
void FastWriter::forget_due(const Duration_t& patience) {
  if (due_.waiting() == 0 || writer_->wait_for_acknowledgments(patience) != ReturnCode_t::RETCODE_OK) return;
  const DueInstances::Group group = due_.take();
  for (const DueInstances::Instance& instance : group.unregistered) {
    Bytes bytes = key_only(instance);
    writer_->unregister_instance(&bytes, dds::HANDLE_NIL);
  }
  for (int i = 0; i < group.times; ++i) dispose_kept(*group.kept);
}

void FastWriter::dispose_kept(const DueInstances::Instance& kept) {
  Bytes bytes = key_only(kept);
  writer_->dispose(&bytes, dds::HANDLE_NIL);
}

// Bounds a keep-all history itself, because Fast DDS cannot limit samples without limiting instances, and knows no
// bytes. From half of a bound on it looks whether all is acknowledged; at the bound it waits for that.
bool FastWriter::has_space(std::size_t bytes) {
  if (!qos_.reliable || qos_.history_depth > 0 || qos_.max_samples <= 0) return true;
  const int samples = ++unconfirmed_;
  const std::size_t together = unconfirmed_bytes_ += bytes;
  if (samples <= qos_.max_samples / 2 && together <= kUnconfirmedBytes / 2) return true;
  const bool full = samples > qos_.max_samples || (samples > 1 && together > kUnconfirmedBytes);
  const auto patience = full ? blocking_time(qos_) : kNoPatience;
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
