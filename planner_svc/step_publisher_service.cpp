#include "planner_svc/step_publisher_service.hpp"

#include <algorithm>
#include <utility>

#include "planner_svc/engine/step_record.hpp"
#include "planner_svc/limits.hpp"
#include "planner_svc/outlook_wire_service.hpp"
#include "services/node/make_event.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::planner {

namespace topics = services::topics;

StepPublisher::StepPublisher(services::Node& node, std::string robot)
    : robot_(std::move(robot)),
      deltas_(services::advertise(node, topics::plan_delta)),
      schedules_(services::advertise(node, topics::downlink_schedule)),
      outlooks_(services::advertise(node, topics::mission_outlook)),
      events_(services::advertise(node, topics::event)) {}

void StepPublisher::tell_account(const engine::StepOutput& output) const {
  if (const std::string text = engine::account_text(output); !text.empty())
    report(v1::SEVERITY_INFO, "planner.cycle", text);
}

void StepPublisher::tell_version(const temporal::PlanDelta& delta) const {
  deltas_.write(services::wire::to_wire(delta));
}

void StepPublisher::tell_outlook(temporal::Time now, std::uint32_t plan_version,
                                 const engine::StepOutput& output) const {
  const auto tell = [&](auto sample, const auto& publisher) {
    sample.robot(robot_);
    sample.version(publisher.written() + 1);
    sample.plan_version(plan_version);
    sample.made_us(now.count());
    sample.network(output.model.name);
    sample.network_version(output.model.version);
    publisher.write(std::move(sample));
  };
  if (output.schedule) tell(to_wire(*output.schedule), schedules_);
  if (output.outlook) tell(to_wire(*output.outlook), outlooks_);
}

void StepPublisher::tell_blocking(std::vector<engine::BlockingGoal> blocking) {
  for (const engine::BlockingGoal& goal : blocking) {
    if (std::ranges::find(blocking_, goal) != blocking_.end()) continue;
    report(v1::SEVERITY_WARNING, "planner.blocked",
           "goal " + goal.issuer + "/" + goal.id +
               " cannot be planned: " + (goal.timeline.empty() ? "" : goal.timeline + ": ") + goal.reason);
  }
  blocking_ = std::move(blocking);
}

void StepPublisher::tell_refused(const char* what, std::size_t room) {
  if (const std::uint64_t count = refusals_.note(what))
    report(v1::SEVERITY_WARNING, "planner.no_room",
           std::string("a ") + what + " is not taken in: " + std::to_string(room) +
               " are kept at most, with names of at most " + std::to_string(kNameBytes) + " bytes (" +
               std::to_string(count) + " refused so far)");
}

void StepPublisher::tell_impossible(const std::string& kind, const std::string& why) {
  if (const std::uint64_t count = impossible_.note(kind))
    report(v1::SEVERITY_WARNING, "planner.measured",
           why + " (" + std::to_string(count) + " times so far for " + kind + ")");
}

void StepPublisher::report(v1::Severity severity, const std::string& code, const std::string& text) const {
  events_.write(services::node::make_event(severity, code, text));
}

}  // namespace roci::planner
