#include "exec_svc/standby/lease.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::standby {

using journal::Position;

namespace {

std::string milliseconds_text(Moment time) {
  return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(time).count()) + " ms";
}

}  // namespace

Lease::Lease(Member self, const LeaseSettings& settings, const PersistedTerm& persisted_term, bool superseded,
             Moment now, std::set<std::string> owners)
    : self_(self),
      settings_(settings),
      epochs_(self, persisted_term),
      peer_(now, settings.term),
      spoke_at_(now - settings.renewal),
      owner_leases_(self, std::move(owners), settings.term),
      request_{self, 0, false, false, settings.owner_term, Moment{0}},
      right_(superseded, settings, now),
      replication_(settings) {}

void Lease::hear(const LeaseMessage& message, Moment now) {
  if (message.member == self_ || !epochs_.believable(message.epoch)) return;
  peer_.hear(message, now);
  if (message.role != Role::leading) {
    replication_.hear(message.has, epochs_.own());
    if (epochs_.note(message.epoch)) right_.lapse();
    return;
  }
  hear_leader(message.epoch, now);
  note_led(message.epoch);
  if (role_ == Role::leading || message.epoch < epochs_.highest()) return;
  right_.hear(message, peer_.sent_since(), now);
}

void Lease::hear_leader(std::uint64_t epoch, Moment now) {
  if (!epochs_.believable(epoch)) return;
  if (epochs_.note(epoch)) right_.lapse();
  if (role_ == Role::following && epoch == epochs_.highest()) right_.hear_leader(now);
}

void Lease::hear(const LeaseReport& report, Moment now) {
  owner_leases_.hear(report, now);
  note_led(report.newest_epoch);
  // Somebody has commanded in a later epoch, and this member has not heard of it.
  if (epochs_.note_of_owner(report.newest_epoch)) right_.lapse();
}

void Lease::refused(std::uint64_t epoch) {
  epochs_.refuse();
  if (epochs_.note_of_owner(epoch)) right_.lapse();
}

void Lease::note_led(std::uint64_t epoch) {
  if (epochs_.note_led(epoch)) right_.lapse();
}

Lease::Turn Lease::turn(const Position& newest, Moment now) {
  Turn out = role_ == Role::following ? follow(newest, now) : keep_leading(newest, now);
  if (out.change == Change::stand_down) return out;
  const bool wanted_before = request_.wanted;
  if (role_ == Role::leading) ask_owners(true, newest, now);
  out.speak = out.speak || out.change != Change::none || now - spoke_at_ >= settings_.renewal ||
              request_.wanted != wanted_before;
  if (!out.speak) return out;
  spoke_at_ = now;
  request_.said = now;
  replication_.renew(now);
  return out;
}

std::uint64_t Lease::epoch_to_lead(const Position& newest, Moment now) const {
  return epochs_.next(newest == Position{} && epochs_.highest() > 0 && !epochs_.persisted().alone &&
                      !right_.holds(newest, now));
}

void Lease::ask_owners(bool wanted, const Position& newest, Moment now) {
  const std::uint64_t epoch = role_ == Role::leading ? epochs_.own() : epoch_to_lead(newest, now);
  request_.epoch = epoch;
  request_.leads = role_ == Role::leading;
  request_.wanted = owner_leases_.wants(wanted ? std::optional(epoch) : std::nullopt, now);
}

Lease::Turn Lease::follow(const Position& newest, Moment now) {
  const auto claimed = claim(newest, now);
  const bool wanted_before = request_.wanted;
  // It asks early, so that the way to the owners takes nothing of the time in which its right holds.
  const bool soon = right_.holds(newest, now) && right_.leaderless_for(now) >= settings_.owner_term;
  // A lease that a living leader lacks for a moment, and that its follower is granted meanwhile, would keep both
  // from commanding.
  const bool leader_lives = owner_leases_.other_renews(kRenewalsSeen * settings_.renewal, now);
  ask_owners(!leader_lives && (claimed ? !claimed->agreed : soon), newest, now);
  Turn out;
  out.speak = request_.wanted != wanted_before;
  if (!claimed) return out;
  if (!claimed->agreed && !owner_leases_.holds_all(request_.epoch, now)) {
    out.reason = claimed->reason;
    out.doubtful = claimed->doubtful;
    out.lacks = owner_leases_.missing(request_.epoch, now);
    return out;
  }
  return lead(*claimed, newest, now);
}

std::optional<Lease::Claim> Lease::claim(const Position& newest, Moment now) const {
  const LeaseMessage* const other = peer_.newest();
  const bool other_follows = peer_.follows_lately(now);
  const auto is_new = [](std::uint64_t epoch, const Position& has) {
    return epoch == 0 && has == Position{};
  };
  if (self_ == Member::first && other_follows && is_new(epochs_.highest(), newest) &&
      is_new(other->epoch, other->has))
    return Claim{"both are new", true};
  const Moment waited = right_.leaderless_for(now);
  if (waited < settings_.term) return std::nullopt;
  if (right_.holds(newest, now))
    return Claim{"the leader of epoch " + std::to_string(epochs_.highest()) + " was not heard for " +
                 milliseconds_text(waited)};
  if (epochs_.persisted().alone) return Claim{"it led alone before", other_follows};
  if (other_follows) {
    const auto since = peer_.sent_since();
    const bool open = !other->entitled && other->searching && since && now - *since < settings_.term;
    if (open && wins(*other, newest)) return Claim{"of both it has the longer journal", true};
  }
  if (right_.forbidden() || peer_.heard_lately(now) || waited < settings_.solo_timeout) return std::nullopt;
  return Claim{"it heard nobody for " + milliseconds_text(waited), false, true};
}

bool Lease::wins(const LeaseMessage& other, const Position& newest) const {
  return newest > other.has || (newest == other.has && self_ == Member::first);
}

Lease::Turn Lease::lead(const Claim& claim, const Position& newest, Moment now) {
  const bool doubtful = epochs_.lead(epoch_to_lead(newest, now), newest, claim.doubtful);
  role_ = Role::leading;
  replication_.begin();
  return {Change::lead, claim.reason, doubtful, true};
}

Lease::Turn Lease::keep_leading(const Position& newest, Moment now) {
  if (epochs_.unknown() != 0)
    return {Change::stand_down, "another led in epoch " + std::to_string(epochs_.unknown()) +
                                    ", which this journal does not hold"};
  if (epochs_.highest() > epochs_.own())
    return {Change::stand_down, "epoch " + std::to_string(epochs_.highest()) + " has a leader"};
  if (epochs_.refused()) {
    epochs_.set_alone(false);
    return {Change::stand_down, "an owner obeys a later epoch"};
  }
  // This holds for a lone leader, too: to others it was dead meanwhile, so it joins them anew.
  if (std::exchange(settled_, true) && now - spoke_at_ >= settings_.term) {
    return {Change::stand_down,
            "it stood still for " + milliseconds_text(now - spoke_at_) + ", longer than its lease"};
  }
  replication_.note_progress(peer_, epochs_.own(), newest, now);
  if (owner_leases_.holds_all(epochs_.own(), now)) {
    unleased_since_.reset();
  } else if (!unleased_since_) {
    unleased_since_ = now;
  }
  if (should_hand_over(now)) {
    return {Change::stand_down, "it lacks the leases of " + owner_leases_.missing(epochs_.own(), now) +
                                    ", and the other hears all owners"};
  }
  return update_replication(newest, now);
}

// The other has the whole journal, has a right to lead from it, and hears every owner;
// so it takes over a term from now.
bool Lease::should_hand_over(Moment now) const {
  return replication_.paired() && unleased_since_ && now - *unleased_since_ >= settings_.term &&
         peer_.follows_lately(now) && peer_.newest()->entitled;
}

Lease::Turn Lease::update_replication(const Position& newest, Moment now) {
  switch (replication_.update(peer_, epochs_.own(), newest, now)) {
    case Replication::Event::none:
      return {};
    case Replication::Event::paired:
      epochs_.set_alone(false);
      return {Change::paired, "the other has the whole journal", false, true};
    case Replication::Event::revoking:
      return {Change::none, "", false, true};
    case Replication::Event::alone:
      epochs_.set_alone(true);
      return {Change::alone, "the other gave no receipt in time", false, true};
  }
  return {};
}

bool Lease::may_send(const Position& decided, Moment now) const {
  return role_ == Role::leading && !epochs_.is_over() &&
         replication_.may_send(peer_, epochs_.own(), decided, now);
}

bool Lease::may_command(Moment now) const {
  return role_ == Role::leading && !epochs_.is_over() && owner_leases_.holds_all(epochs_.own(), now);
}

LeaseMessage Lease::message(const Position& newest) const {
  const bool leads = role_ == Role::leading;
  LeaseMessage out;
  out.member = self_;
  out.role = role_;
  out.epoch = leads ? epochs_.own() : epochs_.highest();
  out.has = newest;
  out.entitled =
      leads ? replication_.paired()
            : (right_.holds(newest, spoke_at_) && owner_leases_.hears_all(settings_.term, spoke_at_)) ||
                  epochs_.persisted().alone;
  out.said = spoke_at_;
  if (const LeaseMessage* const other = peer_.newest(); other != nullptr) {
    out.receipt = leads ? replication_.receipt() : other->has;
    out.echo = other->said;
  }
  out.searching = !leads && right_.leaderless_for(spoke_at_) >= settings_.term;
  return out;
}

}  // namespace roci::exec::standby
