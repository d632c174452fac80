#include "services/owner/commander_leases.hpp"

#include <algorithm>

#include "services/owner/command.hpp"

namespace roci::services::owner {

LeaseGrant CommanderLeases::ask(const LeaseAsk& ask, std::uint64_t newest_epoch, Moment now) {
  const LeaseGrant held = grant(ask.commander, now);
  const bool holds = !held.member.empty() && held.member == ask.member;
  // A process that was replaced may be heard late.
  const bool outdated = holds && (ask.said < held.echo || ask.epoch < held.epoch);
  if (outdated || (!held.member.empty() && !holds)) return held;
  const std::uint64_t newest = std::max(newest_epoch, newest_led(ask.commander));
  if (ask.epoch > newest && ask.epoch - newest > kEpochJump) return held;
  if (!ask.wanted || ask.member.empty() || ask.epoch < newest) {
    leases_.erase(ask.commander);
    return {};
  }
  if (!makes_room(ask, now)) return {};
  const Moment term = std::clamp(ask.term, Moment{0}, kLongestTerm);
  leases_[ask.commander] = {{ask.member, ask.epoch, term, ask.said}, now + term};
  if (ask.leads) newest_led_[ask.commander] = {ask.epoch, now};
  return leases_[ask.commander].grant;
}

bool CommanderLeases::makes_room(const LeaseAsk& ask, Moment now) {
  if (!leases_.contains(ask.commander) && leases_.size() >= kCommanders) {
    std::erase_if(leases_, [now](const auto& lease) { return lease.second.until <= now; });
    if (leases_.size() >= kCommanders) return false;
  }
  if (!ask.leads || newest_led_.contains(ask.commander) || newest_led_.size() < kCommanders) return true;
  auto oldest = newest_led_.end();
  for (auto each = newest_led_.begin(); each != newest_led_.end(); ++each)
    if (grant(each->first, now).member.empty() &&
        (oldest == newest_led_.end() || each->second.asked < oldest->second.asked))
      oldest = each;
  if (oldest == newest_led_.end()) return false;
  newest_led_.erase(oldest);
  return true;
}

std::uint64_t CommanderLeases::newest_led(const std::string& commander) const {
  const auto known = newest_led_.find(commander);
  return known == newest_led_.end() ? 0 : known->second.epoch;
}

bool CommanderLeases::admits(const std::string& commander, std::uint64_t epoch, Moment now) {
  const LeaseGrant held = grant(commander, now);
  if (held.member.empty()) return true;
  if (held.epoch != epoch) return false;
  leases_[commander].until = now + held.term;
  return true;
}

LeaseGrant CommanderLeases::grant(const std::string& commander, Moment now) const {
  const auto lease = leases_.find(commander);
  return lease == leases_.end() || lease->second.until <= now ? LeaseGrant{} : lease->second.grant;
}

}  // namespace roci::services::owner
