#include "exec_svc/order_link_service.hpp"

#include <string>
#include <utility>

#include "services/topics/topics.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::exec {

using executive::Observation;
using mission::AutonomyLevel;
using orders::Order;
using orders::OrderKind;
using orders::OrderStatus;
using reactor::Event;
using reactor::Reactor;
using reactor::ReactorOutputs;
using reactor::Severity;

namespace {

namespace topics = services::topics;

/// Throws WireError.
template <class Meaning, class Wire>
Meaning word_of(Wire wire, Wire last, const char* what) {
  if (wire > last) throw services::wire::WireError(std::string("there is no such ") + what);
  return static_cast<Meaning>(wire);
}

/// Throws WireError.
Order from_wire(const v1::Order& in) {
  Order out;
  out.key = {in.issuer(), in.id()};
  out.sample = {in.header().sender(), in.header().incarnation(), in.header().seq()};
  out.kind = word_of<OrderKind>(in.order_kind(), v1::ORDER_SAFE, "order");
  out.target = in.target();
  out.content = services::wire::from_wire(in.content());
  if (out.kind == OrderKind::approve && out.content != temporal::Value{}) out.kind = OrderKind::command;
  out.choice = in.choice();
  out.level = word_of<AutonomyLevel>(in.autonomy(), v1::AUTONOMY_E4, "level of autonomy");
  out.upload.assign(in.upload().begin(), in.upload().end());
  out.checksum = in.checksum();
  return out;
}

std::string trace_line(const Order& order) {
  return "order " + order.key.text() + " " + to_string(order.kind) + " " + order.target;
}

}  // namespace

OrderLink::OrderLink(services::Node& node, std::function<void(Order, std::string)> take,
                     std::function<void(const Event&)> report)
    : node_(node),
      statuses_(services::advertise(node, topics::order_status)),
      observations_(services::advertise(node, topics::observation)) {
  services::subscribe(node, topics::order,
                      [take = std::move(take), report = std::move(report),
                       robot = node.options().robot](const v1::Order& order) {
                        if (!order.robot().empty() && order.robot() != robot) return;
                        try {
                          Order taken = from_wire(order);
                          std::string line = trace_line(taken);
                          take(std::move(taken), std::move(line));
                        } catch (const services::wire::WireError& error) {
                          report({Severity::warning, "order.malformed",
                                  order.issuer() + "/" + order.id() + ": " + error.what()});
                        }
                      });
}

void OrderLink::send(const ReactorOutputs& out) const {
  for (const Observation& value : out.values) tell(value, node_.now());
  for (const Observation& value : out.concluded) tell(value, node_.now());
  for (const OrderStatus& status : out.order_statuses) tell(status);
}

void OrderLink::tell(const Reactor& reactor, temporal::Time until) const {
  for (const auto& [timeline, value] : reactor.ground_values()) tell(Observation{timeline, value}, until);
  tell_concluded(reactor, until);
  tell_orders(reactor);
}

void OrderLink::tell_concluded(const Reactor& reactor, temporal::Time until) const {
  for (const auto& [timeline, value] : reactor.told_conclusions()) tell(Observation{timeline, value}, until);
}

void OrderLink::tell_orders(const Reactor& reactor) const {
  for (const OrderStatus& status : reactor.order_statuses()) tell(status);
}

void OrderLink::tell(const OrderStatus& status) const {
  v1::OrderStatus out;
  out.executive(node_.options().name);
  out.issuer(status.key.issuer);
  out.id(status.key.id);
  out.answers().sender(status.answers.sender);
  out.answers().incarnation(status.answers.incarnation);
  out.answers().seq(status.answers.number);
  out.stage(static_cast<v1::OrderStage>(status.stage));
  out.reason(status.reason);
  out.plan_version(status.plan_version);
  out.ack_stage(static_cast<v1::AckStage>(ack_stage_));
  statuses_.write(std::move(out));
}

void OrderLink::tell(const Observation& value, temporal::Time sampled) const {
  v1::Observation out;
  out.timeline(value.timeline);
  out.observed(services::wire::to_wire(value.value));
  out.sampled_us(sampled.count());
  observations_.write(std::move(out));
}

}  // namespace roci::exec
