#include "services/vendors/fastdds/participants.hpp"

#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>

#include <algorithm>

#include "services/vendors/fastdds/guid.hpp"

namespace roci::services::vendors::fastdds {

using eprosima::fastrtps::rtps::ParticipantDiscoveryInfo;

// A participant is announced before its endpoints are, on the same thread, so that it is known before its first sample.
void Participants::on_participant_discovery(eprosima::fastdds::dds::DomainParticipant*,
                                            ParticipantDiscoveryInfo&& found) {
  if (found.status == ParticipantDiscoveryInfo::DROPPED_PARTICIPANT) {
    guard::GuidPrefix prefix;
    std::copy_n(found.info.m_guid.guidPrefix.value, prefix.size(), prefix.begin());
    guard_->gave_up(prefix);
  }
  if (found.status != ParticipantDiscoveryInfo::DISCOVERED_PARTICIPANT &&
      found.status != ParticipantDiscoveryInfo::CHANGED_QOS_PARTICIPANT) {
    return;
  }
  const auto& data = found.info.m_userData.data_vec();
  table.add(to_guid(found.info.m_guid),
            {found.info.m_participantName.to_string(), std::string(data.begin(), data.end())});
}

}  // namespace roci::services::vendors::fastdds
