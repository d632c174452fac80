// The barrier brings a simulated node its steps and takes its answers: over the transport from the master,
// or, in the master's own node, straight from the ClockMaster.
#pragma once

#include <memory>
#include <optional>

#include "roci_idl/clock.h"
#include "services/clock/wall.hpp"

namespace roci::services::node {

class NodeImpl;

/// Joins a simulated node to the clock's master.
class Barrier {
 public:
  virtual ~Barrier() = default;
  /// Announces this node; it is called once, before everything else, when the node has all its endpoints.
  virtual void open(const v1::ClockReady&) = 0;
  /// Does what is due in a turn of the loop. Throws ClockError when the run cannot go on.
  virtual void turn(clock::WallTime now) = 0;
  /// Returns the newest step.
  virtual const std::optional<v1::ClockStep>& step() const = 0;
  virtual void answer(const v1::ClockDone&) = 0;
  /// Returns true if the node stays until the last step, false if it may leave its loop at once.
  virtual bool stop() = 0;
  /// Returns, after the answer to the last step, whether the node may leave.
  virtual bool over(clock::WallTime now) const = 0;
  /// Returns when turn() wants to be called again if nothing arrives.
  virtual clock::WallTime next_turn(clock::WallTime now) const = 0;
};

std::unique_ptr<Barrier> make_follower_barrier(NodeImpl&);
std::unique_ptr<Barrier> make_master_barrier(NodeImpl&);

}  // namespace roci::services::node
