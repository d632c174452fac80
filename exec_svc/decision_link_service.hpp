// The decision link joins the executive to those who resolve decisions of the running plan (R131).
#pragma once

#include <functional>
#include <string>

#include "exec_svc/reactor/reactor.hpp"
#include "services/publisher.hpp"

namespace roci::exec {

/// Sends questions and receipts, and takes answers to decisions in from the wire (R131). Every answer gets a
/// receipt.
class DecisionLink {
 public:
  /// Calls `take` with each answer that is meant for this executive, and with its line of the trace.
  DecisionLink(services::Node& node, std::function<void(reactor::GivenAnswer, std::string line)> take);

  /// Sends what a step has decided.
  void send(const reactor::ReactorOutputs& out) const;
  /// Publishes everything as it stands, for late joiners after a restart: an open question is asked again
  /// under its id.
  void tell(const reactor::Reactor& reactor) const;

 private:
  void tell(const reactor::DecisionRecord& decision) const;
  void tell(const reactor::AnswerReceipt& receipt) const;

  std::string executive_;  // logical name
  services::Publisher<v1::Decision> decisions_;
  services::Publisher<v1::DecisionReceipt> receipts_;
};

}  // namespace roci::exec
