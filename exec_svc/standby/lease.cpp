#include "exec_svc/standby/lease.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::standby {

using journal::Position;

namespace {

// Exceeds the epochs in which a member that lost its journal may have led without anybody to tell it.
constexpr std::uint64_t kUntoldEpochs = 100;
constexpr int kRenewalsSeen = 3;     // may pass before a leader counts as one that does not renew
constexpr std::uint64_t kNear = 64;  // batches; so close a follower is waited for

// The first member leads in odd epochs, the second in even ones.
bool is_own(Member self, std::uint64_t epoch) { return (epoch % 2 == 1) == (self == Member::first); }

// Returns the next epoch after `highest` of a member's own.
std::uint64_t next_epoch(Member self, std::uint64_t highest) {
  return is_own(self, highest + 1) ? highest + 1 : highest + 2;
}

std::string milliseconds_text(Moment time) {
  return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(time).count()) + " ms";
}

}  // namespace

Lease::Lease(Member self, const LeaseSettings& settings, const PersistedTerm& persisted_term, bool superseded,
             Moment now, std::set<std::string> owners)
    : self_(self),
      settings_(settings),
      persisted_term_(persisted_term),
      spoke_at_(now - settings.renewal),
      owner_leases_(self, std::move(owners), settings.term),
      request_{self, 0, false, false, settings.owner_term, Moment{0}},
      takeover_forbidden_(superseded),
      leaderless_since_(now),
      started_(now) {}

void Lease::hear(const LeaseMessage& message, Moment now) {
  if (message.member == self_ || !believable(message.epoch)) return;
  other_ = Heard{message, now};
  if (message.role != Role::leading) {
    if (message.has.epoch <= own_epoch_) most_ = std::max(most_, message.has);
    return note_epoch(message.epoch);
  }
  hear_leader(message.epoch, now);
  note_led(message.epoch);
  if (role_ == Role::leading || message.epoch < persisted_term_.epoch) return;
  const auto since = sent_since();
  entitled_ = message.entitled && since;
  takeover_forbidden_ = !message.entitled;
  receipt_ = message.receipt;
  entitled_since_ = since.value_or(now);
}

void Lease::hear_leader(std::uint64_t epoch, Moment now) {
  if (!believable(epoch)) return;
  note_epoch(epoch);
  if (role_ == Role::following && epoch == persisted_term_.epoch) leaderless_since_ = now;
}

void Lease::hear(const LeaseReport& report, Moment now) {
  owner_leases_.hear(report, now);
  note_led(report.newest_epoch);
  // Somebody has commanded in a later epoch, and this member has not heard of it.
  note_epoch(std::min(report.newest_epoch, persisted_term_.epoch + kEpochJump));
}

bool Lease::believable(std::uint64_t epoch) const {
  const std::uint64_t known = persisted_term_.epoch;
  return known == 0 || epoch <= known || epoch - known <= kEpochJump;
}

void Lease::refused(std::uint64_t epoch) {
  refused_ = true;
  const std::uint64_t known = persisted_term_.epoch;
  note_epoch(std::min(epoch, known + kEpochJump));
}

void Lease::note_led(std::uint64_t epoch) {
  if (is_own(self_, epoch)) return;
  if (role_ == Role::following) {
    told_epoch_ = std::max(told_epoch_, epoch);
  } else if (epoch < own_epoch_ && epoch > persisted_term_.holds) {
    unknown_epoch_ = epoch;
    note_epoch(own_epoch_ + 1);  // so it is in doubt when it leads the next time
  }
}

void Lease::note_epoch(std::uint64_t epoch) {
  if (epoch <= persisted_term_.epoch) return;
  persisted_term_ = {epoch, false, persisted_term_.holds};
  entitled_ = false;
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
  if (replication_ == ReplicationState::paired) entitled_at_ = now;
  return out;
}

std::uint64_t Lease::epoch_to_lead(const Position& newest, Moment now) const {
  const bool has_lost_all = newest == Position{} && persisted_term_.epoch > 0 && !persisted_term_.alone &&
                            !right_holds(newest, now);
  return next_epoch(self_, persisted_term_.epoch + (has_lost_all ? kUntoldEpochs : 0));
}

void Lease::ask_owners(bool wanted, const Position& newest, Moment now) {
  const std::uint64_t epoch = role_ == Role::leading ? own_epoch_ : epoch_to_lead(newest, now);
  request_.epoch = epoch;
  request_.leads = role_ == Role::leading;
  request_.wanted = owner_leases_.wants(wanted ? std::optional(epoch) : std::nullopt, now);
}

Lease::Turn Lease::follow(const Position& newest, Moment now) {
  const auto claimed = claim(newest, now);
  const bool wanted_before = request_.wanted;
  // It asks early, so that the way to the owners takes nothing of the time in which its right holds.
  const bool soon = right_holds(newest, now) && now - leaderless_since_ >= settings_.owner_term;
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
  const bool other_follows = heard_lately(now) && other_->message.role == Role::following;
  const auto is_new = [](std::uint64_t epoch, const Position& has) {
    return epoch == 0 && has == Position{};
  };
  if (self_ == Member::first && other_follows && is_new(persisted_term_.epoch, newest) &&
      is_new(other_->message.epoch, other_->message.has))
    return Claim{"both are new", true};
  const Moment waited = now - leaderless_since_;
  if (waited < settings_.term) return std::nullopt;
  if (right_holds(newest, now))
    return Claim{"the leader of epoch " + std::to_string(persisted_term_.epoch) + " was not heard for " +
                 milliseconds_text(waited)};
  if (persisted_term_.alone) return Claim{"it led alone before", other_follows};
  if (other_follows) {
    const auto since = sent_since();
    const bool open =
        !other_->message.entitled && other_->message.searching && since && now - *since < settings_.term;
    if (open && wins(other_->message, newest)) return Claim{"of both it has the longer journal", true};
  }
  if (takeover_forbidden_ || heard_lately(now) || waited < settings_.solo_timeout) return std::nullopt;
  return Claim{"it heard nobody for " + milliseconds_text(waited), false, true};
}

bool Lease::right_holds(const Position& newest, Moment now) const {
  return entitled_ && newest >= receipt_ &&
         now - entitled_since_ < settings_.term + settings_.takeover_window;
}

std::optional<Moment> Lease::sent_since() const {
  if (!other_ || other_->message.echo < started_ || other_->message.echo > other_->at) return std::nullopt;
  return other_->message.echo;
}

bool Lease::wins(const LeaseMessage& other, const Position& newest) const {
  return newest > other.has || (newest == other.has && self_ == Member::first);
}

Lease::Turn Lease::lead(const Claim& claim, const Position& newest, Moment now) {
  std::uint64_t holds = persisted_term_.holds;
  if (!is_own(self_, newest.epoch)) holds = std::max(holds, newest.epoch);
  // Somebody led in an epoch that this journal lacks, so what was done then is not known here.
  const bool lacks_epoch = persisted_term_.epoch > newest.epoch || told_epoch_ > holds;
  const bool doubtful = claim.doubtful || lacks_epoch;
  if (doubtful) holds = std::max({holds, told_epoch_, persisted_term_.epoch});
  role_ = Role::leading;
  own_epoch_ = epoch_to_lead(newest, now);
  persisted_term_ = {own_epoch_, true, holds};
  most_ = {};
  replication_ = ReplicationState::alone;
  replication_since_ = now;
  return {Change::lead, claim.reason, doubtful, true};
}

Lease::Turn Lease::keep_leading(const Position& newest, Moment now) {
  if (unknown_epoch_ != 0)
    return {Change::stand_down,
            "another led in epoch " + std::to_string(unknown_epoch_) + ", which this journal does not hold"};
  if (persisted_term_.epoch > own_epoch_)
    return {Change::stand_down, "epoch " + std::to_string(persisted_term_.epoch) + " has a leader"};
  if (refused_) {
    persisted_term_.alone = false;
    return {Change::stand_down, "an owner obeys a later epoch"};
  }
  // This holds for a lone leader, too: to others it was dead meanwhile, so it joins them anew.
  if (std::exchange(settled_, true) && now - spoke_at_ >= settings_.term) {
    return {Change::stand_down,
            "it stood still for " + milliseconds_text(now - spoke_at_) + ", longer than its lease"};
  }
  note_progress(newest, now);
  if (owner_leases_.holds_all(own_epoch_, now)) {
    unleased_since_.reset();
  } else if (!unleased_since_) {
    unleased_since_ = now;
  }
  if (should_hand_over(now)) {
    return {Change::stand_down, "it lacks the leases of " + owner_leases_.missing(own_epoch_, now) +
                                    ", and the other hears all owners"};
  }
  return update_replication(newest, now);
}

// The other has the whole journal, has a right to lead from it, and hears every owner;
// so it takes over a term from now.
bool Lease::should_hand_over(Moment now) const {
  return replication_ == ReplicationState::paired && unleased_since_ &&
         now - *unleased_since_ >= settings_.term && heard_lately(now) &&
         other_->message.role == Role::following && other_->message.entitled;
}

void Lease::note_progress(const Position& newest, Moment now) {
  const bool behind = !other_has(newest);
  const Position has = other_ ? other_->message.has : Position{};
  if (behind && (!behind_ || has != progress_)) behind_since_ = now;
  behind_ = behind;
  progress_ = has;
}

Lease::Turn Lease::update_replication(const Position& newest, Moment now) {
  const bool stuck = !heard_lately(now) || (behind_ && now - behind_since_ > settings_.progress_timeout);
  const auto become = [&](ReplicationState bond) {
    replication_ = bond;
    replication_since_ = now;
  };
  const auto pair = [&]() -> Turn {
    become(ReplicationState::paired);
    persisted_term_.alone = false;
    return {Change::paired, "the other has the whole journal", false, true};
  };
  switch (replication_) {
    case ReplicationState::alone:
      if (!stuck && other_is_near(newest)) {
        become(ReplicationState::catching_up);
        joined_at_ = newest;
      }
      return {};
    case ReplicationState::catching_up:
      if (stuck) become(ReplicationState::alone);
      if (!stuck && other_has(joined_at_)) return pair();
      return {};
    case ReplicationState::paired:
      if (!stuck) return {};
      become(ReplicationState::revoking);
      return {Change::none, "", false, true};
    case ReplicationState::revoking:
      if (!stuck && !expired(now) && other_has(newest)) return pair();
      if (now - entitled_at_ < settings_.term + settings_.takeover_window) return {};
      become(ReplicationState::alone);
      persisted_term_.alone = true;
      return {Change::alone, "the other gave no receipt in time", false, true};
  }
  return {};
}

bool Lease::other_has(const Position& position) const {
  if (!other_ || other_->message.role != Role::following) return false;
  const Position& has = other_->message.has;
  return has == position || (has.epoch == own_epoch_ && has.sequence >= position.sequence);
}

bool Lease::other_is_near(const Position& newest) const {
  if (other_has(newest)) return true;
  const Position& has = other_->message.has;
  return other_->message.role == Role::following && has.epoch == own_epoch_ &&
         newest.sequence - has.sequence <= kNear;
}

bool Lease::may_send(const Position& decided, Moment now) const {
  if (role_ != Role::leading || is_over()) return false;
  switch (replication_) {
    case ReplicationState::alone:
      return true;
    case ReplicationState::catching_up:
      return other_has(decided);
    case ReplicationState::paired:
      return !expired(now) && other_has(decided);
    case ReplicationState::revoking:
      return false;
  }
  return false;
}

bool Lease::may_command(Moment now) const {
  return role_ == Role::leading && !is_over() && owner_leases_.holds_all(own_epoch_, now);
}

LeaseMessage Lease::message(const Position& newest) const {
  LeaseMessage out;
  out.member = self_;
  out.role = role_;
  out.epoch = role_ == Role::leading ? own_epoch_ : persisted_term_.epoch;
  out.has = newest;
  out.entitled = role_ == Role::leading ? replication_ == ReplicationState::paired
                                        : (right_holds(newest, spoke_at_) &&
                                           owner_leases_.hears_all(settings_.term, spoke_at_)) ||
                                              persisted_term_.alone;
  out.said = spoke_at_;
  if (other_) {
    out.receipt = role_ == Role::leading ? most_ : other_->message.has;
    out.echo = other_->message.said;
  }
  out.searching = role_ == Role::following && spoke_at_ - leaderless_since_ >= settings_.term;
  return out;
}

}  // namespace roci::exec::standby
