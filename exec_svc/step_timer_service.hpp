// The step timer decides when the reactor steps.
#pragma once

#include <functional>
#include <optional>

#include "core/temporal/duration.hpp"
#include "services/node.hpp"

namespace roci::exec {

/// Calls `step` once in a turn of the loop in which something has come, and at the time that was asked for.
class StepTimer {
 public:
  StepTimer(services::Node&, std::function<void()> step);

  /// Steps after everything else that comes at this very time.
  void step_soon();
  /// Steps at that time, and forgets the time asked for before.
  void step_at(temporal::Time);
  /// Steps after that long, and not before, whatever comes.
  void step_first_after(temporal::Duration);

 private:
  services::Node& node_;
  std::function<void()> step_;
  bool due_ = false;
  std::optional<services::Node::TimerId> wake_;
};

}  // namespace roci::exec
