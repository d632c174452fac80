// Hears of the participants that Fast DDS discovers, and keeps what they announce.
#pragma once

#include <fastdds/dds/domain/DomainParticipantListener.hpp>

#include "services/vendors/participant_table.hpp"

namespace roci::services::vendors::fastdds {

class Participants : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  ParticipantTable table;

 private:
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant*,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&&) override;
};

}  // namespace roci::services::vendors::fastdds
