// Replication is a leader's view of its follower's journal: whether what is decided must wait for the follower's
// receipt, and whether the follower may take over. It is pure.
#pragma once

#include <cstdint>

#include "exec_svc/journal/batch.hpp"
#include "exec_svc/standby/lease_message.hpp"
#include "exec_svc/standby/peer.hpp"

namespace roci::exec::standby {

/// Goes from alone over catching up to paired, and over revoking back to alone. Whenever an epoch is asked for, it is
/// the leader's own.
class Replication {
 public:
  /// Says what an update has brought about.
  enum class Event {
    none,
    paired,    ///< the follower has the whole journal and may take over
    revoking,  ///< the follower has to be told that it may not any more
    alone,     ///< its right must have ended by now
  };

  explicit Replication(const LeaseSettings& settings) : settings_(settings) {}

  /// Begins anew, alone, since this member begins to lead.
  void begin();
  /// Takes in how much of the journal the other member says that it has.
  void hear(const journal::Position& has, std::uint64_t epoch);
  /// Takes in how far the journal has come, and with it whether the follower makes progress.
  void note_progress(const Peer& peer, std::uint64_t epoch, const journal::Position& newest, Moment now);
  /// Goes on to the next state if it is time.
  Event update(const Peer& peer, std::uint64_t epoch, const journal::Position& newest, Moment now);
  /// Takes in that the leader says now that it leads, and while paired that the follower may take over.
  void renew(Moment now);

  bool paired() const { return state_ == State::paired; }
  /// Returns whether what was decided at this position of the journal may be sent.
  bool may_send(const Peer& peer, std::uint64_t epoch, const journal::Position& decided, Moment now) const;
  /// Returns the most that the follower was known to have since this member leads.
  const journal::Position& receipt() const { return most_; }

  template <class See>
  void show(See&& see, Moment now) const {
    see(state_, most_, behind_);
    if (behind_) see(progress_, std::min(now - behind_since_, settings_.progress_timeout + Moment(1)));
    if (state_ == State::catching_up) see(joined_at_);
    if (state_ == State::paired || state_ == State::revoking) see(now - entitled_at_);
  }

 private:
  /// One that is catching_up waits for receipts, as the follower is nearly there; one that is revoking has taken the
  /// follower's right back, which the follower may not know.
  enum class State { alone, catching_up, paired, revoking };

  bool expired(Moment now) const { return now - entitled_at_ >= settings_.term; }

  LeaseSettings settings_;
  State state_ = State::alone;
  Moment entitled_at_{0};   // when it was last said that the follower may take over
  journal::Position most_;  // most that the follower reported
  Moment behind_since_{0};  // since when the follower's journal makes no progress
  bool behind_ = false;
  journal::Position progress_;   // of the follower's journal
  journal::Position joined_at_;  // newest position when the leader began to wait for the follower
};

}  // namespace roci::exec::standby
