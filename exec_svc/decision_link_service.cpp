#include "exec_svc/decision_link_service.hpp"

#include <utility>

#include "services/topics/topics.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::exec {

using reactor::AnswerReceipt;
using reactor::DecisionRecord;
using reactor::GivenAnswer;
using reactor::Reactor;
using reactor::ReactorOutputs;

namespace {

namespace topics = services::topics;

GivenAnswer from_wire(const v1::DecisionAnswer& in) {
  return {{in.issuer(), in.id()},
          {in.header().sender(), in.header().incarnation(), in.header().seq()},
          in.decision_id(),
          in.choice(),
          in.bound_value()};
}

std::string trace_line(const v1::DecisionAnswer& in) {
  return "answer " + in.issuer() + "/" + in.id() + " " + in.decision_id() + " " + in.choice() + " " +
         in.bound_value();
}

}  // namespace

DecisionLink::DecisionLink(services::Node& node, std::function<void(GivenAnswer, std::string)> take)
    : executive_(node.options().name),
      decisions_(services::advertise(node, topics::decision)),
      receipts_(services::advertise(node, topics::decision_receipt)) {
  services::subscribe(node, topics::decision_answer,
                      [take = std::move(take), executive = executive_](const v1::DecisionAnswer& answer) {
                        if (answer.executive().empty() || answer.executive() == executive)
                          take(from_wire(answer), trace_line(answer));
                      });
}

void DecisionLink::send(const ReactorOutputs& out) const {
  for (const DecisionRecord& decision : out.decisions) tell(decision);
  for (const AnswerReceipt& receipt : out.answer_receipts) tell(receipt);
}

void DecisionLink::tell(const Reactor& reactor) const {
  for (const auto& [id, decision] : reactor.decisions()) tell(decision);
  for (const AnswerReceipt& receipt : reactor.answer_receipts()) tell(receipt);
}

void DecisionLink::tell(const DecisionRecord& decision) const {
  const executive::DecisionStatus& status = decision.status;
  v1::Decision out;
  out.executive(executive_);
  out.id(status.decision);
  out.plan_version(decision.plan_version);
  out.resolver(status.resolver);
  out.choices(status.choices);
  out.admissible(status.admissible);
  out.answer_before_us(services::wire::bound_to_wire(status.answer_before));
  out.decision_state(static_cast<v1::DecisionState>(status.state));
  out.chosen(status.chosen);
  out.answered_by(status.answered_by);
  decisions_.write(out);
  if (status.state != executive::DecisionState::open) decisions_.dispose(out);
}

void DecisionLink::tell(const AnswerReceipt& receipt) const {
  v1::DecisionReceipt out;
  out.executive(executive_);
  out.issuer(receipt.key.issuer);
  out.id(receipt.key.id);
  out.answers().sender(receipt.answers.sender);
  out.answers().incarnation(receipt.answers.incarnation);
  out.answers().seq(receipt.answers.number);
  out.decision_id(receipt.decision);
  out.outcome(static_cast<v1::AnswerOutcome>(receipt.result.outcome));
  out.reason(receipt.result.reason);
  receipts_.write(std::move(out));
}

}  // namespace roci::exec
