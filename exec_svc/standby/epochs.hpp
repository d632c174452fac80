// Epochs number the changes of leader of a pair. This is what one member knows of them; it is pure.
#pragma once

#include <cstdint>

#include "exec_svc/journal/batch.hpp"
#include "exec_svc/standby/lease_message.hpp"

namespace roci::exec::standby {

/// Holds what must be on the disk before anything based on it is sent.
struct PersistedTerm {
  std::uint64_t epoch = 0;  ///< the highest heard of or used
  bool alone = false;       ///< led in that epoch while the other was not entitled
  /// Holds the newest epoch of the other member from which this one's journal goes on, or that it knew when it planned
  /// anew.
  std::uint64_t holds = 0;
  bool operator==(const PersistedTerm&) const = default;
};

/// Keeps the epochs that a member has heard of, led in, or was told that the other led in. The first member leads in
/// odd epochs, the second in even ones, so no epoch has two leaders.
class Epochs {
 public:
  /// Bounds the step from a known epoch to the next: the pair's epoch rises by two with each change of leader, so
  /// a wider step comes from no member.
  static constexpr std::uint64_t kJump = 1000;

  Epochs(Member self, const PersistedTerm& persisted) : self_(self), persisted_(persisted) {}

  const PersistedTerm& persisted() const { return persisted_; }
  std::uint64_t highest() const { return persisted_.epoch; }
  /// Returns the epoch in which this member leads; 0: it follows.
  std::uint64_t own() const { return own_; }
  /// Returns the epoch, if any, in which the other has led and which this leader's journal does not hold; 0: none.
  std::uint64_t unknown() const { return unknown_; }
  /// Returns whether a member can have come to this epoch.
  bool believable(std::uint64_t epoch) const;

  /// Takes in that this epoch is in use. Returns whether it is a new one.
  bool note(std::uint64_t epoch);
  /// Takes in an epoch of which an owner speaks; it counts for kJump at most.
  bool note_of_owner(std::uint64_t epoch);
  /// Takes in that somebody has led in this epoch. Returns whether it is one of the other's that this leader should
  /// have known: then it is in doubt when it leads the next time.
  bool note_led(std::uint64_t epoch);
  /// Takes in that an owner refused this member, since it obeys another or a later leader.
  void refuse() { refused_ = true; }
  bool refused() const { return refused_; }
  /// Says whether the member leads while the other has no right to take over.
  void set_alone(bool alone) { persisted_.alone = alone; }

  /// Returns the epoch in which this member would lead. One that `has_lost_all` may have led in epochs of which nobody
  /// knows, and goes beyond them.
  std::uint64_t next(bool has_lost_all) const;
  /// Leads in this epoch, at first alone, with a journal that ends at `newest`. Returns whether the member is in doubt:
  /// it was before, or somebody led in an epoch that the journal lacks, so what was done then is not known here.
  bool lead(std::uint64_t epoch, const journal::Position& newest, bool doubtful);

  /// Returns whether this leader's epoch has ended.
  bool is_over() const { return refused_ || persisted_.epoch > own_; }
  /// Returns, of a leader that stands down, whether another one leads.
  bool superseded() const { return refused_ || persisted_.epoch > own_ + (unknown_ != 0 ? 1 : 0); }

  template <class See>
  void show(See&& see) const {
    see(persisted_.epoch, persisted_.alone, persisted_.holds, refused_, own_, told_, unknown_);
  }

 private:
  Member self_;
  PersistedTerm persisted_;
  bool refused_ = false;
  std::uint64_t own_ = 0;
  std::uint64_t told_ = 0;  // following: the newest epoch in which the other is said to have led
  std::uint64_t unknown_ = 0;
};

}  // namespace roci::exec::standby
