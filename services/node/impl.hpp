// What a node consists of. The loop (live or simulated) decides when handlers run; the rest is shared.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "services/node.hpp"
#include "services/node/endpoints.hpp"
#include "services/node/inbox.hpp"
#include "services/node/loop.hpp"
#include "services/node/timer_queue.hpp"
#include "services/node/work_table.hpp"

namespace roci::services {

class CallTable;
class CallServer;

class Node::Impl {
 public:
  Impl(Node&, NodeOptions, std::unique_ptr<Transport>);

  // Subscribing under the simulated clock is over once the loop runs: throws std::logic_error.
  InTopic& subscribe(const TopicSpec&);

  // Decodes an arrival and runs its handlers, or hands it to the loop if its topic is clocked.
  void take_in(Arrival&&);
  // Whether a sample that names this run is to be obeyed; notes those of other runs.
  bool is_of_this_run(const std::string& sample_run, const std::string& topic);
  static void handle(InTopic&, const void* value);
  void announce(const PeerChange&);
  void announce_match();
  void announce_turn();

  const NodeOptions options;
  std::string run;  // that this node obeys; an observer without one takes the first that it hears
  std::unique_ptr<Transport> transport;
  Inbox inbox;
  TimerQueue timers;
  WorkTable work;
  std::vector<std::function<void(const PeerChange&)>> on_peer_change;
  std::vector<std::function<void()>> on_match;
  std::vector<std::function<void()>> on_turn;
  // One table and one server for each procedure, by the name of its request topic.
  std::map<std::string, std::shared_ptr<CallTable>> calls;
  std::map<std::string, std::shared_ptr<CallServer>> servers;
  Endpoints endpoints;
  bool running = false;
  std::map<std::string, std::uint64_t> foreign;  // samples of other runs, by run; of the first kForeignRuns alone
  std::unique_ptr<Loop> loop;
};

}  // namespace roci::services
