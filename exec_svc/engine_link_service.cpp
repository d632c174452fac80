#include "exec_svc/engine_link_service.hpp"

#include <utility>

#include "exec_svc/wire_service.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::exec {

using reactor::Event;
using reactor::PlanReceipt;
using reactor::Severity;

EngineLink::EngineLink(services::Node& node, std::function<void(temporal::PlanDelta)> take,
                       std::function<void(const Event&)> report)
    : executive_(node.options().name), receipts_(services::advertise(node, services::topics::plan_receipt)) {
  services::subscribe(
      node, services::topics::plan_delta,
      [take = std::move(take), report = std::move(report),
       robot = node.options().robot](const v1::PlanDelta& delta) {
        const std::string& planned_for = delta.header().robot();
        if (!robot.empty() && !planned_for.empty() && planned_for != robot) return;
        try {
          take(services::wire::from_wire(delta));
        } catch (const services::wire::WireError& error) {
          report({Severity::warning, "plan.malformed",
                  "version " + std::to_string(delta.added().version()) + ": " + error.what()});
        }
      });
}

void EngineLink::tell(const PlanReceipt& receipt) { receipts_.write(to_wire(receipt, executive_)); }

}  // namespace roci::exec
