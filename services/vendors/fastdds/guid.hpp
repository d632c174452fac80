#pragma once

#include <fastdds/rtps/common/Guid.h>

#include <algorithm>

#include "services/transport.hpp"

namespace roci::services::fastdds {

inline Guid to_guid(const eprosima::fastrtps::rtps::GUID_t& theirs) {
  Guid guid;
  std::copy_n(theirs.guidPrefix.value, 12, guid.begin());
  std::copy_n(theirs.entityId.value, 4, guid.begin() + 12);
  return guid;
}

}  // namespace roci::services::fastdds
