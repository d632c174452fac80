#include "services/vendors/guard/identities.hpp"

#include <string_view>
#include <vector>

namespace roci::services::vendors::guard {

std::size_t Identities::HashPrefix::operator()(const GuidPrefix& prefix) const {
  return std::hash<std::string_view>()({reinterpret_cast<const char*>(prefix.data()), prefix.size()});
}

Verdict Identities::claim(const GuidPrefix& prefix, const Source& source, Time now) {
  const auto known = owners_.find(prefix);
  if (known != owners_.end()) {
    if (known->second.source != source) return Verdict::taken_identity;
    known->second.heard = now;
    return Verdict::pass;
  }
  if (!make_room(source, now)) return Verdict::crowd;
  owners_.emplace(prefix, Owner{source, now});
  ++of_source_[source];
  ++of_address_[source.address];
  return Verdict::pass;
}

bool Identities::make_room(const Source& source, Time now) {
  const auto full = [&] {
    const auto same = of_source_.find(source);
    const auto host = of_address_.find(source.address);
    return (same != of_source_.end() && same->second >= kPerSource) ||
           (host != of_address_.end() && host->second >= kPerAddress);
  };
  if (!full()) return true;
  std::vector<GuidPrefix> silent;
  for (const auto& [prefix, owner] : owners_)
    if (owner.source.address == source.address && now - owner.heard > kSilent) silent.push_back(prefix);
  for (const GuidPrefix& prefix : silent) forget(prefix);
  return !full();
}

void Identities::forget(const GuidPrefix& prefix) {
  const Source source = owners_.at(prefix).source;
  owners_.erase(prefix);
  if (--of_source_[source] == 0) of_source_.erase(source);
  if (--of_address_[source.address] == 0) of_address_.erase(source.address);
}

}  // namespace roci::services::vendors::guard
