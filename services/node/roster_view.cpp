#include "services/node/roster_view.hpp"

#include <algorithm>

namespace roci::services::node {
namespace {

std::string cause_of(const v1::ClockStep& step, const std::string& service, std::uint32_t incarnation) {
  for (const v1::RosterLoss& loss : step.losses()) {
    if (loss.service() == service && loss.incarnation() == incarnation) return loss.cause();
  }
  return "left";
}

}  // namespace

bool contains(const std::vector<v1::RosterEntry>& roster, std::string_view service,
              std::uint32_t incarnation) {
  return std::ranges::any_of(roster, [&](const v1::RosterEntry& entry) {
    return entry.service() == service && entry.incarnation() == incarnation;
  });
}

std::vector<health::PeerChange> RosterView::update(const v1::ClockStep& step, std::string_view self) {
  std::vector<health::PeerChange> changes;
  for (auto peer = alive_.begin(); peer != alive_.end();) {
    const auto& [service, incarnation] = *peer;
    if (contains(step.roster(), service, incarnation)) {
      ++peer;
      continue;
    }
    changes.push_back({service, incarnation, false, cause_of(step, service, incarnation)});
    peer = alive_.erase(peer);
  }
  for (const v1::RosterEntry& entry : step.roster()) {
    if (entry.service() == self || !alive_.emplace(entry.service(), entry.incarnation()).second) continue;
    changes.push_back({entry.service(), entry.incarnation(), true, ""});
  }
  known_ = true;
  return changes;
}

health::PeerState RosterView::state(std::string_view service) const {
  if (alive_.contains(service)) return health::PeerState::alive;
  return known_ ? health::PeerState::dead : health::PeerState::never_seen;
}

}  // namespace roci::services::node
