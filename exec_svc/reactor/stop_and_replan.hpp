// Stopping and replanning lets nothing go on while the planner works (Stellar, section 5.2: pause, inactive,
// plan, resume).
#pragma once

#include "exec_svc/reactor/replanning_policy.hpp"

namespace roci::exec::reactor {

/// Cancels what runs and sends what is still active its fallback command (R43, R44), then calls the planner
/// and runs its plan.
class StopAndReplan : public ReplanningPolicy {
 public:
  explicit StopAndReplan(const PolicyParts& parts) : parts_(parts) {}

  void step(temporal::Time now, const ReactorInputs& inputs) override;
  void resume(temporal::Time now) override;
  void save(archive::Writer& archive) const override;
  void restore(archive::Reader& archive) override;

  /// Grants a wish for a plan and begins the pause. Without open goals nothing is planned; before every
  /// component has been observed the wish stays.
  void begin_pause(temporal::Time now);
  /// Tells the ground (`plan.waits`) which components a wish for a plan waits for, once for each.
  void tell_awaited(const std::vector<const mission::Component*>& unobserved);
  /// Calls the planner once nothing runs and every component is inactive. If one does not become inactive in time, the
  /// robot is made safe, until the ground speaks or, if nobody has answered, until the robot was observed to be safe.
  void continue_pause(temporal::Time now);

 private:
  void make_safe(temporal::Time now);

  PolicyParts parts_;
  temporal::Time pause_deadline_{0};  ///< for components to become inactive
};

}  // namespace roci::exec::reactor
