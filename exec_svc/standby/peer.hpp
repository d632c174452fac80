// The peer is the other member of a pair, as it was heard last. It is pure.
#pragma once

#include <algorithm>
#include <optional>

#include "exec_svc/journal/batch.hpp"
#include "exec_svc/standby/lease_message.hpp"

namespace roci::exec::standby {

/// Answers from the other member's newest message: how old it is, and how much of the journal it acknowledges.
class Peer {
 public:
  /// What echoes a time before `started`, when this member began, was said to another process. A message counts for a
  /// term.
  Peer(Moment started, Moment term) : started_(started), term_(term) {}

  void hear(const LeaseMessage& message, Moment now) { heard_ = Heard{message, now}; }
  /// Returns the newest message; null: none was heard.
  const LeaseMessage* newest() const { return heard_ ? &heard_->message : nullptr; }
  bool heard_lately(Moment now) const { return heard_ && now - heard_->at <= term_; }
  bool follows_lately(Moment now) const {
    return heard_lately(now) && heard_->message.role == Role::following;
  }
  /// Returns when the newest message was said at the earliest, on this member's clock, or nothing if that is long
  /// ago.
  std::optional<Moment> sent_since() const;

  /// Returns whether it follows and has this position on its disk; its journal is compared by sequence where it stands
  /// in `epoch`, the leader's own.
  bool has(const journal::Position& position, std::uint64_t epoch) const;
  /// Returns whether it follows and lacks so little of the journal that it can be waited for.
  bool is_near(const journal::Position& newest, std::uint64_t epoch) const;

  template <class See>
  void show(See&& see, Moment now) const {
    see(heard_.has_value());
    if (!heard_) return;
    const LeaseMessage& said = heard_->message;
    see(said.role, said.epoch, said.has, said.entitled, said.searching);
    const auto since = sent_since();
    // No right holds for two terms, so what echoes an older message gives none.
    see(std::min(now - heard_->at, 2 * term_), since ? std::min(now - *since, term_) : term_);
  }

 private:
  struct Heard {
    LeaseMessage message;
    Moment at{0};
  };

  Moment started_;
  Moment term_;
  std::optional<Heard> heard_;
};

}  // namespace roci::exec::standby
