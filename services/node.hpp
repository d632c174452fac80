// A service's one door to the others: publishers, subscriptions, timers and calls, all on one event loop.
//
// Handlers run on the thread that calls run(), one at a time. Live, samples are handled as they come; under
// the simulated clock a handler sees the samples of one micro-step in the order (topic, sender, incarnation,
// sequence), so the same handlers give the same run on every transport. Handlers never block and never ask
// the system for time.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "core/temporal/duration.hpp"
#include "services/health/peer.hpp"
#include "services/node/node_options.hpp"
#include "services/transport/transport.hpp"

namespace roci::services {

namespace node {
class NodeImpl;
}
namespace rpc {
class CallRegistry;
}

// The untyped half that typed wrappers stand on; see publisher.hpp for Publisher<T> and subscribe<T>().
class Node {
 public:
  Node(node::NodeOptions, std::unique_ptr<transport::Transport>);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  const node::NodeOptions& options() const;
  temporal::Time now() const;

  using TimerId = std::uint64_t;
  TimerId at(temporal::Time, std::function<void()>);  // at a past time: in the next turn of the loop
  TimerId after(temporal::Duration, std::function<void()>);
  void cancel(TimerId);

  // Called in each turn of the loop, before timers fire: four times a second at least, in wall time, also
  // while the simulated clock stands still.
  void on_turn(std::function<void()>);

  void on_peer_change(std::function<void(const health::PeerChange&)>);
  bool peer_alive(std::string_view service) const;

  // Lets a worker thread hand a result to the loop. Under the simulated clock the loop does not answer its
  // barrier between begin_work() and the end of the posted function, and results run in the order in which
  // their works began, so that a worker's result has one place in mission time. post_work_result may be
  // called from any thread.
  using WorkId = std::uint64_t;
  WorkId begin_work();
  void post_work_result(WorkId, std::function<void()>);

  // The master ends the run for every participant; elsewhere only this node's loop. Any thread may call it.
  void stop();
  // Until stop() or the master's last step. Under the simulated clock all subscriptions are made before
  // run(). Throws clock::ClockError; an exception of a handler passes through.
  void run();
  // Live and observer nodes: handles what is pending, waits at most `wait` of wall time for something to
  // handle.
  void spin_once(std::chrono::milliseconds wait);

  // For the typed halves alone (publisher.hpp, rpc.hpp).
  node::NodeImpl& impl() { return *impl_; }
  rpc::CallRegistry& calls() { return *calls_; }

 private:
  std::unique_ptr<rpc::CallRegistry> calls_;  // before impl_: its endpoints end first
  std::unique_ptr<node::NodeImpl> impl_;
};

}  // namespace roci::services
