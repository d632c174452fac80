/// Every order that came, with where it stands: an order is given once.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "exec_svc/orders/order.hpp"

namespace roci::exec::orders {

class OrderBook {
 public:
  /// Enters an order. True: it is new and has been received. An order whose key is known is answered with
  /// where it stands, and not given again; a sample that was heard before is not even answered.
  bool receive(const Order& order);
  /// The next stage of an order.
  void move(const IssuedKey& key, OrderStage stage, const std::string& reason, std::uint32_t plan_version);

  /// The stages since the last call, in their order.
  std::vector<OrderStatus> take_changes();
  /// The newest stage of every order.
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
