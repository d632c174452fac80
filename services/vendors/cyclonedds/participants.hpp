// The participants that Cyclone DDS has discovered, with what they announce: its built-in topic DCPSParticipant.
#pragma once

extern "C" {
#include <dds/dds.h>
}

#include <mutex>
#include <optional>

#include "services/vendors/participant_table.hpp"

namespace roci::services::vendors::cyclonedds {

/// Any thread may ask.
class Participants {
 public:
  explicit Participants(dds_entity_t participant);
  ~Participants();
  Participants(const Participants&) = delete;
  Participants& operator=(const Participants&) = delete;

  /// Reads what is new in the built-in topic when it does not know the participant yet: the vendor writes that before
  /// it makes the endpoints of the participant known.
  std::optional<transport::Participant> find(const transport::Guid&);

 private:
  void take_new();

  std::mutex mutex_;
  dds_entity_t reader_;
  ParticipantTable table_;
};

}  // namespace roci::services::vendors::cyclonedds
