// Two processes may command in one name, and both may believe that they are in charge. The owner decides: it grants the
// lease of its commands to one of them at a time. It is pure: requests and times go in, who holds the lease comes out.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace roci::services::owner {

/// Holds what a process says of its wish to command: that it wants to, goes on, or no longer wants to.
struct LeaseAsk {
  std::string commander;    ///< name in which it commands
  std::string member;       ///< tells the processes of that name apart
  std::uint64_t epoch = 0;  ///< epoch in which it commands, or would
  bool wanted = false;      ///< false: what it had is given back
  bool leads = false;       ///< it leads in that epoch; false: it would
  std::chrono::microseconds term{0};
  std::chrono::microseconds said{0};  ///< time on its own steady clock
};

/// Says who commands in a commander's name.
struct LeaseGrant {
  std::string member;  ///< empty: nobody
  std::uint64_t epoch = 0;
  std::chrono::microseconds term{0};
  std::chrono::microseconds echo{0};  ///< the newest `said` of the holder
  bool operator==(const LeaseGrant&) const = default;
};

/// Grants the lease of each commander to one (member, epoch) at a time, for the term that it asked for, counted from
/// when its newest request came. Another one that asks, also in a higher epoch, gets the lease when that time is
/// over or when the holder has given it back (Gray and Cheriton, Leases, SOSP 1989, section 2). A holder that counts
/// from when it said what is echoed never believes longer than the owner that it holds.
class CommanderLeases {
 public:
  using Moment = std::chrono::microseconds;  ///< on the owner's own steady clock

  /// Bounds a lease beyond its newest renewal.
  static constexpr Moment kLongestTerm = std::chrono::seconds(60);
  /// Bounds the commanders that have a lease; others get none. As many are remembered that led: where one more asks,
  /// that is forgotten which has asked least recently and holds no lease, so that invented names keep nobody out for
  /// good.
  static constexpr std::size_t kCommanders = 64;

  /// Takes a request in and returns who holds the lease now. `newest_epoch` is the newest in which the commander has
  /// commanded here. A member that asks in an older one, or in one older than that of a holder that led, gets
  /// nothing: it was replaced. An epoch more than kEpochJump later changes nothing, as with commands
  /// (command_ledger.hpp).
  LeaseGrant ask(const LeaseAsk& ask, std::uint64_t newest_epoch, Moment now);
  /// Returns the newest epoch of a holder that led, or 0 if none did.
  std::uint64_t newest_led(const std::string& commander) const;

  /// Returns whether a command in this epoch may be taken: nobody holds the lease, or this epoch does. The
  /// holder's lease is renewed by that.
  bool admits(const std::string& commander, std::uint64_t epoch, Moment now);

  /// Returns who holds the lease.
  LeaseGrant grant(const std::string& commander, Moment now) const;

  /// Shows `see` every lease and for how long it holds still.
  template <class See>
  void show(See&& see, Moment now) const {
    for (const auto& [commander, lease] : leases_)
      if (lease.until > now) see(commander, lease.grant.member, lease.grant.epoch, lease.until - now);
    for (const auto& [commander, led] : newest_led_) see(commander, led.epoch);
  }

 private:
  struct Lease {
    LeaseGrant grant;
    Moment until{0};
  };
  struct Led {
    std::uint64_t epoch = 0;
    Moment asked{0};  // the newest time
  };
  bool makes_room(const LeaseAsk& ask, Moment now);

  std::map<std::string, Lease> leases_;    // by commander
  std::map<std::string, Led> newest_led_;  // by commander
};

}  // namespace roci::services::owner
