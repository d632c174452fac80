// A process that waits for its disk is no hung one: its supervisor goes on hearing of it.
#pragma once

#include <functional>

#include "services/clock/wall.hpp"

namespace roci::services {
class Node;
}

namespace roci::services::process {

/// Counts one row of attempts to write.
class DiskPause {
 public:
  /// `notify` is called at least four times a second while it waits; null: nobody is to hear.
  explicit DiskPause(std::function<void()> notify = nullptr) : notify_(std::move(notify)) {}

  /// The node goes on to beat, as a degraded service, so that nobody takes it for hung; and the handlers of its turns
  /// (Node::on_turn) are called, its supervisor's among them.
  explicit DiskPause(Node&);

  /// Waits: 0.1 s the first time, twice as long each further time, at most 1 s. Returns whether it was the first time
  /// of the row.
  bool wait();
  /// Ends the row. Returns how long it took, in seconds.
  double over();

 private:
  std::function<void()> notify_;
  int waits_ = 0;
  clock::WallTime begun_;
};

}  // namespace roci::services::process
