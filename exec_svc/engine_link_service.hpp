/// The line to an engine that plans all the time: versions of its plan in, receipts out (R66). Which steps
/// begin and end it hears on the topics that everybody hears.
#pragma once

#include <functional>
#include <string>

#include "exec_svc/reactor/reactor.hpp"
#include "services/publisher.hpp"

namespace roci::exec {

class EngineLink {
 public:
  /// `take` gets each delta as it comes, `report` what is wrong with one that cannot be read.
  EngineLink(services::Node& node, std::function<void(temporal::PlanDelta)> take,
             std::function<void(const reactor::Event&)> report);

  void tell(const reactor::PlanReceipt& receipt);

 private:
  std::string executive_;  // logical name
  services::Publisher<v1::PlanReceipt> receipts_;
};

}  // namespace roci::exec
