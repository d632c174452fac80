#include "services/vendors/cyclonedds/participants.hpp"

#include <array>

#include "services/vendors/cyclonedds/qos.hpp"

namespace roci::services::vendors::cyclonedds {
namespace {

std::string user_data_of(const dds_qos_t* qos) {
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos, &data, &size) || data == nullptr) return {};
  std::string text(static_cast<const char*>(data), size);
  dds_free(data);
  return text;
}

std::string name_of(const dds_qos_t* qos) {
  char* name = nullptr;
  if (!dds_qget_entity_name(qos, &name) || name == nullptr) return {};
  std::string text(name);
  dds_free(name);
  return text;
}

}  // namespace

Participants::Participants(dds_entity_t participant)
    : reader_(checked(dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr),
                      "a reader of its participants")) {}

Participants::~Participants() { dds_delete(reader_); }

std::optional<transport::Participant> Participants::find(const transport::Guid& guid) {
  auto known = table_.find(guid);
  if (known) return known;
  take_new();
  return table_.find(guid);
}

void Participants::take_new() {
  constexpr std::size_t kBatch = 16;
  const std::lock_guard lock(mutex_);
  for (;;) {
    std::array<void*, kBatch> samples{};
    std::array<dds_sample_info_t, kBatch> infos;
    const dds_return_t count = dds_take(reader_, samples.data(), infos.data(), kBatch, kBatch);
    if (count <= 0) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (!infos[i].valid_data) continue;
      const auto& participant = *static_cast<const dds_builtintopic_participant_t*>(samples[i]);
      table_.add(to_guid(participant.key), {name_of(participant.qos), user_data_of(participant.qos)});
    }
    dds_return_loan(reader_, samples.data(), count);
  }
}

}  // namespace roci::services::vendors::cyclonedds
