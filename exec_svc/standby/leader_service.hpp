// This is the leader's side on the wire: it keeps the lease, feeds the follower, and lets out what was
// decided once the follower has it.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "exec_svc/reactor/reactor.hpp"
#include "exec_svc/standby/journal_feed.hpp"
#include "exec_svc/standby/lease.hpp"
#include "exec_svc/standby/persisted_term_file.hpp"
#include "exec_svc/standby/standby_wire_service.hpp"
#include "services/node.hpp"
#include "services/publisher.hpp"

namespace roci::exec::standby {

/// Leaves Node::run() when a leader no longer leads.
class StandDown : public std::runtime_error {
 public:
  StandDown(const std::string& reason, bool is_superseded, bool has_told_split = false)
      : std::runtime_error(reason), superseded(is_superseded), told_split(has_told_split) {}
  const bool superseded;  ///< another leader leads, for all it knows
  const bool told_split;  ///< operators were told of a split set, and not yet of its end
};

/// Sends nothing out before the follower has it where it should, and no command without the leases of all
/// owners.
class LeaderService {
 public:
  /// Takes a `lease` that leads already; its epoch begins in the journal. With `told_split`, operators were told of a
  /// split set when this process led before. All arguments must outlive this object.
  LeaderService(services::Node& node, std::string executive, Lease& lease, journal::Journal& journal,
                PersistedTermFile& persisted_term, bool told_split = false);

  /// Lets out what was decided with the journal's newest commit: `send` runs now or later, in the order of
  /// these calls, unless this leader stands down before. Under the simulated clock the micro-step lasts until
  /// then. With `commands`, it also waits for the owners' leases, a term at most: then `send` has to keep the
  /// commands back itself, as may_command() says.
  void send_once_copied(std::function<void()> send, bool commands);
  /// Returns whether a command may go out now.
  bool may_command() const { return lease_->may_command(moment()); }
  /// Within `send`: returns who holds what goes out. Else: who holds all that is decided so far.
  goals::AckStage ack_stage();
  /// Returns, once, whether all that was acknowledged by this executive alone is held by both now.
  bool take_held();
  /// From now on the plan commands these owners, and their leases are needed.
  void require(std::set<std::string> owners) { lease_->require(std::move(owners)); }
  /// Calls `take` with goals that the other member, which led apart, hands over.
  void on_hand_over(std::function<void(goals::GoalRecord)> take) { take_goal_ = std::move(take); }
  /// Takes in that an owner refused a command of this epoch, as it holds `epoch`. Throws StandDown.
  void refused(std::uint64_t epoch);

  std::uint64_t epoch() const { return lease_->epoch(); }
  /// Returns what operators are to be told since the last call.
  std::vector<reactor::Event> take_events() { return std::exchange(events_, {}); }

 private:
  struct PendingOutput {
    bool commands = false;
    journal::Position decided;
    services::Node::WorkId work;
    std::function<void()> send;
  };
  void hear(const v1::LeaseMessage& member);
  void hear(const v1::LeaseState& state);
  void report_leases();
  bool waits_for_leases() const;
  void turn();
  void feed();
  void release();
  void report(Lease::Change change, const std::string& reason);

  services::Node& node_;
  std::string executive_;  ///< the logical name of the pair
  Lease* lease_;
  journal::Journal* journal_;
  PersistedTermFile* persisted_term_;
  JournalFeed feed_;
  std::deque<PendingOutput> held_;
  std::vector<reactor::Event> events_;
  std::function<void(goals::GoalRecord)> take_goal_;
  std::optional<journal::Position> sending_;     ///< position at which what goes out now was decided
  std::optional<journal::Position> told_alone_;  ///< newest that was acknowledged as journaled here alone
  bool told_split_;
  services::Publisher<v1::LeaseMessage> messages_;
  services::Publisher<v1::LeaseRequest> lease_requests_;
  services::Publisher<v1::JournalChunk> chunks_;
};

}  // namespace roci::exec::standby
