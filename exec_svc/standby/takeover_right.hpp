// The right to take over is what a follower has by its leader's newest message. It is pure.
#pragma once

#include <optional>

#include "exec_svc/journal/batch.hpp"
#include "exec_svc/standby/lease_message.hpp"

namespace roci::exec::standby {

/// Says whether the leader wants this follower to lead after it, from which journal and until when, and for how long no
/// leader was heard.
class TakeoverRight {
 public:
  /// A member that was `superseded` may not take over before the new leader says so.
  TakeoverRight(bool superseded, const LeaseSettings& settings, Moment now)
      : valid_for_(settings.term + settings.takeover_window),
        forbidden_(superseded),
        leaderless_since_(now) {}

  /// Takes in that the leader of the newest epoch is there.
  void hear_leader(Moment now) { leaderless_since_ = now; }
  /// Takes in what the leader of the newest epoch says, which it said at `sent_since` at the earliest; nothing: that is
  /// too long ago to give a right.
  void hear(const LeaseMessage& message, std::optional<Moment> sent_since, Moment now) {
    entitled_ = message.entitled && sent_since;
    forbidden_ = !message.entitled;
    receipt_ = message.receipt;
    since_ = sent_since.value_or(now);
  }
  /// Takes in that a later epoch than that leader's is in use.
  void lapse() { entitled_ = false; }

  /// Returns whether the right holds for a journal that ends here: it has all that the leader knew it to have.
  bool holds(const journal::Position& newest, Moment now) const {
    return entitled_ && newest >= receipt_ && now - since_ < valid_for_;
  }
  /// Returns whether the newest leader does not want it to take over.
  bool forbidden() const { return forbidden_; }
  Moment leaderless_for(Moment now) const { return now - leaderless_since_; }

  template <class See>
  void show(See&& see, Moment now) const {
    const bool in_time = entitled_ && now - since_ < valid_for_;
    see(forbidden_, in_time, now - leaderless_since_);
    if (in_time) see(receipt_, now - since_);
  }

 private:
  Moment valid_for_;
  bool forbidden_;
  bool entitled_ = false;
  journal::Position receipt_;
  Moment since_{0};  // earliest time at which the leader can have said it
  Moment leaderless_since_;
};

}  // namespace roci::exec::standby
