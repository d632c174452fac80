#include "services/vendors/cyclonedds/writer.hpp"

extern "C" {
#include <dds/ddsi/q_protocol.h>
}

#include <vector>

#include "services/vendors/cyclonedds/qos.hpp"

namespace roci::services::vendors::cyclonedds {

CycloneWriter::CycloneWriter(dds_entity_t publisher, const TopicHandle& topic,
                             const transport::EndpointDescription& endpoint, transport::WriterEvents events)
    : type_(*topic.type), reliable_(endpoint.qos.reliable), events_(std::move(events)) {
  const ListenerPtr listener(dds_create_listener(this));
  dds_lset_publication_matched(listener.get(), &CycloneWriter::on_matched);
  writer_ =
      checked(dds_create_writer(publisher, topic.topic, endpoint_qos(endpoint.qos).get(), listener.get()),
              "a writer on " + endpoint.topic);
  dds_guid_t guid;
  checked(dds_get_guid(writer_, &guid), "the identity of a writer on " + endpoint.topic);
  guid_ = to_guid(guid);
  look_up_early_matches();
}

CycloneWriter::~CycloneWriter() {
  if (reliable_ && matched_ > 0) dds_wait_for_acks(writer_, DDS_MSECS(100));
  dds_delete(writer_);
}

bool CycloneWriter::write(std::span<const std::uint8_t> payload) {
  auto* data = make_serdata(type_, SDK_DATA, payload);
  return data && dds_writecdr(writer_, data) == DDS_RETCODE_OK;
}

bool CycloneWriter::dispose(std::span<const std::uint8_t> payload) {
  return end(payload, NN_STATUSINFO_DISPOSE);
}

bool CycloneWriter::forget(std::span<const std::uint8_t> payload) {
  return end(payload, NN_STATUSINFO_DISPOSE | NN_STATUSINFO_UNREGISTER);
}

bool CycloneWriter::end(std::span<const std::uint8_t> payload, std::uint32_t how) {
  auto* data = type_.type.keyed ? make_serdata(type_, SDK_KEY, payload) : nullptr;
  if (!data) return false;
  data->statusinfo = how;
  data->timestamp.v = dds_time();
  return dds_forwardcdr(writer_, data) == DDS_RETCODE_OK;
}

void CycloneWriter::meet(dds_entity_t writer, dds_instance_handle_t subscription) const {
  auto* endpoint = events_.on_reader ? dds_get_matched_subscription_data(writer, subscription) : nullptr;
  if (!endpoint) return;
  const transport::Guid reader = to_guid(endpoint->key);
  dds_builtintopic_free_endpoint(endpoint);
  events_.on_reader(reader);
}

// The vendor names no reader for a match that it reports while the writer is still being created.
void CycloneWriter::look_up_early_matches() const {
  std::vector<dds_instance_handle_t> readers(16);
  dds_return_t count = 0;
  while ((count = dds_get_matched_subscriptions(writer_, readers.data(), readers.size())) >
         static_cast<dds_return_t>(readers.size())) {
    readers.resize(static_cast<std::size_t>(count));
  }
  for (dds_return_t i = 0; i < count; ++i) meet(writer_, readers[static_cast<std::size_t>(i)]);
}

void CycloneWriter::on_matched(dds_entity_t entity, dds_publication_matched_status_t status, void* self) {
  auto& writer = *static_cast<CycloneWriter*>(self);
  if (status.current_count_change > 0) writer.meet(entity, status.last_subscription_handle);
  writer.matched_ = static_cast<int>(status.current_count);
  if (writer.events_.on_matched) writer.events_.on_matched(writer.matched_);
}

}  // namespace roci::services::vendors::cyclonedds
