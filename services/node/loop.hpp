// How a node turns what arrives into calls of handlers: LiveLoop (live and observer) or SimLoop (follower and
// master).
#pragma once

#include <chrono>
#include <memory>
#include <string_view>

#include "services/node.hpp"
#include "services/topics.hpp"

namespace roci::services {

struct InTopic;

enum class PeerState { never_seen, alive, dead };

class Loop {
 public:
  virtual ~Loop() = default;
  virtual Time now() const = 0;
  virtual void run() = 0;
  virtual void spin_once(std::chrono::milliseconds wait) = 0;
  virtual PeerState peer(std::string_view service) const = 0;
  // A decoded sample of a clocked topic.
  virtual void take_clocked(InTopic&, const v1::SampleHeader&, std::shared_ptr<const void>) = 0;
  // The clock that timers count on: now(), but wall time for observers.
  virtual Time timer_now() const { return now(); }
};

std::unique_ptr<Loop> make_live_loop(Node&);
std::unique_ptr<Loop> make_sim_loop(Node&);

}  // namespace roci::services
