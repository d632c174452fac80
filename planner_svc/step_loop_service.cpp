#include "planner_svc/step_loop_service.hpp"

#include <exception>
#include <utility>

namespace roci::planner {

StepLoop::StepLoop(services::Node& node, Listener listener)
    : node_(node), listener_(std::move(listener)), worker_(node) {}

void StepLoop::step_soon() {
  if (due_ || stepping_) return;
  due_ = true;
  node_.at(node_.now(), [this] { begin(); });
}

void StepLoop::step_at(temporal::Time time) {
  wake_ = node_.at(time, [this] {
    wake_.reset();
    begin();
  });
}

void StepLoop::begin() {
  due_ = false;
  if (stepping_) return;
  stepping_ = true;
  if (wake_) node_.cancel(*std::exchange(wake_, std::nullopt));
  listener_.begin();
}

void StepLoop::step(std::shared_ptr<engine::SteppedEngine> engine, engine::StepInputs inputs) {
  worker_.compute(
      [engine = std::move(engine), inputs = std::move(inputs)](const std::stop_token&) {
        Result result;
        try {
          result.output = engine->step(inputs);
        } catch (const std::exception& error) {
          result.error = error.what();
        }
        return result;
      },
      [this, begun = node_.now()](Result result) {
        stepping_ = false;
        listener_.end(begun, std::move(result));
      });
}

}  // namespace roci::planner
