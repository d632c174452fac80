// How a node turns what arrives into calls of handlers: LiveLoop (live and observer) or SimLoop (follower and
// master).
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

class Loop {
 public:
  virtual ~Loop() = default;
  virtual temporal::Time now() const = 0;
  virtual void run() = 0;
  virtual void spin_once(std::chrono::milliseconds wait) = 0;
  /// Is called while a handler waits for what may last (a full disk), and says to others that this service waits and
  /// does not hang. Before the loop has begun it says nothing.
  virtual void beat() = 0;
  virtual health::PeerState peer(std::string_view service) const = 0;
  /// Takes a decoded sample of a clocked topic. Null, under the simulated clock: the sample is counted, and no handler
  /// sees it.
  virtual void take_clocked(TopicReader&, const v1::SampleHeader&, std::shared_ptr<const void>) = 0;
  /// Reads the clock on which timers count: now(), but wall time for observers.
  virtual temporal::Time timer_now() const { return now(); }
};

std::unique_ptr<Loop> make_live_loop(NodeImpl&);
std::unique_ptr<Loop> make_sim_loop(NodeImpl&);

}  // namespace roci::services::node
