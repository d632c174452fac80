// What the two members of a pair say of themselves, and the times that follow from the term of their lease.
#pragma once

#include <chrono>
#include <cstdint>

#include "exec_svc/journal/batch.hpp"
#include "exec_svc/standby/owner_leases.hpp"

namespace roci::exec::standby {

/// Says whether a member of the pair leads.
enum class Role { following, leading };

/// Holds what a member says of itself.
struct LeaseMessage {
  Member member = Member::first;
  Role role = Role::following;
  std::uint64_t epoch = 0;  ///< the highest that it knows of; a leader's own
  journal::Position has;    ///< position of its journal
  /// Says of a leader that the other may take over once this message is a term old; says of a follower that
  /// it will, and that it hears all owners of commands.
  bool entitled = false;
  /// Says, of a leader, the most that it has known the other to have; if the other has less, as after losing its disk,
  /// it is not entitled.
  journal::Position receipt;
  bool searching = false;  ///< a follower that has heard no leader for a term
  Moment said{0};          ///< counts on the clock of who says it
  Moment echo{0};          ///< the newest `said` heard from the other, on the other's clock
  bool operator==(const LeaseMessage&) const = default;
};

/// Holds times that all follow from the term, for how long a leader's message holds. Both members must have
/// the same one.
struct LeaseSettings {
  Moment term = std::chrono::seconds(2);
  Moment renewal = term / 8;           ///< lies between two messages
  Moment progress_timeout = term / 2;  ///< bounds the time without progress of the other's journal
  /// Bounds how late a follower may take over: from a term after it last heard the leader until a term and
  /// this after it sent what that message echoes. Later its right has lapsed, so that a process that was
  /// stopped does not use it late and a late message gives no right.
  Moment takeover_window = term / 2;
  Moment solo_timeout = 10 * term;  ///< time until one that hears nobody leads in doubt
  /// Limits an owner's lease after each renewal. It ends before a follower may take over, so that
  /// the owners of a leader that died are free by then.
  Moment owner_term = 3 * term / 4;
};

}  // namespace roci::exec::standby
