// A process that waits for its disk does not hang: its supervisor goes on hearing of it.
#pragma once

#include <functional>

#include "services/clock/wall.hpp"

namespace roci::services {
class Node;
}

namespace roci::services::process {

/// Waits between the attempts of one row to write, and shows meanwhile that the process lives.
class DiskPause {
 public:
  /// Calls `notify`, unless it is null, at least four times a second while it waits.
  explicit DiskPause(std::function<void()> notify = nullptr) : notify_(std::move(notify)) {}

  /// Lets the node go on to beat, as a degraded service, so that nobody takes it for hung, and calls the handlers of
  /// its turns (Node::on_turn), its supervisor's among them.
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
