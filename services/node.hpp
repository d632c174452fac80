// The node is a service's one door to the others: publishers, subscriptions, timers and calls, all on one
// event loop.
//
// Handlers run on the thread that calls run(), one at a time. Live, samples are handled as they come; under
// the simulated clock a handler sees the samples of one micro-step in the order (topic, sender, incarnation,
// sequence), so the same handlers give the same run on every transport. Handlers never block and never ask
// the system for time.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "core/temporal/duration.hpp"
#include "services/health/peer.hpp"
#include "services/link/channel.hpp"
#include "services/node/node_options.hpp"
#include "services/transport/transport.hpp"

namespace roci::services {

namespace node {
class NodeImpl;
}

/// Runs one event loop, on which all handlers of a service are called. publisher.hpp has its typed half,
/// Publisher<T> and subscribe<T>().
class Node {
 public:
  Node(node::NodeOptions, std::unique_ptr<transport::Transport>);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  const node::NodeOptions& options() const;
  temporal::Time now() const;

  using TimerId = std::uint64_t;
  /// Fire at a mission time, or after a duration; what is due already fires in the next turn of the loop.
  TimerId at(temporal::Time, std::function<void()>);
  TimerId after(temporal::Duration, std::function<void()>);
  void cancel(TimerId);

  /// Calls the handler in each turn of the loop, before timers fire: at least four times a second of wall
  /// time, also while the simulated clock stands still.
  void on_turn(std::function<void()>);

  /// Returns the services of the mission that a link of the scenario joins to this one, with the light time
  /// there and back: an answer may come later by that, or be lost.
  std::map<std::string, temporal::Duration> round_trips() const;
  /// Returns what has become of the samples that came over links so far, by name of the link.
  std::map<std::string, link::Counts> link_counts() const;
  /// Returns the samples that did not arrive at an attempt, in the order in which that became known here.
  const std::vector<link::LostSample>& lost_samples() const;

  void on_peer_change(std::function<void(const health::PeerChange&)>);
  bool peer_alive(std::string_view service) const;

  /// Returns how many samples of other runs were left unread, by run.
  const std::map<std::string, std::uint64_t>& foreign_runs() const;

  /// Let a worker thread hand a result to the loop. Under the simulated clock the loop does not answer its
  /// barrier between begin_work() and the end of the posted function, and results run in the order in which
  /// the work began, so that a worker's result has one place in mission time. post_work_result may be called
  /// from any thread.
  using WorkId = std::uint64_t;
  WorkId begin_work();
  void post_work_result(WorkId, std::function<void()>);

  /// Ends the run for every participant if this node is the master, else only its own loop. Any thread may
  /// call it.
  void stop();
  /// Runs the loop until stop() or the master's last step. Under the simulated clock all subscriptions are
  /// made before run(). Throws clock::ClockError; an exception of a handler passes through.
  void run();
  /// On live and observer nodes, handles what is pending and waits at most `wait` of wall time for something
  /// to handle. Throws std::logic_error under the simulated clock.
  void spin_once(std::chrono::milliseconds wait);

  /// Serves the typed halves alone (publisher.hpp, rpc.hpp).
  node::NodeImpl& impl() { return *impl_; }

 private:
  std::unique_ptr<node::NodeImpl> impl_;
};

}  // namespace roci::services
