#include "services/vendors/guard/partings.hpp"

#include <algorithm>
#include <utility>

namespace roci::services::vendors::guard {

bool Partings::announced(Announcement news, Time now) {
  std::erase_if(silent_since_, [&](const auto& silence) { return now - silence.second >= kSilence; });
  std::erase_if(reached_at_, [&](const auto& other) {
    const auto& [prefix, places] = other;
    const bool replaced =
        prefix != news.prefix && std::ranges::find_first_of(places, news.reached_at) != places.end();
    if (!replaced) return false;
    answered_.erase(prefix);
    given_up_.erase(prefix);
    silent_since_.erase(prefix);
    return true;
  });
  const auto since = given_up_.find(news.prefix);
  const bool parted = since != given_up_.end() && now - since->second >= kGrace;
  if (parted) {
    given_up_.erase(since);
    silent_since_[news.prefix] = now;
  }
  if (reached_at_.size() < kParticipants || reached_at_.contains(news.prefix))
    reached_at_[news.prefix] = std::move(news.reached_at);
  return parted;
}

void Partings::sent(std::span<const std::uint8_t> message, Time now) {
  for (const HandshakePart& part : handshakes_in(message)) {
    if (part.begins) {
      if (answered_.erase(part.with) > 0) gave_up(part.with, now);
      continue;
    }
    given_up_.erase(part.with);
    if (answered_.size() < kParticipants) answered_.insert(part.with);
  }
}

void Partings::gave_up(const GuidPrefix& other, Time now) {
  if (reached_at_.contains(other)) given_up_[other] = now;
}

bool Partings::any_silence(Time now) const {
  return std::ranges::any_of(silent_since_,
                             [&](const auto& silence) { return now - silence.second < kSilence; });
}

bool Partings::is_deaf_to(const GuidPrefix& other, Time now) const {
  const auto since = silent_since_.find(other);
  return since != silent_since_.end() && now - since->second < kSilence;
}

bool Partings::keeps_back(const Source& destination, Time now) const {
  return std::ranges::any_of(silent_since_, [&](const auto& silence) {
    if (now - silence.second >= kSilence) return false;
    const auto places = reached_at_.find(silence.first);
    return places != reached_at_.end() &&
           std::ranges::find(places->second, destination) != places->second.end();
  });
}

}  // namespace roci::services::vendors::guard
