// The order link joins the executive to the ground: orders come in, the stages of each go out. It also publishes, as
// observations for everybody, the values that the ground has set and what plans have made of timelines that nobody
// observes.
#pragma once

#include <functional>
#include <string>

#include "exec_svc/reactor/reactor.hpp"
#include "services/publisher.hpp"

namespace roci::exec {

/// Takes orders in from the wire, and publishes their stages and the values that only the executive knows.
class OrderLink {
 public:
  /// Calls `take` with each order that is meant for this executive's robot, and with its line of the trace;
  /// calls `report` with what is wrong with one that cannot be read.
  OrderLink(services::Node& node, std::function<void(orders::Order, std::string line)> take,
            std::function<void(const reactor::Event&)> report);

  /// Says who holds what is acknowledged from now on.
  void acknowledge_as(goals::AckStage stage) { ack_stage_ = stage; }
  /// Sends what a step has decided.
  void send(const reactor::ReactorOutputs& out) const;
  /// Publishes everything as it stands, for late joiners after a restart. Values are those of the time at which the
  /// record ends: what has moved them since is newer.
  void tell(const reactor::Reactor& reactor, temporal::Time until) const;
  /// Publishes what plans have made of timelines that nobody observes, by that time.
  void tell_concluded(const reactor::Reactor& reactor, temporal::Time until) const;
  /// Publishes where every order stands.
  void tell_orders(const reactor::Reactor& reactor) const;

 private:
  void tell(const orders::OrderStatus& status) const;
  void tell(const executive::Observation& value, temporal::Time sampled) const;

  services::Node& node_;
  goals::AckStage ack_stage_ = goals::AckStage::journaled;
  services::Publisher<v1::OrderStatus> statuses_;
  services::Publisher<v1::Observation> observations_;
};

}  // namespace roci::exec
