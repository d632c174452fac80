// What a node consists of. The loop (live or simulated) decides when handlers run; the rest is shared.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "core/temporal/duration.hpp"
#include "services/health/heart.hpp"
#include "services/health/peer.hpp"
#include "services/node/endpoints.hpp"
#include "services/node/inbox.hpp"
#include "services/node/loop.hpp"
#include "services/node/node_options.hpp"
#include "services/node/timer_queue.hpp"
#include "services/node/work_table.hpp"
#include "services/transport/transport.hpp"

namespace roci::services::node {

class NodeImpl {
 public:
  NodeImpl(NodeOptions, std::unique_ptr<transport::Transport>);

  bool simulated() const { return clock::is_simulated(options.clock); }
  temporal::Time now() const { return loop->now(); }
  TimerQueue::Id after(temporal::Duration, std::function<void()> fire);
  health::PeerState peer(std::string_view service) const;

  // Subscribing under the simulated clock is over once the loop runs: throws std::logic_error.
  InTopic& subscribe(const TopicSpec&);

  // Decodes an arrival and runs its handlers, or hands it to the loop if its topic is clocked.
  void take_in(Arrival&&);
  static void handle(InTopic&, const void* value);
  void announce(const health::PeerChange&);
  void announce_match();
  void announce_turn();

  // The heartbeat of this node, on its topic.
  health::Heart make_heart();

  const NodeOptions options;
  RunIdentity run;
  std::unique_ptr<transport::Transport> transport;
  Inbox inbox;
  TimerQueue timers;
  WorkTable work;
  std::vector<std::function<void(const health::PeerChange&)>> on_peer_change;
  std::vector<std::function<void()>> on_match;
  std::vector<std::function<void()>> on_turn;
  Endpoints endpoints;
  bool running = false;
  std::unique_ptr<Loop> loop;
};

}  // namespace roci::services::node
