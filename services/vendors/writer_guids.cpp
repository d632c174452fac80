#include "services/vendors/writer_guids.hpp"

namespace roci::services::vendors {

std::optional<transport::Guid> WriterGuids::find(Handle writer) const {
  const auto known = guids_.find(writer);
  return known == guids_.end() ? std::nullopt : std::optional(known->second);
}

void WriterGuids::met(Handle writer, const transport::Guid& guid) {
  std::erase(departed_, writer);
  guids_.insert_or_assign(writer, guid);
}

void WriterGuids::left(Handle writer) {
  if (!guids_.contains(writer)) return;
  std::erase(departed_, writer);
  departed_.push_back(writer);
  if (departed_.size() <= kDeparted) return;
  guids_.erase(departed_.front());
  departed_.pop_front();
}

}  // namespace roci::services::vendors
