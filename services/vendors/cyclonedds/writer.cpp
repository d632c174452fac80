#include "services/vendors/cyclonedds/writer.hpp"

extern "C" {
#include <dds/ddsi/q_protocol.h>
}

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
  auto* data = type_.type.keyed ? make_serdata(type_, SDK_KEY, payload) : nullptr;
  if (!data) return false;
  data->statusinfo = NN_STATUSINFO_DISPOSE;
  data->timestamp.v = dds_time();
  return dds_forwardcdr(writer_, data) == DDS_RETCODE_OK;
}

void CycloneWriter::on_matched(dds_entity_t, dds_publication_matched_status_t status, void* self) {
  auto& writer = *static_cast<CycloneWriter*>(self);
  writer.matched_ = static_cast<int>(status.current_count);
  if (writer.events_.on_matched) writer.events_.on_matched(writer.matched_);
}

}  // namespace roci::services::vendors::cyclonedds
