// The leases of the owners of commands, as a member of the pair sees them: whom it has to ask, what it holds, and when
// it gives back what it has. It is pure.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace roci::exec::standby {

using Moment = std::chrono::microseconds;  ///< counts on this member's own steady clock

/// Names the two executives of a pair.
enum class Member { first, second };

/// Is what an owner says of its lease (services/owner/commander_leases.hpp).
struct LeaseReport {
  std::string owner;
  std::optional<Member> holder;    ///< nothing: nobody
  std::uint64_t epoch = 0;         ///< epoch in which the holder holds the lease
  std::uint64_t newest_epoch = 0;  ///< newest epoch in which the pair has commanded there
  Moment echo{0};                  ///< newest time that the holder sent, on the holder's clock
  Moment term{0};                  ///< the lease lasts so long from then on at least
  bool operator==(const LeaseReport&) const = default;
};

/// Holds what a member says to all owners.
struct OwnerRequest {
  Member member = Member::first;
  std::uint64_t epoch = 0;
  bool wanted = false;
  bool leads = false;  ///< it leads in that epoch; false: it would
  Moment term{0};
  Moment said{0};
  bool operator==(const OwnerRequest&) const = default;
};

/// Tracks the owners' leases: a member commands only while it holds all of them. Two members that hold a part each
/// would wait for each other for ever, so one that has held a part for a term gives it back and asks for nothing for
/// some terms: the first member for two, the second for three. Their times to ask thus drift apart, and in the end
/// one asks alone.
class OwnerLeases {
 public:
  /// `patience` is how long a part is held.
  OwnerLeases(Member self, std::set<std::string> owners, Moment patience);

  /// Sets the owners whose leases are needed from now on.
  void require(std::set<std::string> owners) { owners_ = std::move(owners); }

  void hear(const LeaseReport& report, Moment now);
  /// Takes in that this member wants to command in this epoch, or (nothing) does not. Returns whether it is to ask
  /// the owners for their leases now.
  bool wants(std::optional<std::uint64_t> epoch, Moment now);

  /// Returns whether this member holds the lease of every owner in this epoch. It never believes so for longer than
  /// the owner does.
  bool holds_all(std::uint64_t epoch, Moment now) const;
  bool holds_any(std::uint64_t epoch, Moment now) const;
  /// Returns whether every owner was heard within this time.
  bool hears_all(Moment within, Moment now) const;
  /// Returns whether the other member holds any of the leases, as far as is known.
  bool other_holds_any(Moment now) const;
  /// Returns whether an owner has told within this time that the other member renews its lease there: it is alive and
  /// commands, though it may be unheard.
  bool other_renews(Moment within, Moment now) const { return now - other_renewed_at_ <= within; }
  /// Names the owners whose lease is missing, in plain words.
  std::string missing(std::uint64_t epoch, Moment now) const;

  /// Shows everything that decides what this object does next, as Lease::show(), to who asks other_renews() for times
  /// up to `renewed_within`.
  template <class See>
  void show(See&& see, Moment renewed_within, Moment now) const {
    for (const auto& [owner, heard] : heard_) {
      const LeaseReport& report = heard.report;
      see(owner, report.holder.has_value(), report.holder.value_or(Member::first), report.epoch,
          report.newest_epoch);
      see(std::min(now - heard.at, std::max(patience_, report.term) + Moment(1)), report.term,
          report.holder == self_ ? std::min(now - report.echo, report.term) : Moment(0));
    }
    see(partial_since_ ? now - *partial_since_ : Moment(-1),
        silent_until_ ? *silent_until_ - now : Moment(-1));
    see(std::min(now - other_renewed_at_, renewed_within + Moment(1)));
  }

 private:
  struct Heard {
    LeaseReport report;
    Moment at{0};
  };
  bool holds(const std::string& owner, std::uint64_t epoch, Moment now) const;

  Member self_;
  std::set<std::string> owners_;
  Moment patience_;
  std::map<std::string, Heard> heard_;
  std::optional<Moment> partial_since_;
  std::optional<Moment> silent_until_;
  Moment other_renewed_at_ = Moment::min() / 2;  // it was never heard of
};

}  // namespace roci::exec::standby
