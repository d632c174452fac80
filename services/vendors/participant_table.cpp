#include "services/vendors/participant_table.hpp"

#include <algorithm>
#include <utility>

namespace roci::services::vendors {

ParticipantTable::Prefix ParticipantTable::prefix_of(const transport::Guid& guid) {
  Prefix prefix;
  std::copy_n(guid.begin(), prefix.size(), prefix.begin());
  return prefix;
}

void ParticipantTable::add(const transport::Guid& guid, transport::Participant participant) {
  const Prefix prefix = prefix_of(guid);
  const std::lock_guard lock(mutex_);
  if (known_.insert_or_assign(prefix, std::move(participant)).second) met_.push_back(prefix);
  if (met_.size() <= kKnownParticipants) return;
  known_.erase(met_.front());
  met_.pop_front();
}

std::optional<transport::Participant> ParticipantTable::find(const transport::Guid& guid) const {
  const std::lock_guard lock(mutex_);
  const auto found = known_.find(prefix_of(guid));
  return found == known_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace roci::services::vendors
