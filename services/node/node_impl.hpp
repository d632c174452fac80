// This file has what a node consists of. The loop (live or simulated) decides when handlers run; the rest is
// shared.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <typeindex>
#include <vector>

#include "core/temporal/duration.hpp"
#include "services/health/heartbeat_sender.hpp"
#include "services/health/namesake_watch.hpp"
#include "services/health/peer.hpp"
#include "services/node/completion_queue.hpp"
#include "services/node/contract_check.hpp"
#include "services/node/contract_gate.hpp"
#include "services/node/datagram_watch.hpp"
#include "services/node/endpoints.hpp"
#include "services/node/inbox.hpp"
#include "services/node/link_gate.hpp"
#include "services/node/loop.hpp"
#include "services/node/node_options.hpp"
#include "services/node/rejected_samples.hpp"
#include "services/node/timer_queue.hpp"
#include "services/transport/transport.hpp"

namespace roci::services::node {

/// Composes a node of its parts, and is known to them.
class NodeImpl {
 public:
  NodeImpl(NodeOptions, std::unique_ptr<transport::Transport>);

  bool simulated() const { return clock::is_simulated(options.clock); }
  temporal::Time now() const { return loop->now(); }
  TimerQueue::Id after(temporal::Duration, std::function<void()> fire);
  health::PeerState peer(std::string_view service) const;

  /// Subscribes to a topic. Throws std::logic_error under the simulated clock once the loop runs.
  TopicReader& subscribe(const TopicSpec&);

  /// Takes what has arrived. What the contract lets pass is decoded, and then handled, or handed to the loop if its
  /// topic is clocked.
  void receive(Arrival&&);
  static void handle(TopicReader&, const void* value);
  void announce(const health::PeerChange&);
  void announce_match();
  void announce_turn();

  /// Returns the one T that the node keeps for a floor above as long as it lives; it is made at the first
  /// call.
  template <class T>
  T& attachment() {
    std::shared_ptr<void>& kept = attachments[typeid(T)];
    if (!kept) kept = std::make_shared<T>();
    return *static_cast<T*>(kept.get());
  }

  /// Makes the sender of this node's heartbeats, on their topic.
  health::HeartbeatSender make_heartbeat_sender();
  /// Takes a heartbeat of the run. Throws health::Superseded if another process has this node's name and goes on
  /// with it.
  void hear_namesake(const v1::Heartbeat&);

  const NodeOptions options;
  RunIdentity run;
  std::unique_ptr<transport::Transport> transport;
  ContractCheck contract;
  RejectedSamples rejected;
  DatagramWatch datagrams;
  Inbox inbox;
  TimerQueue timers;
  CompletionQueue work;
  std::vector<std::function<void(const health::PeerChange&)>> on_peer_change;
  std::vector<std::function<void()>> on_match;
  std::vector<std::function<void()>> on_turn;
  /// Holds the attachments; they outlive the endpoints, whose handlers use them.
  std::map<std::type_index, std::shared_ptr<void>> attachments;
  Endpoints endpoints;
  LinkGate links;
  ContractGate gate;
  bool running = false;
  bool degraded = false;  ///< live: heartbeats say so
  std::unique_ptr<Loop> loop;

 private:
  void read(Arrival&&);
  void refuse_malformed(TopicReader&, const Decoded&, const transport::Guid& writer);
  void tell(const std::string& code, const std::string& text);

  std::optional<health::NamesakeWatch> namesakes_;
};

}  // namespace roci::services::node
