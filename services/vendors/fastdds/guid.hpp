// This file translates Fast DDS's GUIDs.
#pragma once

#include <fastdds/rtps/common/Guid.h>

#include <algorithm>

#include "services/transport/transport.hpp"

namespace roci::services::vendors::fastdds {

inline transport::Guid to_guid(const eprosima::fastrtps::rtps::GUID_t& theirs) {
  transport::Guid guid;
  std::copy_n(theirs.guidPrefix.value, 12, guid.begin());
  std::copy_n(theirs.entityId.value, 4, guid.begin() + 12);
  return guid;
}

}  // namespace roci::services::vendors::fastdds
