// Hears of the participants that Fast DDS discovers, and keeps what they announce.
#pragma once

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <memory>

#include "services/vendors/guard/guard.hpp"
#include "services/vendors/participant_table.hpp"

namespace roci::services::vendors::fastdds {

class Participants : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  /// `guard` is told of who is given up.
  explicit Participants(std::shared_ptr<guard::Guard> guard) : guard_(std::move(guard)) {}
  ParticipantTable table;

 private:
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant*,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&&) override;

  const std::shared_ptr<guard::Guard> guard_;
};

}  // namespace roci::services::vendors::fastdds
