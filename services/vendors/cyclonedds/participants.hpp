// Cyclone DDS tells of the participants that it has discovered, and of what they announce, by its built-in topic
// DCPSParticipant.
#pragma once

extern "C" {
#include <dds/dds.h>
}

#include <mutex>
#include <optional>

#include "services/vendors/participant_table.hpp"

namespace roci::services::vendors::cyclonedds {

/// Finds discovered participants; any thread may ask.
class Participants {
 public:
  explicit Participants(dds_entity_t participant);
  ~Participants();
  Participants(const Participants&) = delete;
  Participants& operator=(const Participants&) = delete;

  /// Finds a participant. One that is not known yet is looked for in the built-in topic, which the vendor writes
  /// before it makes the endpoints of the participant known.
  std::optional<transport::Participant> find(const transport::Guid&);

 private:
  void take_new();

  std::mutex mutex_;
  dds_entity_t reader_;
  ParticipantTable table_;
};

}  // namespace roci::services::vendors::cyclonedds
