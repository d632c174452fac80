// Where a simulated node's steps come from and its answers go to: over the transport from the master, or, in
// the master's own node, straight from the ClockMaster.
#pragma once

#include <memory>
#include <optional>

#include "services/clock/wall.hpp"
#include "services/node.hpp"
#include "services/topics.hpp"

namespace roci::services {

class Barrier {
 public:
  virtual ~Barrier() = default;
  // Once, before everything else: this node has all its endpoints.
  virtual void open(const v1::ClockReady&) = 0;
  // Each turn of the loop. Throws ClockError when the run cannot go on.
  virtual void turn(wall::Instant now) = 0;
  // The newest step.
  virtual const std::optional<v1::ClockStep>& step() const = 0;
  virtual void answer(const v1::ClockDone&) = 0;
  // True: the node stays until the last step. False: it may leave its loop at once.
  virtual bool stop() = 0;
  // After the answer to the last step: whether the node may leave.
  virtual bool over(wall::Instant now) const = 0;
  // When turn() wants to be called again if nothing arrives.
  virtual wall::Instant next_turn(wall::Instant now) const = 0;
};

std::unique_ptr<Barrier> make_follower_barrier(Node&);
std::unique_ptr<Barrier> make_master_barrier(Node&);

}  // namespace roci::services
