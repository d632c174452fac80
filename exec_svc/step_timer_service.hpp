/// When the reactor steps: once in a turn of the loop in which something has come, and at the time it has asked for.
#pragma once

#include <functional>
#include <optional>

#include "core/temporal/duration.hpp"
#include "services/node.hpp"

namespace roci::exec {

class StepTimer {
 public:
  StepTimer(services::Node&, std::function<void()> step);

  /// Steps behind what comes at this very time.
  void step_soon();
  /// Steps then; what was asked for before is forgotten.
  void step_at(temporal::Time);
  /// Steps in so long, and not before, whatever comes.
  void step_first_after(temporal::Duration);

 private:
  services::Node& node_;
  std::function<void()> step_;
  bool due_ = false;
  std::optional<services::Node::TimerId> wake_;
};

}  // namespace roci::exec
