// The step loop decides when an engine that plans all the time is stepped, and steps it beside the event loop.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "planner_svc/engine/stepped_engine.hpp"
#include "services/worker.hpp"

namespace roci::planner {

/// Runs one step at a time: once for all that comes within one turn of the event loop, and at the time that was
/// asked for. Under the simulated clock steps have their place in mission time and take none of it.
class StepLoop {
 public:
  struct Result {
    engine::StepOutput output;
    std::string error;  ///< what the engine threw; empty: nothing
  };
  struct Listener {
    std::function<void()> begin;  ///< is to call step(); nothing else begins meanwhile
    std::function<void(temporal::Time begun, Result result)> end;  ///< another step may begin from here on
  };

  /// The node must outlive this object. Make it the last member, as a services::Worker.
  StepLoop(services::Node& node, Listener listener);

  /// Begins a step in this turn, unless one is due or under way: whoever ends a step looks for what came meanwhile.
  void step_soon();
  /// Begins a step at that time of the mission, if none begins before.
  void step_at(temporal::Time time);
  /// Steps the engine with these inputs on a thread of its own.
  void step(std::shared_ptr<engine::SteppedEngine> engine, engine::StepInputs inputs);

 private:
  void begin();

  services::Node& node_;
  Listener listener_;
  bool due_ = false;       // a step comes in this turn
  bool stepping_ = false;  // one is under way
  std::optional<services::Node::TimerId> wake_;
  services::Worker worker_;
};

}  // namespace roci::planner
