#include "services/vendors/guard/identities.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

namespace roci::services::vendors::guard {

// A prefix of ours from another port than it names. Those that come of a certificate begin with a bit 1.
bool Identities::is_borrowed(const GuidPrefix& prefix, const Source& source) const {
  if (secure_) return prefix[0] < 0x80 || prefix[6] != source.port >> 8 || prefix[7] != (source.port & 0xff);
  const auto own = prefix_start(source.port);
  return std::equal(own.begin(), own.begin() + 2, prefix.begin()) &&
         !std::equal(own.begin(), own.end(), prefix.begin());
}

std::array<std::uint8_t, 4> prefix_start(std::uint16_t port) {
  return {'R', 'o', static_cast<std::uint8_t>(port >> 8), static_cast<std::uint8_t>(port)};
}

std::size_t Identities::HashPrefix::operator()(const GuidPrefix& prefix) const {
  return std::hash<std::string_view>()({reinterpret_cast<const char*>(prefix.data()), prefix.size()});
}

DatagramAdmission Identities::claim(const GuidPrefix& prefix, const Source& source, Time now) {
  if (is_borrowed(prefix, source)) return DatagramAdmission::taken_identity;
  const auto known = owners_.find(prefix);
  if (known != owners_.end()) {
    if (known->second.source != source) return DatagramAdmission::taken_identity;
    known->second.heard = now;
    return DatagramAdmission::pass;
  }
  if (!make_room(source, now)) return DatagramAdmission::crowd;
  owners_.emplace(prefix, Owner{source, now});
  ++of_source_[source];
  ++of_address_[source.address];
  return DatagramAdmission::pass;
}

bool Identities::make_room(const Source& source, Time now) {
  const auto full = [&] {
    const auto same = of_source_.find(source);
    const auto host = of_address_.find(source.address);
    return (same != of_source_.end() && same->second >= kPerSource) ||
           (host != of_address_.end() && host->second >= kPerAddress);
  };
  if (!full()) return true;
  forget_silent(source.address, now);
  return !full();
}

bool Identities::announce(const GuidPrefix& prefix, const std::vector<EndpointWord>& words, Time now) {
  if (words.empty()) return true;
  Owner& owner = owners_.at(prefix);
  for (const EndpointWord& word : words) {
    std::int64_t& newest = owner.newest[word.writer];
    const bool new_word = word.number > newest;
    newest = std::max(newest, word.number);
    if (!word.ended) {
      if (!add_endpoint(owner, word, now)) return false;
    } else if (new_word && owner.endpoints.erase(word.guid) > 0) {
      --endpoints_of_address_[owner.source.address];
    }
  }
  return true;
}

bool Identities::add_endpoint(Owner& owner, const EndpointWord& word, Time now) {
  if (owner.endpoints.contains(word.guid)) return true;
  if (owner.endpoints.size() >= kEndpoints) return false;
  std::size_t& together = endpoints_of_address_[owner.source.address];
  if (together >= kEndpointsPerAddress) forget_silent(owner.source.address, now);
  if (together >= kEndpointsPerAddress) return false;
  owner.endpoints.insert(word.guid);
  ++together;
  return true;
}

void Identities::forget_silent(std::uint32_t address, Time now) {
  std::vector<GuidPrefix> silent;
  for (const auto& [prefix, owner] : owners_)
    if (owner.source.address == address && now - owner.heard > kSilent) silent.push_back(prefix);
  for (const GuidPrefix& prefix : silent) forget(prefix);
}

void Identities::forget(const GuidPrefix& prefix) {
  const Source source = owners_.at(prefix).source;
  endpoints_of_address_[source.address] -= owners_.at(prefix).endpoints.size();
  owners_.erase(prefix);
  if (--of_source_[source] == 0) of_source_.erase(source);
  if (--of_address_[source.address] == 0) of_address_.erase(source.address);
}

}  // namespace roci::services::vendors::guard
