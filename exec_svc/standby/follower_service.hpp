// This is the follower's side on the wire: it takes the leader's journal, says what it has, and finds out
// when to lead.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "exec_svc/standby/goals_apart.hpp"
#include "exec_svc/standby/journal_copy.hpp"
#include "exec_svc/standby/lease.hpp"
#include "exec_svc/standby/orders_apart.hpp"
#include "exec_svc/standby/persisted_term_file.hpp"
#include "services/bounds/tally.hpp"
#include "services/node.hpp"
#include "services/publisher.hpp"

namespace roci::exec::standby {

/// Follows until it is this member's turn to lead or the run is over; then it stops the node.
class FollowerService {
 public:
  /// Uses an observer's node, outside the simulated clock. All arguments must outlive this object. `executive` is the
  /// logical name of the pair; messages of and for another one are ignored. Goals that this member took in while it
  /// led apart and that the leader lacks are handed over to the leader; `apart` keeps them until then. Orders are not
  /// handed over: operators are told of those that it took apart and that their givers do not repeat to the leader
  /// (event order.lost).
  FollowerService(services::Node& node, std::string executive, Lease& lease, journal::Journal& journal,
                  PersistedTermFile& persisted_term, GoalsApart apart);

  /// Says why this member leads, once it does; the node has been stopped then.
  const std::optional<Lease::Turn>& lead() const { return lead_; }
  /// Returns whether the simulated clock has come to its end, and with it the run.
  bool run_is_over() const { return over_; }

 private:
  void hear(const v1::LeaseMessage& member);
  void hear(const v1::LeaseState& state);
  void take(const Chunk& chunk);
  void tell_excess(const Chunk& chunk);
  void tell_unwritten();
  void hand_over();
  void tell_lost_orders();
  void tell_what_it_lacks(const Lease::Turn&);
  void turn();
  void say();

  services::Node& node_;
  std::string executive_;  ///< the logical name of the pair
  Lease* lease_;
  journal::Journal* journal_;
  PersistedTermFile* persisted_term_;
  JournalCopy copy_;
  std::optional<Lease::Turn> lead_;
  std::set<std::string> told_to_lack_;
  services::bounds::Tally refusals_;
  bool over_ = false;
  GoalsApart apart_;
  std::vector<goals::GoalRecord> handed_over_;  ///< that the leader may not have yet
  Moment handed_over_at_{0};
  std::vector<TakenOrder> apart_orders_;  ///< of journals that were replaced
  Moment orders_replaced_at_{0};
  services::Publisher<v1::LeaseMessage> messages_;
  services::Publisher<v1::LeaseRequest> lease_requests_;
  services::Publisher<v1::GoalHandOver> goals_;
  services::Publisher<v1::Event> events_;
};

}  // namespace roci::exec::standby
