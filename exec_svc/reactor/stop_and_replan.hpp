/// Nothing goes on while the planner works: what runs is cancelled, what is still active falls back (R43,
/// R44), then the planner is called, and its plan runs (Stellar, section 5.2: pause, inactive, plan, resume).
#pragma once

#include "exec_svc/reactor/replanning_policy.hpp"

namespace roci::exec::reactor {

class StopAndReplan : public ReplanningPolicy {
 public:
  explicit StopAndReplan(const PolicyParts& parts) : parts_(parts) {}

  void step(temporal::Time now, const ReactorInputs& inputs) override;
  void resume(temporal::Time now) override;
  void save(archive::Writer& archive) const override;
  void restore(archive::Reader& archive) override;

  /// Grants a wish for a plan: the pause begins. Without open goals nothing is to be planned; before every
  /// component has been observed the wish stays.
  void begin_pause(temporal::Time now);
  /// Tells the ground (`plan.waits`) whom a wish for a plan waits for, once for each of those that are awaited.
  void tell_awaited(const std::vector<const mission::Component*>& unobserved);
  /// Calls the planner once nothing runs and every component is inactive; one that does not become inactive
  /// in time makes the robot safe: until the ground speaks, or, if nobody has answered, until the robot was seen to be
  /// safe.
  void continue_pause(temporal::Time now);

 private:
  void make_safe(temporal::Time now);

  PolicyParts parts_;
  temporal::Time pause_deadline_{0};  ///< for components to become inactive
};

}  // namespace roci::exec::reactor
