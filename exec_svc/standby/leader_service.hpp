// This is the leader's side on the wire: it keeps the lease, feeds the follower, and lets out what was
// decided once the follower has it.
#pragma once

#include <deque>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "exec_svc/reactor/reactor.hpp"
#include "exec_svc/standby/journal_feed.hpp"
#include "exec_svc/standby/lease.hpp"
#include "exec_svc/standby/persisted_term_file.hpp"
#include "services/node.hpp"
#include "services/publisher.hpp"

namespace roci::exec::standby {

/// Is what leaves Node::run() when a leader is none any more.
class StandDown : public std::runtime_error {
 public:
  StandDown(const std::string& reason, bool is_superseded)
      : std::runtime_error(reason), superseded(is_superseded) {}
  const bool superseded;  ///< says whether another leader leads, for all it knows
};

/// Lets nothing out that the follower should have and has not.
class LeaderService {
 public:
  /// Takes a `lease` that leads already; its epoch begins in the journal. All arguments must outlive this
  /// object.
  LeaderService(services::Node& node, std::string executive, Lease& lease, journal::Journal& journal,
                PersistedTermFile& persisted_term);

  /// Lets out what was decided with the journal's newest commit: `send` runs now or later, in the order of
  /// these calls, unless this leader stands down before. Under the simulated clock the micro-step lasts until
  /// then.
  void send_once_copied(std::function<void()> send);
  /// Takes in that an owner refused a command of this epoch, as it holds `epoch`. Throws StandDown.
  void refused(std::uint64_t epoch);

  std::uint64_t epoch() const { return lease_->epoch(); }
  /// Returns what operators are to be told since the last call.
  std::vector<reactor::Event> take_events() { return std::exchange(events_, {}); }

 private:
  struct PendingOutput {
    journal::Position decided;
    services::Node::WorkId work;
    std::function<void()> send;
  };
  void hear(const v1::LeaseMessage& member);
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
  services::Publisher<v1::LeaseMessage> messages_;
  services::Publisher<v1::JournalChunk> chunks_;
};

}  // namespace roci::exec::standby
