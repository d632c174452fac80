#include "exec_svc/standby/replication.hpp"

#include <algorithm>

namespace roci::exec::standby {

using journal::Position;

void Replication::begin() {
  most_ = {};
  state_ = State::alone;
}

void Replication::hear(const Position& has, std::uint64_t epoch) {
  if (has.epoch <= epoch) most_ = std::max(most_, has);
}

void Replication::note_progress(const Peer& peer, std::uint64_t epoch, const Position& newest, Moment now) {
  const bool behind = !peer.has(newest, epoch);
  const Position has = peer.newest() != nullptr ? peer.newest()->has : Position{};
  if (behind && (!behind_ || has != progress_)) behind_since_ = now;
  behind_ = behind;
  progress_ = has;
}

Replication::Event Replication::update(const Peer& peer, std::uint64_t epoch, const Position& newest,
                                       Moment now) {
  const bool stuck = !peer.heard_lately(now) || (behind_ && now - behind_since_ > settings_.progress_timeout);
  switch (state_) {
    case State::alone:
      if (!stuck && peer.is_near(newest, epoch)) {
        state_ = State::catching_up;
        joined_at_ = newest;
      }
      return Event::none;
    case State::catching_up:
      if (stuck) {
        state_ = State::alone;
      } else if (peer.has(joined_at_, epoch)) {
        state_ = State::paired;
        return Event::paired;
      }
      return Event::none;
    case State::paired:
      if (!stuck) return Event::none;
      state_ = State::revoking;
      return Event::revoking;
    case State::revoking:
      if (!stuck && !expired(now) && peer.has(newest, epoch)) {
        state_ = State::paired;
        return Event::paired;
      }
      if (now - entitled_at_ < settings_.term + settings_.takeover_window) return Event::none;
      state_ = State::alone;
      return Event::alone;
  }
  return Event::none;
}

void Replication::renew(Moment now) {
  if (paired()) entitled_at_ = now;
}

bool Replication::may_send(const Peer& peer, std::uint64_t epoch, const Position& decided, Moment now) const {
  switch (state_) {
    case State::alone:
      return true;
    case State::catching_up:
      return peer.has(decided, epoch);
    case State::paired:
      return !expired(now) && peer.has(decided, epoch);
    case State::revoking:
      return false;
  }
  return false;
}

}  // namespace roci::exec::standby
