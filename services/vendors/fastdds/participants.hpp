// Fast DDS tells of the participants that it discovers by a listener.
#pragma once

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <memory>

#include "services/vendors/guard/guard.hpp"
#include "services/vendors/participant_table.hpp"

namespace roci::services::vendors::fastdds {

/// Keeps what discovered participants announce.
class Participants : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  /// Tells `guard` of participants that the vendor gives up.
  explicit Participants(std::shared_ptr<guard::Guard> guard) : guard_(std::move(guard)) {}
  ParticipantTable table;

 private:
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant*,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&&) override;

  const std::shared_ptr<guard::Guard> guard_;
};

}  // namespace roci::services::vendors::fastdds
