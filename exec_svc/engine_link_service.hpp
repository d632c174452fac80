// The engine link joins the executive to an engine that plans all the time (R66). That one hears which steps
// begin and end on the topics that everybody hears.
#pragma once

#include <functional>
#include <string>

#include "exec_svc/reactor/reactor.hpp"
#include "services/publisher.hpp"

namespace roci::exec {

/// Takes in versions of the engine's plan, and sends receipts for them (R66).
class EngineLink {
 public:
  /// Calls `take` with each delta as it comes, and `report` with what is wrong with one that cannot be read.
  EngineLink(services::Node& node, std::function<void(temporal::PlanDelta)> take,
             std::function<void(const reactor::Event&)> report);

  void tell(const reactor::PlanReceipt& receipt);

 private:
  std::string executive_;  // logical name
  services::Publisher<v1::PlanReceipt> receipts_;
};

}  // namespace roci::exec
