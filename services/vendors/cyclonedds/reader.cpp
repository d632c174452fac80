#include "services/vendors/cyclonedds/reader.hpp"

#include <array>
#include <vector>

extern "C" {
#include "services/vendors/cyclonedds/session_start.h"
}

#include "services/vendors/cyclonedds/qos.hpp"

namespace roci::services::vendors::cyclonedds {

CycloneReader::CycloneReader(dds_entity_t subscriber, const TopicHandle& topic,
                             const transport::EndpointDescription& endpoint, transport::ReaderEvents events)
    : type_(*topic.type),
      reliable_volatile_(endpoint.qos.reliable && !endpoint.qos.transient_local),
      events_(std::move(events)) {
  const ListenerPtr listener(dds_create_listener(this));
  dds_lset_data_available(listener.get(), &CycloneReader::on_data);
  dds_lset_subscription_matched(listener.get(), &CycloneReader::on_matched);
  reader_ =
      checked(dds_create_reader(subscriber, topic.topic, endpoint_qos(endpoint.qos).get(), listener.get()),
              "a reader on " + endpoint.topic);
  look_up_early_matches();
}

CycloneReader::~CycloneReader() { dds_delete(reader_); }

void CycloneReader::on_data(dds_entity_t reader, void* self) {
  static_cast<CycloneReader*>(self)->take_all(reader);
}

void CycloneReader::take_all(dds_entity_t reader) {
  constexpr std::uint32_t kBatch = 32;
  std::array<ddsi_serdata*, kBatch> samples;
  std::array<dds_sample_info_t, kBatch> infos;
  const std::lock_guard lock(mutex_);
  dds_return_t count = 0;
  do {
    count = dds_takecdr(reader, samples.data(), kBatch, infos.data(), DDS_ANY_STATE);
    for (dds_return_t i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      take(*static_cast<const Serdata*>(samples[at]), infos[at],
           writer_of(reader, infos[at].publication_handle));
      ddsi_serdata_unref(samples[at]);
    }
  } while (count == static_cast<dds_return_t>(kBatch));
}

void CycloneReader::take(const Serdata& data, const dds_sample_info_t& info, const transport::Guid& writer) {
  if (!events_.on_sample) return;
  const auto payload = data.payload();
  if (info.valid_data) {
    if (type_.type.keyed && !instances_.wrote(data.instance(), writer)) {
      transport::Payload key;
      if (!type_.type.serialized_key(payload, false, key)) return;
      instances_.introduce(data.instance(), writer, key_only_payload(key));
    }
    events_.on_sample(
        {transport::SampleKind::data, transport::Payload(payload.begin(), payload.end()), writer});
  }
  const bool more_of_instance_follow = info.sample_rank > 0;
  if (!type_.type.keyed || info.instance_state == DDS_IST_ALIVE || more_of_instance_follow) return;
  if (auto key_payload = instances_.ended(data.instance())) {
    const bool disposed = info.instance_state == DDS_IST_NOT_ALIVE_DISPOSED;
    events_.on_sample({disposed ? transport::SampleKind::disposed : transport::SampleKind::no_writers,
                       std::move(*key_payload), writer});
  }
}

transport::Guid CycloneReader::writer_of(dds_entity_t reader, dds_instance_handle_t publication) {
  if (const auto known = writers_.find(publication)) return *known;
  auto* endpoint = dds_get_matched_publication_data(reader, publication);
  if (!endpoint) return {};
  const transport::Guid guid = to_guid(endpoint->key);
  dds_builtintopic_free_endpoint(endpoint);
  writers_.met(publication, guid);
  return guid;
}

// The vendor names no writer for a match that it reports while the reader is still being created.
void CycloneReader::look_up_early_matches() {
  std::vector<dds_instance_handle_t> writers(16);
  dds_return_t count = 0;
  while ((count = dds_get_matched_publications(reader_, writers.data(), writers.size())) >
         static_cast<dds_return_t>(writers.size())) {
    writers.resize(static_cast<std::size_t>(count));
  }
  for (dds_return_t i = 0; i < count; ++i) begin_with(reader_, writers[static_cast<std::size_t>(i)]);
}

void CycloneReader::begin_with(dds_entity_t reader, dds_instance_handle_t publication) {
  transport::Guid writer;
  {
    const std::lock_guard lock(mutex_);
    writer = writer_of(reader, publication);
  }
  if (events_.on_writer && writer != transport::Guid{}) events_.on_writer(writer);
  // Without our lock: the vendor holds the writer's while it delivers to take_all().
  if (reliable_volatile_) roci_keep_what_precedes_first_heartbeat(&type_, writer.data());
}

void CycloneReader::on_matched(dds_entity_t entity, dds_subscription_matched_status_t status, void* self) {
  auto& reader = *static_cast<CycloneReader*>(self);
  if (status.current_count_change > 0) reader.begin_with(entity, status.last_publication_handle);
  const std::lock_guard lock(reader.mutex_);
  if (status.current_count_change < 0) reader.writers_.left(status.last_publication_handle);
  reader.matched_ = static_cast<int>(status.current_count);
  if (reader.events_.on_matched) reader.events_.on_matched(reader.matched_);
}

}  // namespace roci::services::vendors::cyclonedds
