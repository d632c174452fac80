// The lease says who of a pair of executives leads: it is a state machine over what the members say of
// themselves. It is pure. The README has the rules.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

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

/// Holds what must be on the disk before anything based on it is sent.
struct PersistedTerm {
  std::uint64_t epoch = 0;  ///< the highest heard of or used
  bool alone = false;       ///< led in that epoch while the other was not entitled
  /// Holds the newest epoch of the other member from which this one's journal goes on, or that it knew when it planned
  /// anew.
  std::uint64_t holds = 0;
  bool operator==(const PersistedTerm&) const = default;
};

/// Decides for one member; no epoch has two leaders. A member that cannot agree with the other one leads only with
/// the leases of all owners (owner_leases.hpp), and a leader commands only with them: so one that is cut off from the
/// robot never replaces one that has it.
class Lease {
 public:
  /// Bounds the step from a known epoch to the next: the pair's epoch rises by two with each change of leader, so
  /// a wider step comes from no member.
  static constexpr std::uint64_t kEpochJump = 1000;

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
  bool held_by_both(const journal::Position& position) const { return other_has(position); }
  const LeaseSettings& settings() const { return settings_; }
  const OwnerLeases& owner_leases() const { return owner_leases_; }

  /// Shows `see` everything that decides what this object does next, each member by itself; times as ages, so that two
  /// objects that show the same behave alike from now on.
  template <class See>
  void show(See&& see, Moment now) const {
    see(persisted_term_.epoch, persisted_term_.alone, role_, other_.has_value(), refused_, now - spoke_at_);
    if (other_) {
      const LeaseMessage& said = other_->message;
      see(said.role, said.epoch, said.has.epoch, said.has.sequence, said.entitled, said.searching);
      see(now - other_->at, now - said.echo, said.echo < started_);
    }
    owner_leases_.show(see, now);
    see(request_.epoch, request_.wanted, unleased_since_ ? now - *unleased_since_ : Moment(-1));
    see(takeover_forbidden_, entitled_, receipt_.epoch, receipt_.sequence, now - entitled_since_);
    see(now - leaderless_since_, own_epoch_, settled_, replication_, now - entitled_at_);
    see(persisted_term_.holds, told_epoch_, unknown_epoch_, most_.epoch, most_.sequence);
    see(now - behind_since_, behind_, progress_.epoch, progress_.sequence, joined_at_.epoch,
        joined_at_.sequence);
  }

  LeaseMessage message(const journal::Position& newest) const;
  /// Returns what is to be sent to all owners whenever message() is sent.
  OwnerRequest request() const { return request_; }
  const PersistedTerm& persisted_term() const { return persisted_term_; }
  /// Returns, of a leader that stands down, whether another one leads.
  bool superseded() const {
    return refused_ || persisted_term_.epoch > own_epoch_ + (unknown_epoch_ != 0 ? 1 : 0);
  }
  Role role() const { return role_; }
  Member self() const { return self_; }
  std::uint64_t epoch() const { return persisted_term_.epoch; }

 private:
  /// Names the states of a leader. One that is catching_up waits for receipts, as the follower is nearly
  /// there; one that is revoking has taken the follower's right back, which the follower may not know.
  enum class ReplicationState { alone, catching_up, paired, revoking };
  struct Heard {
    LeaseMessage message;
    Moment at{0};
  };
  bool is_over() const { return refused_ || persisted_term_.epoch > own_epoch_; }
  bool believable(std::uint64_t epoch) const;
  void note_epoch(std::uint64_t epoch);
  void note_led(std::uint64_t epoch);
  /// Says why a follower would lead, and what that takes.
  struct Claim {
    std::string reason;
    bool agreed = false;    ///< the other agrees and follows: no owner has to be asked first
    bool doubtful = false;  ///< the other may have gone on from this journal, unheard
  };
  Turn follow(const journal::Position& newest, Moment now);
  std::uint64_t epoch_to_lead(const journal::Position& newest, Moment now) const;
  void ask_owners(bool wanted, const journal::Position& newest, Moment now);
  bool should_hand_over(Moment now) const;
  Turn lead(const Claim& claim, const journal::Position& newest, Moment now);
  Turn keep_leading(const journal::Position& newest, Moment now);
  void note_progress(const journal::Position& newest, Moment now);
  Turn update_replication(const journal::Position& newest, Moment now);
  std::optional<Claim> claim(const journal::Position& newest, Moment now) const;
  bool right_holds(const journal::Position& newest, Moment now) const;
  bool wins(const LeaseMessage& other, const journal::Position& newest) const;
  bool expired(Moment now) const { return now - entitled_at_ >= settings_.term; }
  bool heard_lately(Moment now) const { return other_ && now - other_->at <= settings_.term; }
  /// Returns when the newest message of the other was said at the earliest, on this clock, or nothing if that
  /// is long ago.
  std::optional<Moment> sent_since() const;
  bool other_has(const journal::Position& position) const;
  bool other_is_near(const journal::Position& newest) const;

  Member self_;
  LeaseSettings settings_;
  PersistedTerm persisted_term_;
  Role role_ = Role::following;
  std::optional<Heard> other_;
  bool refused_ = false;
  Moment spoke_at_{0};
  OwnerLeases owner_leases_;
  OwnerRequest request_;
  std::optional<Moment> unleased_since_;  ///< leading

  bool takeover_forbidden_;    ///< following: the newest leader does not want it to take over
  bool entitled_ = false;      ///< following: by the leader's newest message, with a journal that has
  journal::Position receipt_;  ///< this at least,
  Moment entitled_since_{0};   ///< earliest time at which that was said
  Moment leaderless_since_;
  std::uint64_t told_epoch_ = 0;  ///< following: the newest epoch in which the other is said to have led
  Moment started_;

  std::uint64_t own_epoch_ = 0;      ///< leading
  std::uint64_t unknown_epoch_ = 0;  ///< the other has led in it, and this leader's journal does not hold it
  journal::Position most_;           ///< most that the other reported since this one leads
  bool settled_ = false;             ///< had a turn since it leads; opening its endpoints may take a while
  ReplicationState replication_ = ReplicationState::alone;
  Moment entitled_at_{0};  ///< when this leader last said that the other may take over
  Moment replication_since_{0};
  Moment behind_since_{0};  ///< since when the other's journal makes no progress
  bool behind_ = false;
  journal::Position progress_;
  journal::Position joined_at_;  ///< newest position when the leader began to wait for the follower
};

}  // namespace roci::exec::standby
