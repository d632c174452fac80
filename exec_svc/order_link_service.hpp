/// The line to the ground: orders in, the stages of each out; and, as observations for everybody, the values that the
/// ground has set and what plans have made of timelines that nobody observes.
#pragma once

#include <functional>
#include <string>

#include "exec_svc/reactor/reactor.hpp"
#include "services/publisher.hpp"

namespace roci::exec {

class OrderLink {
 public:
  /// `take` gets each order that is meant for this executive's robot, with its line of the trace; `report`
  /// what is wrong with one that cannot be read.
  OrderLink(services::Node& node, std::function<void(orders::Order, std::string line)> take,
            std::function<void(const reactor::Event&)> report);

  /// Who holds what is acknowledged from now on.
  void acknowledge_as(goals::AckStage stage) { ack_stage_ = stage; }
  /// What a step has decided.
  void send(const reactor::ReactorOutputs& out) const;
  /// Everything as it stands, for who joins after a restart.
  void tell(const reactor::Reactor& reactor) const;
  /// What plans have made of timelines that nobody observes.
  void tell_concluded(const reactor::Reactor& reactor) const;
  /// Where every order stands.
  void tell_orders(const reactor::Reactor& reactor) const;

 private:
  void tell(const orders::OrderStatus& status) const;
  void tell(const executive::Observation& value) const;

  services::Node& node_;
  goals::AckStage ack_stage_ = goals::AckStage::journaled;
  services::Publisher<v1::OrderStatus> statuses_;
  services::Publisher<v1::Observation> observations_;
};

}  // namespace roci::exec
