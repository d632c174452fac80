// The lease says who of a pair of executives leads: it is a state machine over what the members say of
// themselves. It is pure. The README has the rules.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "exec_svc/journal/batch.hpp"
#include "exec_svc/standby/epochs.hpp"
#include "exec_svc/standby/lease_message.hpp"
#include "exec_svc/standby/owner_leases.hpp"
#include "exec_svc/standby/peer.hpp"
#include "exec_svc/standby/replication.hpp"
#include "exec_svc/standby/takeover_right.hpp"

namespace roci::exec::standby {

/// Decides for one member; no epoch has two leaders. A member that cannot agree with the other one leads only with
/// the leases of all owners (owner_leases.hpp), and a leader commands only with them: so one that is cut off from the
/// robot never replaces one that has it.
///
/// Each of its parts owns what it needs to answer one question: which epochs there are (Epochs), what the other member
/// said (Peer), whether a follower may lead (TakeoverRight), whether a leader must wait for its follower (Replication),
/// and whose owners' leases are there (OwnerLeases). What the answers together mean is decided here.
class Lease {
 public:
  /// With `superseded`, this member led until another one did. `owners` are those that the plan commands; with none,
  /// nobody is asked for a lease.
  Lease(Member self, const LeaseSettings& settings, const PersistedTerm& persisted_term, bool superseded,
        Moment now, std::set<std::string> owners = {});

  /// From now on the plan commands these owners.
  void require(std::set<std::string> owners) { owner_leases_.require(std::move(owners)); }

  void hear(const LeaseMessage& message, Moment now);
  /// Takes in that a part of the journal came from the leader of this epoch.
  void hear_leader(std::uint64_t epoch, Moment now);
  /// Takes in what an owner says of its lease. A leader that learns from it that the other member has led in an epoch
  /// that its journal does not hold stands down and leads anew, in doubt: what was commanded then is not known here.
  void hear(const LeaseReport& report, Moment now);
  /// Takes in that an owner refused this leader: somebody leads in this epoch or a later one. Whoever of the pair
  /// leads next does so in a later one still.
  void refused(std::uint64_t epoch);

  enum class Change {
    none,
    lead,        ///< leads from now on in epoch()
    stand_down,  ///< nothing more may be sent; a new object follows
    alone,       ///< the follower is gone and has no right any more
    paired,
  };
  struct Turn {
    Change change = Change::none;
    std::string reason;     ///< says in plain words why it changed
    bool doubtful = false;  ///< lead: the other may have gone on from this journal unheard, or has
    bool speak = false;     ///< message() is to be sent now
    std::string lacks{};    ///< following: why it would lead, and which owners' leases it lacks
  };
  /// Says what to do now; it is to be called often, and after everything heard. When persisted_term() has
  /// changed, it goes to the disk before anything else is done.
  Turn turn(const journal::Position& newest, Moment now);

  /// Returns whether what was decided at this position of the journal may be sent. It is to be asked right
  /// before sending.
  bool may_send(const journal::Position& decided, Moment now) const;

  /// The same for a command, for which the leases of all owners are needed as well.
  bool may_command(Moment now) const;
  /// Returns since when this leader lacks a lease of an owner; nothing: it has them all.
  std::optional<Moment> unleased_since() const { return unleased_since_; }
  /// Returns whether the other has this position of the journal on its disk.
  bool held_by_both(const journal::Position& position) const { return peer_.has(position, epochs_.own()); }
  const LeaseSettings& settings() const { return settings_; }
  const OwnerLeases& owner_leases() const { return owner_leases_; }

  /// Shows `see` everything that decides what this object does next, each member by itself; times as ages, so that two
  /// objects that show the same behave alike from now on.
  template <class See>
  void show(See&& see, Moment now) const {
    const bool leads = role_ == Role::leading;
    see(role_, now - spoke_at_, settled_);
    epochs_.show(see);
    peer_.show(see, now);
    owner_leases_.show(see, leads ? Moment(-1) : kRenewalsSeen * settings_.renewal, now);
    see(request_.epoch, request_.wanted);
    if (!leads) return right_.show(see, now);
    see(unleased_since_ ? now - *unleased_since_ : Moment(-1));
    replication_.show(see, now);
  }

  LeaseMessage message(const journal::Position& newest) const;
  /// Returns what is to be sent to all owners whenever message() is sent.
  OwnerRequest request() const { return request_; }
  const PersistedTerm& persisted_term() const { return epochs_.persisted(); }
  /// Returns, of a leader that stands down, whether another one leads.
  bool superseded() const { return epochs_.superseded(); }
  Role role() const { return role_; }
  Member self() const { return self_; }
  std::uint64_t epoch() const { return epochs_.highest(); }

 private:
  static constexpr int kRenewalsSeen = 3;  // may pass before a leader counts as one that does not renew

  /// Says why a follower would lead, and what that takes.
  struct Claim {
    std::string reason;
    bool agreed = false;    ///< the other agrees and follows: no owner has to be asked first
    bool doubtful = false;  ///< the other may have gone on from this journal, unheard
  };
  void note_led(std::uint64_t epoch);
  Turn follow(const journal::Position& newest, Moment now);
  std::uint64_t epoch_to_lead(const journal::Position& newest, Moment now) const;
  void ask_owners(bool wanted, const journal::Position& newest, Moment now);
  bool should_hand_over(Moment now) const;
  Turn lead(const Claim& claim, const journal::Position& newest, Moment now);
  Turn keep_leading(const journal::Position& newest, Moment now);
  Turn update_replication(const journal::Position& newest, Moment now);
  std::optional<Claim> claim(const journal::Position& newest, Moment now) const;
  bool wins(const LeaseMessage& other, const journal::Position& newest) const;

  Member self_;
  LeaseSettings settings_;
  Epochs epochs_;
  Role role_ = Role::following;
  Peer peer_;
  Moment spoke_at_{0};
  OwnerLeases owner_leases_;
  OwnerRequest request_;
  TakeoverRight right_;                   // following
  Replication replication_;               // leading, as all below
  std::optional<Moment> unleased_since_;  // nothing: it has the leases of all owners
  bool settled_ = false;                  // had a turn since it leads; opening its endpoints may take a while
};

}  // namespace roci::exec::standby
