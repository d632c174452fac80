// The loop turns what arrives at a node into calls of handlers: LiveLoop (live and observer) or SimLoop
// (follower and master).
#pragma once

#include <chrono>
#include <memory>
#include <string_view>

#include "core/temporal/duration.hpp"
#include "roci_idl/basic.h"
#include "services/health/peer.hpp"

namespace roci::services::node {

class NodeImpl;
struct TopicReader;

/// Decides when handlers run, and knows what time it is for them.
class Loop {
 public:
  virtual ~Loop() = default;
  virtual temporal::Time now() const = 0;
  virtual void run() = 0;
  virtual void spin_once(std::chrono::milliseconds wait) = 0;
  /// Tells others, while a handler waits for something that may last (a full disk), that this service waits and does
  /// not hang. Before the loop has begun it says nothing.
  virtual void beat() = 0;
  virtual health::PeerState peer(std::string_view service) const = 0;
  /// Takes a decoded sample of a clocked topic. Under the simulated clock a null one is counted, and no handler sees
  /// it.
  virtual void take_clocked(TopicReader&, const v1::SampleHeader&, std::shared_ptr<const void>) = 0;
  /// Reads the clock on which timers count: now(), but wall time for observers.
  virtual temporal::Time timer_now() const { return now(); }
};

std::unique_ptr<Loop> make_live_loop(NodeImpl&);
std::unique_ptr<Loop> make_sim_loop(NodeImpl&);

}  // namespace roci::services::node
