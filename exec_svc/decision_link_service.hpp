/// The line to those who resolve decisions of the running plan: questions out, answers in, a receipt for each
/// answer (R131).
#pragma once

#include <functional>
#include <string>

#include "exec_svc/reactor/reactor.hpp"
#include "services/publisher.hpp"

namespace roci::exec {

class DecisionLink {
 public:
  /// `take` gets each answer that is meant for this executive, with its line of the trace.
  DecisionLink(services::Node& node, std::function<void(reactor::GivenAnswer, std::string line)> take);

  /// What a step has decided.
  void send(const reactor::ReactorOutputs& out) const;
  /// Everything as it stands, for who joins after a restart: an open question is asked again under its id.
  void tell(const reactor::Reactor& reactor) const;

 private:
  void tell(const reactor::DecisionRecord& decision) const;
  void tell(const reactor::AnswerReceipt& receipt) const;

  std::string executive_;  // logical name
  services::Publisher<v1::Decision> decisions_;
  services::Publisher<v1::DecisionReceipt> receipts_;
};

}  // namespace roci::exec
