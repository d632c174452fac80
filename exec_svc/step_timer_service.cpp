#include "exec_svc/step_timer_service.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec {

StepTimer::StepTimer(services::Node& node, std::function<void()> step)
    : node_(node), step_(std::move(step)) {}

void StepTimer::step_soon() {
  if (due_) return;
  due_ = true;
  node_.at(node_.now(), [this] {
    due_ = false;
    step_();
  });
}

void StepTimer::step_at(temporal::Time time) {
  if (wake_) node_.cancel(*wake_);
  wake_ = node_.at(std::max(time, node_.now()), [this] {
    wake_.reset();
    step_soon();
  });
}

void StepTimer::step_first_after(temporal::Duration wait) {
  due_ = true;
  node_.after(wait, [this] {
    due_ = false;
    step_soon();
  });
}

}  // namespace roci::exec
