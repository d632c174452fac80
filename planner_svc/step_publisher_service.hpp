// The step publisher tells executive and ground what the steps of an engine that plans all the time put out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner_svc/engine/stepped_engine.hpp"
#include "roci_idl/health.h"
#include "roci_idl/outlook.h"
#include "roci_idl/plan.h"
#include "services/bounds/tally.hpp"
#include "services/publisher.hpp"

namespace roci::planner {

/// Publishes versions of the plan, schedule and outlook, and events about the engine of one robot.
class StepPublisher {
 public:
  StepPublisher(services::Node& node, std::string robot);

  /// Reports the event "planner.cycle", before the version goes out: whoever sees both reads what led to it first.
  void tell_account(const engine::StepOutput& output) const;
  void tell_version(const temporal::PlanDelta& delta) const;
  /// Publishes schedule and outlook where the output has them; `plan_version` is the newest that was sent.
  void tell_outlook(temporal::Time now, std::uint32_t plan_version, const engine::StepOutput& output) const;
  /// Reports each goal that cannot be planned ("planner.blocked") when it was not blocked so before.
  void tell_blocking(std::vector<engine::BlockingGoal> blocking);
  /// Reports the event "planner.no_room" the first, tenth, hundredth time and so on.
  void tell_refused(const char* what, std::size_t room);
  /// Reports the event "planner.measured" about what cannot be as it was said; of each kind of thing the first, tenth,
  /// hundredth time and so on.
  void tell_impossible(const std::string& kind, const std::string& why);
  void report(v1::Severity severity, const std::string& code, const std::string& text) const;

 private:
  std::string robot_;
  services::Publisher<v1::PlanDelta> deltas_;
  services::Publisher<v1::DownlinkSchedule> schedules_;
  services::Publisher<v1::MissionOutlook> outlooks_;
  services::Publisher<v1::Event> events_;
  std::vector<engine::BlockingGoal> blocking_;  // as told
  services::bounds::Tally refusals_;
  services::bounds::Tally impossible_;
};

}  // namespace roci::planner
