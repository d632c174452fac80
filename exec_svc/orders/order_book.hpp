// The order book keeps every order that came, with where it stands.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "exec_svc/orders/order.hpp"

namespace roci::exec::orders {

/// Guarantees that an order is given once, whoever repeats it, and keeps the newest stage of each.
class OrderBook {
 public:
  /// Enters an order. Returns whether it is new, and thus received. An order whose key is known is answered
  /// with where it stands, and not given again; a sample that was heard before is not even answered.
  bool receive(const Order& order);
  /// Moves an order to its next stage.
  void move(const IssuedKey& key, OrderStage stage, const std::string& reason, std::uint32_t plan_version);

  /// Returns the stages since the last call, in their order.
  std::vector<OrderStatus> take_changes();
  /// Returns the newest stage of every order.
  std::vector<OrderStatus> all() const;

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.statuses_);
  }

 private:
  std::map<IssuedKey, OrderStatus> statuses_;
  std::vector<OrderStatus> changes_;
};

}  // namespace roci::exec::orders
